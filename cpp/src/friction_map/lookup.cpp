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

/// ln mu_H and ln A/A0 and their slopes over x and z, a column each.
struct MapSlopes {
  double *h, *a, *h_x, *a_x, *h_z, *a_z;
};

/// ln mu_H and ln A/A0, a column each.
struct LogarithmsOfBoth {
  double *h, *a;
};

/// Cubics of ln s0 over steps of x, each beside by how much that of the next row of T0 differs; or a row's alone.
struct SlidingTable {
  const double* cubics;
  double first_x, per_x, last_column, first_T0, rows_per_T0, last_row;
  std::int32_t row_size;
};

/// Cubics of ln a_T over steps of T0, and between which x a_T may lead.
struct ColdVelocities {
  const double* cubics;
  double steps_per_T0, lowest, highest;
};

/// ln a_T = a t / (1 + b t), and the sides of ln v and of it.
struct SlantedBox {
  double a, b, first_T0, first_x, last_x, least_shift, most_shift, last_step, step;
};

/// ln mu_A = ln A/A0 + ln_shear_stress - ln p - fall (ln v - ln_reference)^2
struct MapAdhesion {
  double ln_shear_stress, ln_reference, fall;
};

/// Blocks of polynomials of each cell, so many numbers from one cell to the next, and the cells' corners.
struct Cells {
  const double *polynomials, *corners;
  std::size_t size;
};

#define ASPERITY_LOOPS "friction_map/lookup_loops.inc"
#define ASPERITY_AVX512
#include "numerics/vector_units.inc"

#ifdef __x86_64__
#define ASPERITY_LOOP(loop)                                                  \
  decltype(&baseline::loop) loop = unit == VectorUnit::avx512 ? avx512::loop \
                                   : unit == VectorUnit::avx2 ? avx2::loop   \
                                                              : baseline::loop
#else
#define ASPERITY_LOOP(loop) decltype(&baseline::loop) loop = baseline::loop
#endif

/// The loops of lookup_loops.inc for this machine's vector unit.
struct MapLoops {
  VectorUnit unit = vector_unit();
  ASPERITY_LOOP(prepare);
  ASPERITY_LOOP(logarithms);
  ASPERITY_LOOP(logarithms_of_both);
  ASPERITY_LOOP(entries);
  ASPERITY_LOOP(polynomials);
  ASPERITY_LOOP(all_within);
  ASPERITY_LOOP(steps);
  ASPERITY_LOOP(slant);
  ASPERITY_LOOP(at_temperature);
  ASPERITY_LOOP(sliding_lengths);
  ASPERITY_LOOP(cold_velocities);
  ASPERITY_LOOP(held_sums);
  ASPERITY_LOOP(blend);
  ASPERITY_LOOP(exponentials);
  ASPERITY_LOOP(parts);
  ASPERITY_LOOP(slopes);
  ASPERITY_LOOP(chain_rule);
};
#undef ASPERITY_LOOP

const MapLoops& map_loops() {
  static const MapLoops chosen;
  return chosen;
}

constexpr std::size_t capacity = 512;  // points of a block

}  // namespace

class FrictionMapBatch {
 public:
  FrictionMapBatch(const FrictionMap& map, FrictionMap::Outside outside, bool shifts_adhesion)
      : map_(map), outside_(outside), shifts_adhesion_(shifts_adhesion), loops_(map_loops()) {}

  /// Before n points, more than the cells: where they share T0, sums over it once for the cells' polynomials.
  void share_temperature(const MapColumns& points, std::size_t n) {
    if (!map_.info_.heat || map_.steps_ == 0 || map_.is_slanted_ || points.background.size() > 1 ||
        n < map_.info_.cells)
      return;
    const auto [lowest, highest] = map_.info_.temperature;
    const double background = points.background.empty() ? 0 : points.background[0];
    if (!(background >= lowest && background <= highest)) return;
    FrictionMap::Where at;
    map_.set_step(background, at);
    shared_log_a_T_ = map_.log_a_T(at);
    const Cells of = cells_of(map_);
    at_shared_T0_.resize(map_.info_.cells * map_detail::block_size / std::size(map_detail::Line{}.number));
    loops_.at_temperature(of, static_cast<std::size_t>(at.step), at.dT, map_.info_.cells,
                          reinterpret_cast<double*>(at_shared_T0_.data()));
  }

