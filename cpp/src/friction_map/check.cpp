// The finished map against the solver at a twentieth of its error, with the solver's own error added: at random
// velocities with 200 random pressures each, which share most of the solver's work; with heat at random pressures and
// temperatures with 200 random velocities each, along which a solution begins at the one before.
#include "friction_map/check.hpp"

#include <algorithm>
#include <cmath>

#include "asperity/friction_map.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

constexpr std::size_t together = 200;
constexpr double share = 1.0 / 20;  // of the certified error, for the solver

class Check {
 public:
  Check(const MapFrame& frame, const FrictionMap& map) : frame_(frame), map_(map) {}

  /// Errors of the next `n` points.
  std::vector<double> errors(std::size_t n, unsigned threads) {
    places_.resize(n);
    temperature_.resize(n);
    std::vector<double> errors(n);
    map_.info().heat ? draw_with_heat() : draw();
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
    const auto [x_lo, x_hi] = frame_.x();
    const double y_lo = frame_.ln_pressure(0), y_hi = frame_.ln_pressure(1);
    double x = 0, angle = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (i % together == 0) {
        x = x_lo + random_() * (x_hi - x_lo);
        if (frame_.turns()) angle = random_() * frame_.heights()[1];
      }
      temperature_[i] = angle;
      places_[i] = {x, y_lo + random_() * (y_hi - y_lo) - frame_.log_modulus_offset(x)};
    }
  }

  void draw_with_heat() {
    const auto [x_lo, x_hi] = frame_.ln_velocity();
    const auto [coldest, hottest] = frame_.temperature();
    const double y_lo = frame_.ln_pressure(0), y_hi = frame_.ln_pressure(1);
    double y = 0, temperature = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (i % together == 0) {
        y = y_lo + random_() * (y_hi - y_lo);
        temperature = coldest + random_() * (hottest - coldest);
      }
      places_[i] = {x_lo + random_() * (x_hi - x_lo), y};
      temperature_[i] = temperature;
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

}  // namespace

void check(const MapFrame& frame, const std::vector<unsigned char>& file, const MapRequest& request, unsigned threads,
           const std::function<void(double)>& progress, MapCertificate& certificate) {
  if (request.checked == 0) return;
  FrictionMap map;
  std::string why;
  if (!map.read(file.data(), file.size(), why)) throw Error("the map that was just made " + why);
  // with heat always the same ones together, as each begins at the one before
  const MapFrame solver = frame.with_solver_rtol(std::fmax(frame.solver_rtol(), share * certificate.max_error));
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

}  // namespace asperity
