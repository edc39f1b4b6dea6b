// What `host.c` prints, from the map itself by its header: look_up MAP < points.txt
#include <asperity/friction_map.hpp>
#include <cstdio>

int main(int count, char** arguments) {
  asperity::FrictionMap map;
  std::string why;
  if (count != 2 || !map.load(arguments[1], why)) return 1;
  unsigned long long bits[4];
  while (std::scanf("%llx %llx %llx %llx", &bits[0], &bits[1], &bits[2], &bits[3]) == 4) {
    const double pressure = asperity::map_detail::from_bits(bits[0] << 32 | bits[1]);
    const double velocity = asperity::map_detail::from_bits(bits[2] << 32 | bits[3]);
    constexpr auto outside = asperity::FrictionMap::Outside::clamp;
    asperity::MapPoint at;
    const bool inside = map.at(pressure, velocity, at, outside) == asperity::FrictionMap::Status::ok;
    for (double x : {at.mu, at.hysteresis, at.adhesion, at.contact_area, map.traction(pressure, velocity, outside),
                     at.dmu_dlnp, at.dmu_dlnv})
      std::printf("%016llx ", static_cast<unsigned long long>(asperity::map_detail::bits(x)));
    std::printf("%d\n", inside ? 1 : 0);
  }
}