  /// A number at points [begin, begin + n), at most a block; how many come before the first without a value.
  std::size_t find(MapQuantity quantity, const MapColumns& points, std::size_t begin, std::size_t n, double* result) {
    const Block at = take(points, begin, n);
    if (!at.within || quantity == MapQuantity::lateral)
      return one_by_one(at, n, [&](std::size_t i, const MapTemperature& temperature) {
        return result[i] = value(quantity, at.pressure[i], at.velocity[i], temperature);
      });
    if (map_.is_slanted_)
      find_slanted(at, n);
    else
      find_logarithms(map_, x_, n, hot_);
    if (map_.info_.heat && !points.distance.empty())
      blend_cold(quantity, at, n, result);
    else
      exponentials(quantity, map_, hot_, at.ln_v, n, result);
    if (quantity == MapQuantity::traction)
      for (std::size_t i = 0; i < n; ++i) result[i] *= std::copysign(at.pressure[i], at.velocity[i]);
    return n;
  }

  /// d mu / d ln p and d mu / d ln v likewise.
  std::size_t find_slopes(const MapColumns& points, std::size_t begin, std::size_t n, double* by_p, double* by_v) {
    const Block at = take(points, begin, n);
    if (!at.within || map_.is_slanted_ || (map_.info_.heat && !points.distance.empty()))
      return one_by_one(at, n, [&](std::size_t i, const MapTemperature& temperature) {
        MapPoint found;
        map_.at(at.pressure[i], at.velocity[i], found, outside_, temperature);
        by_p[i] = found.dmu_dlnp;
        by_v[i] = found.dmu_dlnv;
        return found.mu;
      });
    if (map_.offset_.empty()) std::fill_n(offset_slope_, n, 0.0);
    const double* const z = find_cells(map_, x_, n);
    const MapSlopes found{hot_.h, hot_.a, h_x_, a_x_, h_z_, a_z_};
    loops_.slopes(cells_of(map_), cell_, steps_of(map_), x_, z, dT_, n, found);
    exponentials(MapQuantity::hysteresis, map_, hot_, at.ln_v, n, hot_.h);
    exponentials(MapQuantity::adhesion, map_, hot_, at.ln_v, n, hot_.a);
    loops_.chain_rule(hot_.h, hot_.a, found, offset_slope_, at.ln_v, map_.ln_reference_, map_.width_, n, by_p, by_v);
    return n;
  }

 private:
  struct Block {
    const double *pressure, *velocity, *a_T, *background, *distance, *direction;
    const double* ln_v;  // as the adhesion takes it
    bool within;         // all of them in the box, with temperatures that the map takes: x_ and ln_p_ are there
  };

  Block take(const MapColumns& points, std::size_t begin, std::size_t n) {
    Block at{column(points.pressure, begin, n, pressure_),
             column(points.velocity, begin, n, velocity_),
             column(points.a_T, begin, n, a_T_),
             optional(points.background, 0, begin, n, background_),
             optional(points.distance, map_detail::long_slid, begin, n, distance_),
             optional(points.direction, 0, begin, n, direction_),
             x_,
             false};
    at.within = !map_.cells_.empty() && plain(points, at.background, at.distance, at.direction, n) &&
                loops_.prepare(map_.info_, at.pressure, at.velocity, at.a_T, n, speed_, x_);
    if (!at.within) return at;
    loops_.logarithms_of_both(x_, at.pressure, x_, ln_p_, n);
    if (!shifts_adhesion_ && !is_one(points.a_T)) {
      if (map_.info_.shear_stress > 0) loops_.logarithms(speed_, speed_, n);
      at.ln_v = speed_;
    }
    return at;
  }

  /// Rare. `act` gives the number that is NaN where there is no value.
  template <class Act>
  std::size_t one_by_one(const Block& at, std::size_t n, Act act) {
    std::size_t good = n;
    for (std::size_t i = n; i-- > 0;)
      if (std::isnan(act(i, {at.a_T[i], shifts_adhesion_, at.background[i], at.distance[i], at.direction[i]})))
        good = i;
    return good;
  }

  [[nodiscard]] double value(MapQuantity quantity, double pressure, double velocity,
                             const MapTemperature& temperature) const {
    if (quantity == MapQuantity::mu) return map_.mu(pressure, velocity, outside_, temperature);
    if (quantity == MapQuantity::traction) return map_.traction(pressure, velocity, outside_, temperature);
    if (quantity == MapQuantity::lateral) return map_.lateral(pressure, velocity, outside_, temperature);
    MapPoint found;
    map_.at(pressure, velocity, found, outside_, temperature);
    if (quantity == MapQuantity::hysteresis) return found.hysteresis;
    return quantity == MapQuantity::adhesion ? found.adhesion : found.contact_area;
  }

