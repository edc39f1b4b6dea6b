// Builds a friction map: checks of the request, refinement, and random points on which the finished file is checked.
#include <algorithm>
#include <cmath>
#include <thread>

#include "asperity/build_friction_map.hpp"
#include "asperity/friction_map.hpp"
#include "asperity/version.hpp"
#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "friction_map/format.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

// The finished map against the solver at a twentieth of its error, with the solver's own error added: at random
// velocities with 200 random pressures each, which share most of the solver's work; with heat at random pressures and
// temperatures with 200 random velocities each, along which a solution begins at the one before.
class Check {
 public:
  Check(const MapFrame& frame, const FrictionMap& map) : frame_(frame), map_(map) {}

  /// Errors of the next `n` points.
  std::vector<double> errors(std::size_t n, unsigned threads) {
    places_.resize(n);
    temperature_.resize(n);
    std::vector<double> errors(n);
    draw();
    if (map_.info().heat) {
      compare(frame_.sample_points(places_, temperature_, threads), 0, errors);
      return errors;
    }
    in_parts(threads, n, [&](unsigned, std::size_t begin, std::size_t end) {
      const auto part = [&](const auto& of) { return std::span(of).subspan(begin, end - begin); };
      compare(frame_.turns() ? frame_.sample_at(part(places_), part(temperature_), 1) : frame_.sample(part(places_)),
              begin, errors);
    });
    return errors;
  }

 private:
  void draw() {
    constexpr std::size_t together = 200;
    const bool heat = map_.info().heat;
    const auto [x_lo, x_hi] = frame_.ln_velocity();
    const auto [lowest, highest] = frame_.turns() ? frame_.heights() : frame_.temperature();
    const double y_lo = frame_.ln_pressure(0), y_hi = frame_.ln_pressure(1);
    double shared = 0, height = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (i % together == 0) {
        shared = random_();
        if (heat || frame_.turns()) height = lowest + random_() * (highest - lowest);
      }
      const double own = random_(), x = x_lo + (heat ? own : shared) * (x_hi - x_lo);
      places_[i] = {x, y_lo + (heat ? shared : own) * (y_hi - y_lo) - frame_.log_modulus_offset(x)};
      temperature_[i] = height;
    }
  }

  void compare(const std::vector<MapSample>& truth, std::size_t begin, std::vector<double>& errors) const {
    for (std::size_t i = begin; i < begin + truth.size(); ++i) {
      const auto& [of_solver, error, across] = truth[i - begin];
      const auto& [ln_hysteresis, ln_area] = of_solver;
      const double y = places_[i].z + frame_.log_modulus_offset(places_[i].x);
      MapPoint found;
      map_.at(
          std::exp(y), std::exp(places_[i].x), found, FrictionMap::Outside::clamp,
          {.background = map_.info().heat ? temperature_[i] : 0, .direction = frame_.turns() ? temperature_[i] : 0});
      errors[i] = std::fabs(found.contact_area / std::exp(ln_area) - 1);
      if (frame_.hysteresis())
        errors[i] = std::fmax(errors[i], std::fabs(found.hysteresis / std::exp(ln_hysteresis) - 1));
      const double force = (1 + std::fabs(across)) * std::exp(ln_hysteresis);
      errors[i] = std::fmax(errors[i], std::fabs(found.lateral - across * std::exp(ln_hysteresis)) / force) + error;
    }
  }

  const MapFrame& frame_;
  const FrictionMap& map_;
  Random random_{20261120};
  std::vector<MapPlace> places_;
  std::vector<double> temperature_;  // or the direction
};

/// Fills in the certificate; `progress` hears of the share of the points that are done. NotConverged where one is off
/// by more than rtol.
void check(const MapFrame& frame, const std::vector<unsigned char>& file, const MapRequest& request, unsigned threads,
           const std::function<void(double)>& progress, MapCertificate& certificate) {
  FrictionMap map;
  std::string why;
  if (!map.read(file.data(), file.size(), why)) throw Error("the map that was just made " + why);
  // the solver is one step more; with heat always the same ones together, as each begins at the one before
  const MapFrame solver = frame.with_solver_rtol(std::fmax(frame.solver_rtol(), step_share * certificate.max_error));
  const std::size_t block = map.info().heat ? 6'400 : 20'000 * std::size_t{threads};
  Check points(solver, map);
  for (std::size_t done = 0; done < request.checked;) {
    heed();
    const std::size_t n = std::min(block, request.checked - done);
    for (const double error : points.errors(n, threads)) {
      certificate.largest_checked_error = std::fmax(certificate.largest_checked_error, error);
      if (!(error <= certificate.max_error)) ++certificate.exceeded;
    }
    done += n;
    if (progress) progress(static_cast<double>(done) / static_cast<double>(request.checked));
  }
  certificate.checked = request.checked;
  if (certificate.largest_checked_error > request.rtol)
    throw NotConverged(argument("rtol") + " = " + value(request.rtol) + ": " +
                       show(certificate.largest_checked_error, 3) + " was reached, on one of " +
                       std::to_string(request.checked) + " random points");
}

