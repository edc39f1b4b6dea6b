// Builds a friction map: checks of the request, refinement, and random points on which the finished file is checked.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "asperity/build_friction_map.hpp"
#include "asperity/friction_map.hpp"
#include "asperity/version.hpp"
#include "asperity/watch.hpp"
#include "friction_map/format.hpp"
#include "friction_map/refine.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

// Limits of the numbers in the file.
constexpr double smallest = 1e-300, largest = 1e300;

/// Of the whole work, as progress tells it: the points that cells are made from. The rest is the check.
constexpr double sampling_share = 0.2;

void check_request(const MapRequest& request, const std::optional<Adhesion>& adhesion) {
  for (const auto& [name, box] : {std::pair{"pressure", request.pressure}, std::pair{"velocity", request.velocity}}) {
    for (const double side : box) {
      require_positive(name, side);
      if (side < smallest || side > largest) refuse(name, side, "in [1e-300, 1e300]");
    }
    if (!(box[0] * (1 + 1e-6) < box[1]))
      throw InvalidInput(std::string(name) + " = (" + show(box[0]) + ", " + show(box[1]) +
                         "): must be (lo, hi) with lo < hi, a millionth apart or more");
  }
  require_rtol(request.rtol);
  if (!adhesion) return;
  validate(*adhesion);
  for (const auto& [name, value] : {std::pair{"shear_stress", adhesion->shear_stress},
                                    std::pair{"reference_velocity", adhesion->reference_velocity}})
    if (value != 0 && (value < smallest || value > largest)) refuse(name, value, "in [1e-300, 1e300] for a map");
  if (adhesion->width > largest) refuse("width", adhesion->width, "at most 1e300 for a map");
}

/// Those at 81 points of the box, evenly in the logarithms, edges and corners too.
std::vector<std::string> notes_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                  const std::optional<Adhesion>& adhesion, const MapRequest& request) {
  constexpr int steps = 8;
  const auto between = [](const std::array<double, 2>& box, int i) {
    const double share = static_cast<double>(i) / steps;
    return i == 0 ? box[0] : i == steps ? box[1] : std::exp((1 - share) * std::log(box[0]) + share * std::log(box[1]));
  };
  std::vector<double> pressure, velocity;
  for (const int i : {0, steps, 1, 2, 3, 4, 5, 6, 7})  // the ends first: errors name the sides of the box
    for (int j = 0; j <= steps; ++j) {
      velocity.push_back(between(request.velocity, i));
      pressure.push_back(between(request.pressure, j));
    }
  return friction(spectrum, rubber, model, adhesion, pressure, velocity).notes;
}

/// The finished map against the solver, whose own error counts too, on random velocities with 200 random pressures
/// each.
void check(const MapFrame& frame, const FrictionMap& map, const MapRequest& request, unsigned threads,
           MapCertificate& certificate) {
  constexpr std::size_t block = 20'000, pressures = 200;
  Random random(20261120);
  const auto [x_lo, x_hi] = frame.x();
  const double y_lo = frame.ln_pressure(0), y_hi = frame.ln_pressure(1);
  std::vector<MapPlace> places;
  std::vector<double> errors;
  for (std::size_t done = 0; done < request.checked; done += places.size()) {
    heed();
    places.resize(std::min(block * threads, request.checked - done));
    errors.resize(places.size());
    double x = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i % pressures == 0) x = x_lo + random() * (x_hi - x_lo);
      places[i] = {x, y_lo + random() * (y_hi - y_lo) - frame.log_modulus_offset(x)};
    }
    in_parts(threads, places.size(), [&](unsigned, std::size_t begin, std::size_t end) {
      const std::vector<MapSample> truth = frame.sample(std::span(places).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [of_solver, error] = truth[i - begin];
        const auto& [ln_hysteresis, ln_area] = of_solver;
        const double y = places[i].z + frame.log_modulus_offset(places[i].x);
        MapPoint found;
        map.at(std::exp(y), std::exp(places[i].x), found, FrictionMap::Outside::clamp);
        errors[i] = std::fabs(found.contact_area / std::exp(ln_area) - 1);
        if (frame.hysteresis())
          errors[i] = std::fmax(errors[i], std::fabs(found.hysteresis / std::exp(ln_hysteresis) - 1));
        errors[i] += error;
      }
    });
    if (request.progress)
      request.progress(sampling_share + (1 - sampling_share) * static_cast<double>(done + places.size()) /
                                            static_cast<double>(request.checked));
    for (const double error : errors) {
      certificate.largest_checked_error = std::fmax(certificate.largest_checked_error, error);
      if (!(error <= certificate.max_error)) ++certificate.exceeded;
    }
  }
  certificate.checked = request.checked;
}

}  // namespace

std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                              const std::optional<Adhesion>& adhesion, const MapRequest& request) {
  check_request(request, adhesion);
  std::string text = "asperity " + std::string(version()) + "\n";
  for (const std::string& note : notes_of(spectrum, rubber, model, adhesion, request))
    text.append("note: ").append(note).append("\n");
  text += request.text;
  MapRequest whole = request;
  whole.text = text;

  const unsigned threads = request.threads > 0 ? request.threads : std::max(1u, std::thread::hardware_concurrency());
  const MapFrame frame(spectrum, rubber, model, request);
  const auto sampled = [&](double share) {
    if (request.progress) request.progress(share * (request.checked == 0 ? 1 : sampling_share));
  };
  const RefinedMap refined = refine(frame, request.rtol, threads, sampled);
  MapCertificate certificate{.max_error = refined.max_error};
  std::vector<unsigned char> file = map_file(frame, refined.tree, adhesion, whole, certificate);
  if (request.checked == 0) return file;
  FrictionMap map;
  std::string why;
  if (!map.read(file.data(), file.size(), why)) throw Error("the map that was just made " + why);
  check(frame, map, request, threads, certificate);
  if (certificate.largest_checked_error > request.rtol)
    throw NotConverged("rtol = " + show(request.rtol) + ": " + show(certificate.largest_checked_error, 3) +
                       " was reached, on one of " + std::to_string(request.checked) + " random points");
  return map_file(frame, refined.tree, adhesion, whole, certificate);
}

}  // namespace asperity