  static bool is_one(std::span<const double> a_T) { return a_T.size() == 1 && a_T[0] == 1; }

  /// Whether a map takes these temperatures and distances; finds the steps of the temperature.
  bool plain(const MapColumns& points, const double* background, const double* distance, const double* direction,
             std::size_t n) {
    const auto entries = [n](std::span<const double> of) { return of.size() > 1 ? n : 1; };
    if (!points.distance.empty() && !loops_.all_within(distance, 0, HUGE_VAL, entries(points.distance))) return false;
    if (!loops_.all_within(direction, -1e300, 1e300, entries(points.direction))) return false;
    if (!map_.info_.heat) return points.background.empty() && map_.steps_ == 0;
    if (!is_one(points.a_T) || shifts_adhesion_) return false;
    const bool only = map_.steps_ == 0 && points.background.empty();
    const auto [lowest, highest] = map_.info_.temperature;
    if (!only && !loops_.all_within(background, lowest, highest, entries(points.background))) return false;
    if (map_.steps_ > 0 && !map_.is_slanted_ && at_shared_T0_.empty())
      loops_.steps(background, lowest, map_.steps_per_T_, map_.steps_ - 1.0, n, step_, dT_);
    return true;
  }

  /// Of a map at ln p and these ln v.
  void find_logarithms(const FrictionMap& map, const double* x, std::size_t n, const LogarithmsOfBoth& to) {
    const double* const z = find_cells(map, x, n);
    loops_.polynomials(cells_of(map), cell_, steps_of(map), x, z, dT_, n, to.h, to.a);
  }

  /// Of a slanted map; leaves ln v a_T in slanted_x_.
  void find_slanted(const Block& at, std::size_t n) {
    const SlantedBox box{map_.shift_[0],   map_.shift_[1],    map_.info_.temperature[0],
                         map_.offset_x_,   map_.last_x_,      map_.log_a_T_[0],
                         map_.log_a_T_[1], map_.steps_ - 1.0, map_.step_of_share_};
    loops_.slant(box, x_, at.background, n, slanted_x_, step_, dT_);
    find_cells_at(map_, ln_p_, slanted_x_, n);
    loops_.polynomials(cells_of(map_), cell_, step_, ln_p_, slanted_x_, dT_, n, hot_.h, hot_.a);
  }

  static MapAdhesion adhesion_of(const FrictionMap& map) {
    return {map.ln_shear_stress_, map.ln_reference_, map.width_};
  }

  /// mu for the traction; ln_v is that which the adhesion takes. `result` may be a column of `of`.
  void exponentials(MapQuantity quantity, const FrictionMap& map, const LogarithmsOfBoth& of, const double* ln_v,
                    std::size_t n, double* result) {
    if (quantity == MapQuantity::contact_area) return loops_.exponentials(of.a, result, n);
    const bool has_hysteresis = quantity != MapQuantity::adhesion && map.info_.hysteresis;
    const bool has_adhesion = quantity != MapQuantity::hysteresis && map.info_.shear_stress > 0;
    if (!has_hysteresis && !has_adhesion) return std::fill_n(result, n, 0.0), void();
    loops_.parts(has_hysteresis ? of.h : nullptr, has_adhesion ? of.a : nullptr, ln_p_, ln_v, adhesion_of(map), n,
                 result);
  }

  /// z of x and ln_p_; the cells there in cell_, and the slope of s over x in offset_slope_ where the map has s.
  const double* find_cells(const FrictionMap& map, const double* x, std::size_t n) {
    const double* const z = map.offset_.empty() ? ln_p_ : z_;
    if (!map.offset_.empty())
      for (std::size_t i = 0; i < n; ++i) z_[i] = ln_p_[i] - map.log_modulus_offset(x[i], offset_slope_[i]);
    find_cells_at(map, x, z, n);
    return z;
  }

  /// Of a few bands on vector units, which go through all of them for each point.
  void find_cells_at(const FrictionMap& map, const double* x, const double* z, std::size_t n) {
    const std::size_t bands = map.ends_.size();
    if (bands <= 4 && loops_.entries(map.grids_.data(), map.ends_.data(), bands, map.entries_.data(), x, z, n, cell_))
      return;
    for (std::size_t i = 0; i < n; ++i) cell_[i] = static_cast<std::int32_t>(map.entry_at(x[i], z[i]));
  }

