// The look-up of a map at many points at a time, in columns: the same steps as FrictionMap::mu, on vector units.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "asperity/friction_map.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

struct MapLoops {
  bool (*prepare)(const FrictionMapInfo& box, const double* pressure, const double* velocity, const double* a_T,
                  std::size_t n, double* speed, double* shifted);
  void (*logarithms)(const double* x, double* ln, std::size_t n);
  void (*logarithms_of_both)(const double* x, const double* y, double* ln_x, double* ln_y, std::size_t n);
  bool (*entries)(const map_detail::Grid& grid, const std::int32_t* all, const double* x, const double* z,
                  std::size_t n, std::int32_t* entry);
  void (*polynomials)(const double* cells, const std::int32_t* cell, const double* x, const double* z, std::size_t n,
                      double* h, double* a);
  void (*steps)(const double* temperature, double first, double per_kelvin, double last, std::size_t n,
                std::int32_t* step, double* t);
  void (*warm_polynomials)(const double* cells, std::size_t cell_size, const std::int32_t* cell,
                           const std::int32_t* step, const double* x, const double* z, const double* t, std::size_t n,
                           double* h, double* a);
  void (*exponentials)(const double* x, double* e, std::size_t n);
  void (*add_adhesion)(const double* ln_area, const double* ln_p, const double* ln_v, double ln_shear_stress,
                       double ln_reference, double fall, std::size_t n, double* mu);
};

#define ASPERITY_LOOPS "friction_map/lookup_loops.inc"
#define ASPERITY_AVX512
#include "numerics/vector_units.inc"

MapLoops choose() {
#ifdef __x86_64__
  if (vector_unit() == VectorUnit::avx512) return avx512::loops();
  if (vector_unit() == VectorUnit::avx2) return avx2::loops();
#endif
  return baseline::loops();
}

const MapLoops& map_loops() {
  static const MapLoops chosen = choose();
  return chosen;
}

constexpr std::size_t block = 512;

}  // namespace

class FrictionMapBatch {
 public:
  FrictionMapBatch(const FrictionMap& map, FrictionMap::Outside outside, bool shifts_adhesion)
      : map_(map), outside_(outside), shifts_adhesion_(shifts_adhesion), loops_(map_loops()) {}

  /// mu of points [begin, begin + n), at most a block; how many come before the first without a value.
  std::size_t mu(const MapColumns& points, std::size_t begin, std::size_t n, double* mu) {
    const double* const pressure = column(points.pressure, begin, n, pressure_);
    const double* const velocity = column(points.velocity, begin, n, velocity_);
    const double* const a_T = column(points.a_T, begin, n, a_T_);
    const double* const background = optional(points.background, 0, begin, n, background_);
    const double* const distance = optional(points.distance, map_detail::long_slid, begin, n, distance_);
    const bool within = !map_.cells_.empty() && plain(points, background, distance, n) &&
                        loops_.prepare(map_.info_, pressure, velocity, a_T, n, speed_, x_);
    if (!within) {  // rare: one by one
      std::size_t good = n;
      for (std::size_t i = n; i-- > 0;) {
        mu[i] = map_.mu(pressure[i], velocity[i], outside_, {a_T[i], shifts_adhesion_, background[i], distance[i]});
        if (std::isnan(mu[i])) good = i;
      }
      return good;
    }
    loops_.logarithms_of_both(x_, pressure, x_, ln_p_, n);
    const bool unshifted = shifts_adhesion_ || is_one(points.a_T);
    if (!unshifted && map_.info_.shear_stress > 0) loops_.logarithms(speed_, speed_, n);
    find_mu(map_, x_, unshifted ? x_ : speed_, n, mu);
    if (map_.info_.heat && !points.distance.empty()) blend_cold(background, distance, n, mu);
    return n;
  }

 private:
  static bool is_one(std::span<const double> a_T) { return a_T.size() == 1 && a_T[0] == 1; }

  /// Whether a map takes these temperatures and distances; finds the steps of the temperature.
  bool plain(const MapColumns& points, const double* background, const double* distance, std::size_t n) {
    if (!points.distance.empty() && !std::all_of(distance, distance + n, [](double s) { return s >= 0; })) return false;
    if (!map_.info_.heat) return points.background.empty();
    if (!is_one(points.a_T) || shifts_adhesion_) return false;
    const bool only = map_.steps_ == 0 && points.background.empty();
    const auto [lowest, highest] = map_.info_.temperature;
    int outside = 0;
    for (std::size_t i = 0; i < n; ++i)
      outside |= static_cast<int>(!(background[i] >= lowest && background[i] <= highest));
    if (!only && outside != 0) return false;
    if (map_.steps_ > 0) loops_.steps(background, lowest, map_.steps_per_T_, map_.steps_ - 1.0, n, step_, dT_);
    return true;
  }