using map_detail::huge, map_detail::tiny;
constexpr double least_range = 0.1;  // of temperatures [K]

void check_request(const MapRequest& request, const std::optional<Adhesion>& adhesion) {
  for (const auto& [name, box] : {std::pair{"pressure", request.pressure}, std::pair{"velocity", request.velocity}}) {
    for (const double side : box) {
      require_positive(name, side);
      if (side < tiny || side > huge) refuse(name, side, "in [1e-300, 1e300]");
    }
    if (!(box[0] * (1 + 1e-6) < box[1]))
      throw InvalidInput(argument(name) + " = " + pair(box[0], box[1]) +
                         ": must be (lo, hi) with lo < hi, a millionth apart or more");
  }
  require_rtol(request.rtol);
  if (!adhesion) return;
  validate(*adhesion);
  for (const auto& [name, value] : {std::pair{"shear_stress", adhesion->shear_stress},
                                    std::pair{"reference_velocity", adhesion->reference_velocity}})
    if (value != 0 && (value < tiny || value > huge)) refuse(name, value, "in [1e-300, 1e300] for a map");
  if (adhesion->width > huge) refuse("width", adhesion->width, "at most 1e300 for a map");
}

void check_temperature(const std::array<double, 2>& temperature) {
  for (const double one : temperature) require_temperature(one);
  const auto [lowest, highest] = temperature;
  if (lowest != highest && !(lowest + least_range <= highest))
    throw InvalidInput(argument("temperature") + " = " + pair(lowest, highest) + must_be() +
                       "one, or (lo, hi) with lo < hi, " + show(least_range) + " K apart or more");
}

/// 81 points of the box at each temperature, evenly in the logarithms, edges and corners too.
MapPoints points_of(const MapRequest& request, const std::vector<double>& temperatures) {
  constexpr int steps = 8;
  MapPoints points;
  for (const double one : temperatures)
    for (const int i : {0, steps, 1, 2, 3, 4, 5, 6, 7})  // the ends first: errors name the sides of the box
      for (int j = 0; j <= steps; ++j)
        points.add(between(request.pressure, static_cast<double>(j) / steps),
                   between(request.velocity, static_cast<double>(i) / steps), one);
  return points;
}

std::string text_of(const std::vector<Diagnostic>& notes, const MapRequest& request) {
  std::string text = "asperity " + std::string(version()) + "\n";
  constexpr std::array<const char*, 3> severities{"note", "warning", "fatal"};
  for (const Diagnostic& note : request.words ? request.words(notes) : notes) {
    text.append("note: ").append(severities[static_cast<std::size_t>(note.severity)]).append(" ").append(note.code);
    if (!note.argument.empty()) text.append(" ").append(note.argument);
    text.append(": ");
    for (const Sentence* part : {&note.where, &note.sentence})
      for (const Phrase& phrase : *part) text += phrase.text;
    if (!note.next_step.empty()) text += "\t";
    for (const Phrase& phrase : note.next_step) text += phrase.text;
    text += "\n";
  }
  return text.append(request.text);
}

/// Stages of the work, of which progress is told as if each took as long as any other.
class Stages {
 public:
  Stages(const std::function<void(double)>& progress, int count) : progress_(progress), count_(count) {}
  std::function<void(double)> next() {
    if (!progress_) return {};
    return [this, before = done_++](double share) { progress_((before + share) / count_); };
  }

 private:
  const std::function<void(double)>& progress_;
  int count_, done_ = 0;
};

unsigned threads_of(const MapRequest& request) {
  return request.threads > 0 ? request.threads : std::max(1u, std::thread::hardware_concurrency());
}

