// The look-up of a map at many points at a time, in columns: the same steps as FrictionMap::mu and at, on vector units.
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

constexpr std::size_t capacity = 512;  // points of a block

/// What loops need of a map. ln mu_A = ln A/A0 + ln_shear_stress - ln p - width (ln v - ln_reference)^2.
struct Tables : map_detail::Scales {
  const FrictionMapInfo* info;
  const double *polynomials, *corners;  // of cells
  const map_detail::Grid* grids;
  const double* ends;  // of bands
  std::size_t bands;
  const std::int32_t* entries;
  const double *offset, *shift, *sliding;  // cubics of s(x), of ln a_T over T0, and of ln s0
};

/// Columns of a block.
struct Points {
  const double *pressure, *velocity, *a_T, *background, *distance, *direction;
};

/// What is known of a block's points.
struct Block {
  double speed[capacity], x[capacity], ln_p[capacity];
  const double* ln_v;                                       // as the adhesion takes it
  double z[capacity], offset_slope[capacity], t[capacity];  // slope of s over x; from a node of the third axis
  std::int32_t cell[capacity], step[capacity];
  double h[capacity], a[capacity];                                    // ln mu_H and ln A/A0,
  double h_x[capacity], a_x[capacity], h_z[capacity], a_z[capacity];  // their slopes
  double hysteresis[capacity], adhesion[capacity];
  double cold_x[capacity], cold[capacity], ln_s0[capacity];
};

/// Of which a number is the sum.
struct Parts {
  bool hysteresis, area, adhesion;
};

#define ASPERITY_LOOPS "friction_map/lookup_loops.inc"
#define ASPERITY_AVX512
#include "numerics/vector_units.inc"

/// The loops of lookup_loops.inc for this machine's vector unit.
struct MapLoops {
  decltype(&baseline::prepare) prepare = baseline::prepare;
  decltype(&baseline::look_up) look_up = baseline::look_up;
  decltype(&baseline::look_up_slopes) look_up_slopes = baseline::look_up_slopes;
};

const MapLoops& map_loops() {
  static const MapLoops chosen = [] {
    [[maybe_unused]] const VectorUnit unit = vector_unit();
#ifdef __x86_64__
    if (unit == VectorUnit::avx512) return MapLoops{avx512::prepare, avx512::look_up, avx512::look_up_slopes};
    if (unit == VectorUnit::avx2) return MapLoops{avx2::prepare, avx2::look_up, avx2::look_up_slopes};
#endif
    return MapLoops{};
  }();
  return chosen;
}

}  // namespace

class FrictionMapBatch {
 public:
  FrictionMapBatch(const FrictionMap& map, const MapColumns& points, std::size_t n, FrictionMap::Outside outside,
                   bool shifts_adhesion)
      : map_(map), columns_(points), outside_(outside), shifts_adhesion_(shifts_adhesion), tables_(tables_of(map)) {
    if (map.cold_) cold_ = tables_of(*map.cold_);
    if (map.info_.heat && map.steps_ > 0 && !map.is_slanted_ && points.background.size() == 1 && n >= map.info_.cells)
      share(points.background[0]);
  }

  /// A number at points [begin, begin + n), at most a block; how many come before the first without a value.
  std::size_t find(MapQuantity quantity, std::size_t begin, std::size_t n, double* result) {
    const Points of = points(begin, n);
    if (quantity == MapQuantity::lateral || !prepare(of, n))
      return one_by_one(of, n, [&](std::size_t i, const MapTemperature& temperature) {
        return result[i] = value(quantity, of.pressure[i], of.velocity[i], temperature);
      });
    using enum MapQuantity;
    const bool is_sum = quantity == mu || quantity == traction;
    const Parts parts{(is_sum || quantity == hysteresis) && map_.info_.hysteresis, quantity == contact_area,
                      (is_sum || quantity == adhesion) && has_adhesion()};
    const bool remembers = map_.info_.heat && !columns_.distance.empty();
    loops_.look_up(tables_, remembers ? &cold_ : nullptr, parts, of, n, block_, result);
    for (std::size_t i = 0; i < n && quantity == traction; ++i)
      result[i] *= std::copysign(of.pressure[i], of.velocity[i]);
    return n;
  }

  /// d mu / d ln p and d mu / d ln v likewise.
  std::size_t find_slopes(std::size_t begin, std::size_t n, double* by_p, double* by_v) {
    const Points of = points(begin, n);
    if (map_.is_slanted_ || (map_.info_.heat && !columns_.distance.empty()) || !prepare(of, n))
      return one_by_one(of, n, [&](std::size_t i, const MapTemperature& temperature) {
        MapPoint at;
        map_.at(of.pressure[i], of.velocity[i], at, outside_, temperature);
        by_p[i] = at.dmu_dlnp;
        by_v[i] = at.dmu_dlnv;
        return at.mu;
      });
    loops_.look_up_slopes(tables_, of, n, block_, by_p, by_v);
    return n;
  }

 private:
  static Tables tables_of(const FrictionMap& map) {
    return {map,
            &map.info_,
            map.cells(),
            map.corners_.data(),
            map.grids_.data(),
            map.ends_.data(),
            map.ends_.size(),
            map.entries_.data(),
            map.offset_.data(),
            map.shift_.data(),
            map_detail::numbers(map.sliding_)};
  }

  /// The cells' polynomials at the one T0 of many points, which then need no sums over it.
  void share(double background) {
    if (!(background >= map_.info_.temperature[0] && background <= map_.info_.temperature[1])) return;
    const FrictionMap::Third third = map_.third_at(background);
    at_T0_.resize(map_.info_.cells * map_detail::block_size / std::size(map_detail::Line{}.number));
    double* const to = at_T0_.data()->number;
    for (std::size_t i = 0; i < map_.info_.cells; ++i)
      FrictionMap::to_temperature(
          map_.cells() + map_.cell_size_ * i + 4 * map_detail::block_size * static_cast<std::size_t>(third.step),
          third.d, to + map_detail::block_size * i);
    tables_.polynomials = to;
    tables_.cell_size_ = map_detail::block_size;
    tables_.steps_ = 0;
  }

