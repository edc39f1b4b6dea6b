// What must hold of whatever the map's reader accepts.
#ifndef PROBE_HPP
#define PROBE_HPP

#include <asperity/friction_map.hpp>
#include <cstdio>
#include <cstdlib>

namespace probe {

/// By its bits: -ffast-math leaves no other way.
inline bool finite(double x) { return (asperity::map_detail::bits(x) & 0x7ff0000000000000) != 0x7ff0000000000000; }
inline bool is_nan(double x) { return asperity::map_detail::is_nan(x); }
inline double nan() { return asperity::map_detail::from_bits(0x7ff8000000000000); }
inline double infinity() { return asperity::map_detail::from_bits(0x7ff0000000000000); }

/// Stays in every build: an assertion that a release leaves out would test nothing.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Whether a temperature is one that the map can be asked for, with Outside::clamp.
inline bool known(const asperity::FrictionMap& map, const asperity::MapTemperature& temperature) {
  const auto [lo, hi] = map.info().temperature;
  return !map.info().heat || temperature.background > 0 || (lo == hi && temperature.background == 0);
}

inline void query(const asperity::FrictionMap& map, double p, double v, const asperity::MapTemperature& temperature) {
  using Outside = asperity::FrictionMap::Outside;
  using Status = asperity::FrictionMap::Status;
  asperity::MapPoint held, point;
  const Status status = map.at(p, v, held, Outside::clamp, temperature);
  require(map.at(p, v, point, Outside::nan, temperature) == status, "one status, whatever is done outside of the box");
  const double clamped = map.mu(p, v, Outside::clamp, temperature), mu = map.mu(p, v, Outside::nan, temperature);
  if (status == Status::not_a_number || status == Status::not_on_this_map || !known(map, temperature)) {
    require(is_nan(held.mu) && is_nan(clamped) && is_nan(held.dmu_dlnv), "NaN where a number is NaN");
  } else {
    require(finite(clamped) && !(clamped < 0), "a finite mu at the side of the box");
    require(finite(held.mu) && finite(held.contact_area) && !(held.hysteresis < 0), "finite parts");
  }
  if (status == Status::ok)
    require(finite(mu) && finite(point.mu), "mu inside of the box");
  else
    require(is_nan(mu) && is_nan(point.mu), "NaN outside of the box");
  const double traction = map.traction(p, v, Outside::clamp, temperature);
  require(!finite(p) || is_nan(v) || is_nan(clamped) || !is_nan(traction), "a traction");
}

/// Points of the box, of its sides and corners, far outside, and what is no place at all.
inline void points(const asperity::FrictionMap& map) {
  const double nan = probe::nan(), infinity = probe::infinity(), denormal = asperity::map_detail::from_bits(1);
  const auto along = [&](const std::array<double, 2>& box) {
    const double lo = box[0], hi = box[1], middle = lo + (hi - lo) / 2;
    return std::array{lo,
                      hi,
                      middle,
                      lo + (hi - lo) * 1e-3,
                      hi - (hi - lo) * 1e-6,
                      lo / 2,
                      hi * 2,
                      -lo,
                      0.0,
                      -0.0,
                      denormal,
                      -denormal,
                      1e308,
                      nan,
                      -nan,
                      infinity,
                      1.0,
                      -infinity};
  };
  for (const double p : along(map.info().pressure))
    for (const double v : along(map.info().velocity)) query(map, p, v, {});
  if (map.info().heat)
    for (const double temperature : along(map.info().temperature))
      for (const double v : along(map.info().velocity))
        for (const double distance : {0.0, 1e-4, asperity::map_detail::long_slid})
          query(map, map.info().pressure[0], v, {1, false, temperature, distance});
  const double lo = map.info().velocity[0], hi = map.info().velocity[1];
  for (const double shift : {0.5, 3e4, 1e-310, 0.0, -1.0, nan, infinity})
    for (const double v : {lo, hi, 0.0, nan}) {
      query(map, map.info().pressure[1], v, {shift, shift < 1});
      query(map, map.info().pressure[1], v, {1, false, shift, -shift});
    }
  const double length = map.sliding_length(hi, map.info().temperature[0], asperity::FrictionMap::Outside::clamp);
  require(map.info().heat ? finite(length) && !(length < 0) : is_nan(length), "a sliding length where there is heat");
}

}  // namespace probe

#endif  // PROBE_HPP
