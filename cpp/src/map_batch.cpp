#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "asperity/friction_map.hpp"
#include "checks.hpp"
#include "kernels.hpp"

namespace asperity {

namespace {

struct MapLoops {
  void (*logarithms)(const double* x, double* ln, std::size_t n);
  void (*exponentials)(const double* x, double* e, std::size_t n);
  void (*polynomials)(const double* const* cell, const double* dx, const double* dz, std::size_t n, double* h,
                      double* a);
};

namespace baseline {
#include "map_loops.inc"
}  // namespace baseline

#ifdef __x86_64__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "map_loops.inc"
}  // namespace avx2
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

const MapLoops& map_loops() {
#ifdef __x86_64__
  static const MapLoops chosen = std::strcmp(kernels().name, "avx2") == 0 ? avx2::loops() : baseline::loops();
#else
  static const MapLoops chosen = baseline::loops();
#endif
  return chosen;
}

constexpr std::size_t block = 512;

}  // namespace

class FrictionMapBatch {
 public:
  FrictionMapBatch(const FrictionMap& map, FrictionMap::Outside outside, bool shifts_adhesion)
      : map_(map), outside_(outside), shifts_adhesion_(shifts_adhesion), loops_(map_loops()) {}

  /// mu of points [begin, begin + n), at most a block.
  void mu(const MapColumns& points, std::size_t begin, std::size_t n, double* mu) {
    const double* const pressure = column(points.pressure, begin, n, pressure_);
    const double* const velocity = column(points.velocity, begin, n, velocity_);
    const double* const shift = column(points.shift, begin, n, shift_);
    bool within = !map_.cells_.empty(), shifted = false;
    for (std::size_t i = 0; i < n; ++i) {
      speed_[i] = std::fabs(velocity[i]);
      x_[i] = speed_[i] * shift[i];
      shifted |= shift[i] != 1;
      within &= map_detail::within(pressure[i], map_.info_.pressure) & map_detail::within(x_[i], map_.info_.velocity);
    }
    if (!within) {  // rare: one by one
      for (std::size_t i = 0; i < n; ++i)
        mu[i] = map_.mu(pressure[i], velocity[i], outside_, {shift[i], shifts_adhesion_});
      return;
    }
    loops_.logarithms(x_, x_, n);
    loops_.logarithms(pressure, ln_p_, n);
    const bool adhesion = map_.info_.shear_stress > 0;
    const double* ln_v = x_;
    if (adhesion && shifted && !shifts_adhesion_) {
      loops_.logarithms(speed_, speed_, n);
      ln_v = speed_;
    }
    for (std::size_t i = 0; i < n; ++i) {
      double slope;
      const double z = ln_p_[i] - map_.shear(x_[i], slope);
      cell_[i] = map_.cell_at(x_[i], z);
      dx_[i] = x_[i] - cell_[i][0];
      dz_[i] = z - cell_[i][1];
    }
    loops_.polynomials(cell_, dx_, dz_, n, h_, a_);
    if (map_.info_.hysteresis) {
      loops_.exponentials(h_, mu, n);
    } else {
      std::fill_n(mu, n, 0.0);
    }
    if (!adhesion) return;
    for (std::size_t i = 0; i < n; ++i) {
      const double off = ln_v[i] - map_.ln_reference_;
      a_[i] += map_.ln_shear_stress_ - ln_p_[i] - map_.width_ * off * off;
    }
    loops_.exponentials(a_, a_, n);
    for (std::size_t i = 0; i < n; ++i) mu[i] += a_[i];
  }

 private:
  /// A column's part, or its only entry as often as it is needed.
  static const double* column(std::span<const double> all, std::size_t begin, std::size_t n, double* room) {
    if (all.size() > 1) return &all[begin];
    std::fill_n(room, n, all[0]);
    return room;
  }

  const FrictionMap& map_;
  FrictionMap::Outside outside_;
  bool shifts_adhesion_;
  const MapLoops& loops_;
  double pressure_[block], velocity_[block], shift_[block];
  double x_[block], speed_[block], ln_p_[block], dx_[block], dz_[block], h_[block], a_[block];
  const double* cell_[block];
};

void look_up(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside, bool shifts_adhesion,
             std::span<double> mu) {
  for (const auto& [name, column] : {std::pair{"pressure", points.pressure}, std::pair{"velocity", points.velocity},
                                     std::pair{"shift", points.shift}})
    if (column.size() != 1) require_same_size(name, column.size(), "mu", mu.size());
  FrictionMapBatch batch(map, outside, shifts_adhesion);
  for (std::size_t i = 0; i < mu.size(); i += block) batch.mu(points, i, std::min(block, mu.size() - i), &mu[i]);
}

}  // namespace asperity