  /// As its points find them: at the T0 that they share, if there is one.
  [[nodiscard]] Cells cells_of(const FrictionMap& map) const {
    const bool shared = map.steps_ > 0 && !at_shared_T0_.empty();
    return {shared ? map_detail::numbers(at_shared_T0_) : map.cells(), map.corners_.data(),
            shared ? map_detail::block_size : map.cell_size_};
  }

  /// Of the temperature, where a map has them and its points do not share one.
  [[nodiscard]] const std::int32_t* steps_of(const FrictionMap& map) const {
    return map.steps_ > 0 && at_shared_T0_.empty() ? step_ : nullptr;
  }

  /// A number at x_ between that of hot_ and the cold one, of which a share is left after a distance.
  void blend_cold(MapQuantity quantity, const Block& place, std::size_t n, double* result) {
    const SlidingTable lengths{map_detail::numbers(map_.sliding_),
                               map_.offset_x_,
                               map_.sliding_per_x_,
                               static_cast<double>(map_.last_column_),
                               map_.info_.temperature[0],
                               map_.rows_per_T_,
                               static_cast<double>(std::max<std::int64_t>(map_.last_row_, 0)),
                               static_cast<std::int32_t>(map_.row_size_)};
    loops_.sliding_lengths(lengths, x_, place.background, n, ln_s0_, speed_, cell_);
    const double* x = x_;
    if (map_.is_slanted_) {
      x = speed_;
      loops_.held_sums(slanted_x_, 0, map_.cold_->offset_x_, map_.cold_->last_x_, n, speed_);
    } else if (map_.steps_ > 0) {
      x = speed_;
      const ColdVelocities shift{map_.shift_.data(), map_.steps_per_T_, map_.cold_->offset_x_, map_.cold_->last_x_};
      if (at_shared_T0_.empty())
        loops_.cold_velocities(shift, step_, dT_, x_, n, speed_);
      else
        loops_.held_sums(x_, shared_log_a_T_, shift.lowest, shift.highest, n, speed_);
    }
    find_logarithms(*map_.cold_, x, n, cold_);
    exponentials(quantity, map_, hot_, x_, n, result);
    exponentials(quantity, *map_.cold_, cold_, x_, n, cold_.h);
    loops_.blend(ln_s0_, place.distance, cold_.h, n, result);
  }

  /// A column's part, or its only entry as often as the first block, none of which is longer, needs it.
  static const double* column(std::span<const double> all, std::size_t begin, std::size_t n, double* room) {
    if (all.size() > 1) return &all[begin];
    if (begin == 0) std::fill_n(room, n, all[0]);
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
  std::vector<map_detail::Line> at_shared_T0_;  // the cells' polynomials of a map of this T0, or none
  double shared_log_a_T_ = 0;
  double pressure_[capacity], velocity_[capacity], a_T_[capacity], background_[capacity], distance_[capacity],
      direction_[capacity];
  double x_[capacity], speed_[capacity], ln_p_[capacity], z_[capacity];
  double hot_h_[capacity], hot_a_[capacity], cold_h_[capacity], cold_a_[capacity];
  LogarithmsOfBoth hot_{hot_h_, hot_a_}, cold_{cold_h_, cold_a_};
  double dT_[capacity], ln_s0_[capacity], slanted_x_[capacity];
  double offset_slope_[capacity], h_x_[capacity], a_x_[capacity], h_z_[capacity], a_z_[capacity];
  std::int32_t cell_[capacity], step_[capacity];
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
  FrictionMapBatch batch(map, outside, shifts_adhesion);
  batch.share_temperature(points, result.size());
  const char* const name = quantity == MapQuantity::mu ? "mu" : "result";
  return in_blocks(points, name, result.size(), [&](std::size_t begin, std::size_t n) {
    return batch.find(quantity, points, begin, n, &result[begin]);
  });
}

std::size_t look_up_slopes(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside,
                           bool shifts_adhesion, std::span<double> dmu_dlnp, std::span<double> dmu_dlnv) {
  require_same_size("dmu_dlnp", dmu_dlnp.size(), "dmu_dlnv", dmu_dlnv.size());
  FrictionMapBatch batch(map, outside, shifts_adhesion);
  batch.share_temperature(points, dmu_dlnp.size());
  return in_blocks(points, "dmu_dlnp", dmu_dlnp.size(), [&](std::size_t begin, std::size_t n) {
    return batch.find_slopes(points, begin, n, &dmu_dlnp[begin], &dmu_dlnv[begin]);
  });
}

}  // namespace asperity
