// A tire model with the friction of a map: C++17 and one header, no library.
//
//   brush_map road.fmap > slip.csv
//
// Of a map with heat the force is that of rubber that has slid for long; beside it that of rubber that never heats up,
// and that of rubber that heats up over the distance which it slides in the contact patch.
#include <asperity/friction_map.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "../brush.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: brush_map MAP.fmap\n");
    return 2;
  }
  asperity::FrictionMap map;
  std::string why;
  if (!map.load(arguments[1], why)) {
    std::fprintf(stderr, "brush_map: %s\n", why.c_str());
    return 1;
  }

  // At the ends of the patch the pressure goes to zero, and below the map's box mu is taken at its side.
  const auto after = [&](auto slid) {
    return [&map, slid](const std::vector<double>& pressure, const std::vector<double>& velocity,
                        const std::vector<double>& distance, std::vector<double>& mu) {
      asperity::MapTemperature state;
      state.background = map.info().temperature[0];  // of several the lowest; 0 where the map has no heat
      for (std::size_t i = 0; i < mu.size(); ++i) {
        state.distance = slid(distance[i]);
        mu[i] = map.mu(pressure[i], velocity[i], asperity::FrictionMap::Outside::clamp, state);
      }
    };
  };
  const auto long_ago = after([](double) { return asperity::map_detail::long_slid; });
  const auto never = after([](double) { return 0.0; });
  const auto as_it_slid = after([](double distance) { return distance; });
  const bool heat = map.info().heat;
  std::printf("slip,force_over_load,sliding_share%s\n",
              heat ? ",force_over_load_cold,force_over_load_with_memory" : "");
  for (const double slip : brush::slips()) {
    const brush::SlipPoint point = brush::roll({}, slip, long_ago);
    std::printf("%g,%.9g,%.6g", point.slip, point.force, point.sliding);
    if (heat) std::printf(",%.9g,%.9g", brush::roll({}, slip, never).force, brush::roll({}, slip, as_it_slid).force);
    std::printf("\n");
  }
  return 0;
}
