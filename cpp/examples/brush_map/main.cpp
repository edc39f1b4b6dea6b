// A tire model with the friction of a map: C++17 and one header, no library.
//
//   brush_map road.fmap > slip.csv
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
  const auto friction = [&](const std::vector<double>& pressure, const std::vector<double>& velocity,
                            std::vector<double>& mu) {
    for (std::size_t i = 0; i < mu.size(); ++i)
      mu[i] = map.mu(pressure[i], velocity[i], asperity::FrictionMap::Outside::clamp);
  };
  std::printf("slip,force_over_load,sliding_share\n");
  for (const double slip : brush::slips()) {
    const brush::SlipPoint point = brush::roll({}, slip, friction);
    std::printf("%g,%.9g,%.6g\n", point.slip, point.force, point.sliding);
  }
  return 0;
}
