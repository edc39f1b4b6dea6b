// The same tire model with the full theory behind every bristle, and the map that brush_map reads made from it.
//
//   brush_full road.fmap > slip.csv
//
// Fails where the two slip curves differ by more than the map's own error allows: that of rubber without its heat at
// all slips, the hot one at three of them with fewer bristles, as a hot point takes a hundred times as long. How the
// rubber heats up in the contact patch is told by the map alone.
#include <algorithm>
#include <asperity/build_friction_map.hpp>
#include <asperity/friction_map.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "../brush.hpp"

namespace {

constexpr double background = 293.15;  // [K]

struct Scene {
  asperity::Spectrum road = asperity::SelfAffineSpectrum{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  asperity::PronySeries rubber{3e6,
                               {2e6, 4e6, 9e6, 2e7, 4e7, 8e7, 1.8e8, 3.8e8, 8e8},
                               {1e-1, 1.3e-2, 1.8e-3, 2.4e-4, 3e-5, 4e-6, 6e-7, 7.5e-8, 1e-8}};
  asperity::ContactModel model{.correction = asperity::NayakSFactor{}};
  asperity::Adhesion adhesion{.shear_stress = 8.3e6};
  asperity::TemperatureShift shift = asperity::WLF{.c1 = 8.86, .c2 = 101.6, .reference = background};
  asperity::Heating heating{.density = 1200, .heat_capacity = 1650, .conductivity = 0.23, .contact_diameter = 1e-3};

  Scene() { road = asperity::truncated(road, {}, asperity::cutoff_for_slope(road)); }
};

/// How much the error of mu may grow on its way into the force: 1 / (1 - b), b the largest p |d mu / d ln v| / (k D).
/// An error of mu moves the deflection, by which the sliding velocity changes, and mu by as much as b of it once more.
double growth(const brush::Tire& tire, const asperity::FrictionMap& map) {
  constexpr int steps = 100;
  const auto between = [](const std::array<double, 2>& box, int i) {
    return box[0] * std::pow(box[1] / box[0], static_cast<double>(i) / steps);
  };
  double largest = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double pressure = std::min(between(map.info().pressure, i), 1.5 * tire.mean_pressure);
      asperity::MapPoint point;
      map.at(pressure, between(map.info().velocity, j), point, asperity::FrictionMap::Outside::clamp);
      largest = std::max(largest, pressure * std::fabs(point.dmu_dlnv) / (tire.stiffness * tire.renewal));
    }
  return 1 / (1 - largest);
}

bool write(const std::string& path, const std::vector<unsigned char>& bytes) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const bool is_whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && is_whole;
}

int run(const std::string& path) {
  const Scene scene;
  const asperity::MapRequest box{.pressure = {1e4, 5e5}, .velocity = {1e-3, 50}, .checked = 20'000};
  const std::vector<unsigned char> file = asperity::build_friction_map(
      scene.road, scene.rubber, scene.shift, scene.heating, scene.model, scene.adhesion, {background, background}, box);
  if (!write(path, file)) {
    std::fprintf(stderr, "brush_full: %s: cannot be written\n", path.c_str());
    return 1;
  }
  asperity::FrictionMap map;
  std::string why;
  if (!map.load(path.c_str(), why)) {
    std::fprintf(stderr, "brush_full: %s\n", why.c_str());
    return 1;
  }

  // One call for all bristles of a step; outside of the box mu is taken at its side, as the map does.
  using Values = std::vector<double>;
  const auto held = [&](Values& pressure, Values& velocity) {
    for (double& p : pressure) p = std::clamp(p, box.pressure[0], box.pressure[1]);
    for (double& v : velocity) v = std::clamp(v, box.velocity[0], box.velocity[1]);
  };
  const auto cold = [&](Values pressure, Values velocity, const Values&, Values& mu) {
    held(pressure, velocity);
    mu = asperity::friction(scene.road, scene.rubber, scene.model, scene.adhesion, pressure, velocity).mu;
  };
  const auto hot = [&](Values pressure, Values velocity, const Values&, Values& mu) {
    held(pressure, velocity);
    const Values temperature(mu.size(), background);
    mu = asperity::friction(scene.road, scene.rubber, scene.shift, scene.heating, scene.model, scene.adhesion, pressure,
                            velocity, temperature)
             .hot.mu;
  };
  const auto by_map = [&](auto slid) {
    return [&map, slid](const Values& pressure, const Values& velocity, const Values& distance, Values& mu) {
      for (std::size_t i = 0; i < mu.size(); ++i)
        mu[i] = map.mu(pressure[i], velocity[i], asperity::FrictionMap::Outside::clamp,
                       {.background = background, .distance = slid(distance[i])});
    };
  };
  const auto never = by_map([](double) { return 0.0; });
  const auto long_ago = by_map([](double) { return asperity::map_detail::long_slid; });
  const auto as_it_slid = by_map([](double distance) { return distance; });

  const brush::Tire tire, coarse{.bristles = 30};
  const double allowed = map.cold()->info().max_error * growth(tire, *map.cold());
  const double allowed_hot = map.info().max_error * growth(tire, map);
  double largest = 0, largest_hot = 0;
  std::printf(
      "slip,force_over_load,sliding_share,force_over_load_by_map,force_over_load_hot,force_over_load_with_memory\n");
  for (const double slip : brush::slips()) {
    const brush::SlipPoint exact = brush::roll(tire, slip, cold), mapped = brush::roll(tire, slip, never);
    largest = std::max(largest, std::fabs(mapped.force / exact.force - 1));
    std::printf("%g,%.9g,%.6g,%.9g,%.9g,%.9g\n", slip, exact.force, exact.sliding, mapped.force,
                brush::roll(tire, slip, long_ago).force, brush::roll(tire, slip, as_it_slid).force);
  }
  for (const double slip : {0.05, 0.15, 1.0})
    largest_hot = std::max(
        largest_hot, std::fabs(brush::roll(coarse, slip, long_ago).force / brush::roll(coarse, slip, hot).force - 1));
  std::fprintf(stderr, "largest difference of the slip curves %.2g, allowed by the map's max_error %.2g\n", largest,
               allowed);
  std::fprintf(stderr, "of hot ones %.2g, allowed %.2g\n", largest_hot, allowed_hot);
  return largest <= allowed && largest_hot <= allowed_hot ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: brush_full MAP.fmap\n");
    return 2;
  }
  try {
    return run(arguments[1]);
  } catch (const asperity::Error& error) {
    std::fprintf(stderr, "brush_full: %s\n", error.what());
    return 1;
  }
}