  /// mu of a map at ln p and these ln v; ln_v is that which the adhesion takes.
  void find_mu(const FrictionMap& map, const double* x, const double* ln_v, std::size_t n, double* mu) {
    find_cells(map, x, n);
    if (map.steps_ == 0)
      loops_.polynomials(map.cells_.data(), cell_, x, z_, n, h_, a_);
    else
      loops_.warm_polynomials(map.cells_.data(), map.cell_size_, cell_, step_, x, z_, dT_, n, h_, a_);
    if (map.info_.hysteresis)
      loops_.exponentials(h_, mu, n);
    else
      std::fill_n(mu, n, 0.0);
    if (map.info_.shear_stress == 0) return;
    loops_.add_adhesion(a_, ln_p_, ln_v, map.ln_shear_stress_, map.ln_reference_, map.width_, n, mu);
  }

  /// z_ and cell_ of x and ln_p_.
  void find_cells(const FrictionMap& map, const double* x, std::size_t n) {
    if (map.offset_.empty()) {
      std::copy_n(ln_p_, n, z_);
    } else {
      double slope = 0;
      for (std::size_t i = 0; i < n; ++i) z_[i] = ln_p_[i] - map.log_modulus_offset(x[i], slope);
    }
    const bool one_band = map.cuts_.size() == 2;
    if (one_band && loops_.entries(map.grids_[0], map.entries_.data(), x, z_, n, cell_)) return;
    for (std::size_t i = 0; i < n; ++i)
      cell_[i] = static_cast<std::int32_t>((map.cell_at(x[i], z_[i]) - map.cells_.data()) /
                                           static_cast<std::ptrdiff_t>(map.cell_size_));
  }

  /// Adds to the hot mu at x_ the share of the cold one that is left after a distance.
  void blend_cold(const double* background, const double* distance, std::size_t n, double* mu) {
    FrictionMap::Where at;
    double slope = 0;
    for (std::size_t i = 0; i < n; ++i) {
      at.x = x_[i];
      at.background = background[i];
      share_[i] = -map_.log_sliding_length(at, slope);
      speed_[i] = map_.cold_x(at);
    }
    loops_.exponentials(share_, share_, n);
    for (std::size_t i = 0; i < n; ++i) share_[i] = std::fmax(-700, -distance[i] * share_[i]);
    loops_.exponentials(share_, share_, n);
    find_mu(*map_.cold_, speed_, x_, n, cold_);
    for (std::size_t i = 0; i < n; ++i) mu[i] += share_[i] * (cold_[i] - mu[i]);
  }

  /// A column's part, or its only entry as often as it is needed.
  static const double* column(std::span<const double> all, std::size_t begin, std::size_t n, double* room) {
    if (all.size() > 1) return &all[begin];
    std::fill_n(room, n, all[0]);
    return room;
  }
  static const double* optional(std::span<const double> all, double otherwise, std::size_t begin, std::size_t n,
                                double* room) {
    return column(all.empty() ? std::span<const double>(&otherwise, 1) : all, begin, n, room);
  }

  const FrictionMap& map_;
  FrictionMap::Outside outside_;
  bool shifts_adhesion_;
  const MapLoops& loops_;
  double pressure_[block], velocity_[block], a_T_[block], background_[block], distance_[block];
  double x_[block], speed_[block], ln_p_[block], z_[block], h_[block], a_[block];
  double dT_[block], share_[block], cold_[block];
  std::int32_t cell_[block], step_[block];
};

std::size_t look_up(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside,
                    bool shifts_adhesion, std::span<double> mu) {
  for (const auto& [name, column] :
       {std::pair{"pressure", points.pressure}, std::pair{"velocity", points.velocity}, std::pair{"a_T", points.a_T}})
    if (column.size() != 1) require_same_size(name, column.size(), "mu", mu.size());
  for (const auto& [name, column] :
       {std::pair{"background", points.background}, std::pair{"distance", points.distance}})
    if (column.size() > 1) require_same_size(name, column.size(), "mu", mu.size());
  FrictionMapBatch batch(map, outside, shifts_adhesion);
  std::size_t first_bad = mu.size();
  for (std::size_t i = 0; i < mu.size(); i += block) {
    heed();
    const std::size_t n = std::min(block, mu.size() - i), good = batch.mu(points, i, n, &mu[i]);
    if (good < n) first_bad = std::min(first_bad, i + good);
  }
  return first_bad;
}

}  // namespace asperity