/// Refines a map, adds to it what goes with its heat, made by `heat` that tells how far it is, and checks the finished
/// file.
std::vector<unsigned char> made(const MapFrame& frame, const std::optional<Adhesion>& adhesion,
                                const MapRequest& request, std::string_view text,
                                const std::function<MapHeatTables(const std::function<void(double)>&)>& heat = {}) {
  const unsigned threads = threads_of(request);
  Stages stages(request.progress, 1 + (heat ? 1 : 0) + (frame.directional() ? 1 : 0) + (request.checked > 0 ? 1 : 0));
  const RefinedMap refined = refine(frame, request.rtol, threads, stages.next());
  MapHeatTables beside;
  if (heat) beside = heat(stages.next());
  MapCertificate certificate{.max_error = refined.max_error};
  if (frame.directional()) {
    const MapFrame across = frame.of_across();
    const RefinedMap forces = refine(across, request.rtol, threads, stages.next());
    certificate.max_error = std::fmax(refined.max_error, forces.max_error);
    MapHeatTables of_forces;
    of_forces.sliding = beside.sliding;
    beside.across = map_file(across, forces, {}, request, {}, {.max_error = forces.max_error}, of_forces);
  }
  const auto file = [&] { return map_file(frame, refined, adhesion, request, text, certificate, beside); };
  if (request.checked == 0) return file();
  check(frame, file(), request, threads, stages.next(), certificate);
  return file();
}

/// `turns`: in all directions that the spectrum knows.
std::vector<unsigned char> without_heat(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& given,
                                        const std::optional<Adhesion>& adhesion, const MapRequest& request,
                                        bool turns) {
  check_request(request, adhesion);
  ContactModel model = given;
  if (const auto* const scan = std::get_if<ScanContact>(&given.correction))
    model.correction = scan->with_pressure_lattice();  // a map asks at many pressures, a few at a time
  const MapPoints at = points_of(request, {0});
  const std::string text =
      text_of(friction(spectrum, rubber, model, adhesion, at.pressure, at.velocity).notes, request);
  return made(MapFrame(spectrum, rubber, model, request, turns), adhesion, request, text);
}

}  // namespace

std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                              const std::optional<Adhesion>& adhesion, const MapRequest& request) {
  return without_heat(spectrum, rubber, model, adhesion, request, true);
}

std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber,
                                              const TemperatureShift& shift, const Heating& heating,
                                              const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                              std::array<double, 2> temperature, const MapRequest& request) {
  check_request(request, adhesion);
  check_temperature(temperature);
  check_gauss(model.method, "in a map with heat, whose sliding lengths GSL's methods do not know");
  if (macro_modulus(model.correction, spectrum, rubber, request.velocity[0], model.poisson_ratio))
    throw InvalidInput(
        argument("correction") + must_be() +
        "none of Greenwood-Williamson's in a map with heat. Without it all kinks of p_T lie along one curve, "
        "E*(velocity), which the map follows; with heat each has a curve of its own. friction takes it");
  if (std::holds_alternative<ScanContact>(model.correction))
    throw InvalidInput(argument("correction") + " = " + word("ScanContact") + must_be() +
                       "another one in a map with heat, of which every point is a contact");
  const auto [lowest, highest] = temperature;
  const MapPoints at = points_of(
      request, lowest == highest ? std::vector{lowest} : std::vector{lowest, highest, (lowest + highest) / 2});
  const FlashFriction found =
      friction(spectrum, rubber, shift, heating, model, adhesion, at.pressure, at.velocity, at.temperature);
  refuse_folds(found);
  const MapHeat heat{&shift, &heating, adhesion, temperature, temperature[0]};
  const MapFrame frame(spectrum, rubber, model, request, false, heat);
  return made(frame, adhesion, request, text_of(found.hot.notes, request),
              [&](const std::function<void(double)>& progress) {
                MapRequest cold = request;
                for (std::size_t i = 0; i < 2; ++i) cold.velocity[i] *= std::exp(frame.log_a_T_sides()[i]);
                cold.progress = {};  // a second or two
                const Rubber at_lowest = shifted(rubber, shift, temperature[0]);
                MapHeatTables result;
                result.cold = without_heat(spectrum, at_lowest, model, adhesion, cold, false);
                result.sliding = sliding_table(spectrum, rubber, model, heat, request, threads_of(request), progress);
                return result;
              });
}

}  // namespace asperity