  Points points(std::size_t begin, std::size_t n) {
    const double only = map_.steps_ == 0 ? map_.info_.temperature[0] : 0;
    return {column(columns_.pressure, 0, begin, n, filled_[0]),
            column(columns_.velocity, 0, begin, n, filled_[1]),
            column(columns_.a_T, 1, begin, n, filled_[2]),
            column(columns_.background, only, begin, n, filled_[3]),
            column(columns_.distance, map_detail::long_slid, begin, n, filled_[4]),
            column(columns_.direction, 0, begin, n, filled_[5])};
  }

  /// A column's part, or its only entry as often as the first block, none of which is longer, needs it.
  static const double* column(std::span<const double> all, double otherwise, std::size_t begin, std::size_t n,
                              double* room) {
    if (all.size() > 1) return &all[begin];
    if (begin == 0) std::fill_n(room, n, all.empty() ? otherwise : all[0]);
    return room;
  }

  /// Whether loops can look all of the points up: in the box, with temperatures that the map takes as they are.
  bool prepare(const Points& of, std::size_t n) {
    const bool is_unshifted = columns_.a_T.size() == 1 && columns_.a_T[0] == 1;
    return !map_.cells_.empty() && !map_.info_.turns && (!map_.info_.heat || (is_unshifted && !shifts_adhesion_)) &&
           loops_.prepare(map_.info_, of, n, is_unshifted || shifts_adhesion_ || !has_adhesion(), block_);
  }

  [[nodiscard]] bool has_adhesion() const { return map_.info_.shear_stress > 0; }

  /// Rare. `act` gives the number that is NaN where there is no value.
  template <class Act>
  std::size_t one_by_one(const Points& of, std::size_t n, Act act) {
    std::size_t good = n;
    for (std::size_t i = n; i-- > 0;)
      if (std::isnan(act(i, {of.a_T[i], shifts_adhesion_, columns_.background.empty() ? 0 : of.background[i],
                             of.distance[i], of.direction[i]})))
        good = i;
    return good;
  }

  [[nodiscard]] double value(MapQuantity quantity, double pressure, double velocity,
                             const MapTemperature& temperature) const {
    if (quantity == MapQuantity::mu) return map_.mu(pressure, velocity, outside_, temperature);
    if (quantity == MapQuantity::traction) return map_.traction(pressure, velocity, outside_, temperature);
    MapPoint at;
    map_.at(pressure, velocity, at, outside_, temperature);
    return quantity == MapQuantity::hysteresis ? at.hysteresis
           : quantity == MapQuantity::adhesion ? at.adhesion
           : quantity == MapQuantity::lateral  ? at.lateral
                                               : at.contact_area;
  }

  const FrictionMap& map_;
  const MapColumns& columns_;
  FrictionMap::Outside outside_;
  bool shifts_adhesion_;
  const MapLoops& loops_ = map_loops();
  Tables tables_, cold_{};
  std::vector<map_detail::Line> at_T0_;  // the cells' polynomials, where points share T0
  double filled_[6][capacity];
  Block block_;
};

namespace {

/// `act` on blocks of points, of n in all; the first point without a value.
template <class Act>
std::size_t in_blocks(const MapColumns& points, const char* name, std::size_t n, Act act) {
  for (const auto& [column_name, column] :
       {std::pair{"pressure", points.pressure}, std::pair{"velocity", points.velocity}, std::pair{"a_T", points.a_T}})
    if (column.size() != 1) require_same_size(column_name, column.size(), name, n);
  for (const auto& [column_name, column] :
       {std::pair{"background", points.background}, std::pair{"distance", points.distance},
        std::pair{"direction", points.direction}})
    if (column.size() > 1) require_same_size(column_name, column.size(), name, n);
  std::size_t first_bad = n;
  for (std::size_t i = 0; i < n; i += capacity) {
    heed();
    const std::size_t many = std::min(capacity, n - i), good = act(i, many);
    if (good < many) first_bad = std::min(first_bad, i + good);
  }
  return first_bad;
}

}  // namespace

std::size_t look_up(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside,
                    bool shifts_adhesion, std::span<double> mu) {
  return look_up(MapQuantity::mu, map, points, outside, shifts_adhesion, mu);
}

std::size_t look_up(MapQuantity quantity, const FrictionMap& map, const MapColumns& points,
                    FrictionMap::Outside outside, bool shifts_adhesion, std::span<double> result) {
  FrictionMapBatch batch(map, points, result.size(), outside, shifts_adhesion);
  const char* const name = quantity == MapQuantity::mu ? "mu" : "result";
  return in_blocks(points, name, result.size(),
                   [&](std::size_t begin, std::size_t n) { return batch.find(quantity, begin, n, &result[begin]); });
}

std::size_t look_up_slopes(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside,
                           bool shifts_adhesion, std::span<double> dmu_dlnp, std::span<double> dmu_dlnv) {
  require_same_size("dmu_dlnp", dmu_dlnp.size(), "dmu_dlnv", dmu_dlnv.size());
  FrictionMapBatch batch(map, points, dmu_dlnp.size(), outside, shifts_adhesion);
  return in_blocks(points, "dmu_dlnp", dmu_dlnp.size(), [&](std::size_t begin, std::size_t n) {
    return batch.find_slopes(begin, n, &dmu_dlnp[begin], &dmu_dlnv[begin]);
  });
}

}  // namespace asperity
