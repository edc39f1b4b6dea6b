// Copyright (c) 2026 the asperity authors
// SPDX-License-Identifier: 0BSD
// Permission to use, copy, modify, and/or distribute this file for any purpose with or without fee is hereby granted.
// THE SOFTWARE IS PROVIDED "AS IS" AND THE AUTHOR DISCLAIMS ALL WARRANTIES WITH REGARD TO THIS SOFTWARE INCLUDING ALL
// IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS. IN NO EVENT SHALL THE AUTHOR BE LIABLE FOR ANY SPECIAL, DIRECT,
// INDIRECT, OR CONSEQUENTIAL DAMAGES OR ANY DAMAGES WHATSOEVER RESULTING FROM LOSS OF USE, DATA OR PROFITS, WHETHER IN
// AN ACTION OF CONTRACT, NEGLIGENCE OR OTHER TORTIOUS ACTION, ARISING OUT OF OR IN CONNECTION WITH THE USE OR
// PERFORMANCE OF THIS SOFTWARE.
//
// Rubber friction looked up in a map, for simulators: this file and the standard library of C++17, nothing else, under
// the notice above, which holds for this file alone. Queries allocate nothing, throw nothing, change nothing: any
// number of threads may share a map. C, Fortran and Simulink: see the end of the file.
//
//   asperity::FrictionMap map;
//   std::string why;
//   if (!map.load("road.fmap", why)) ...                        // `why` says in a line what is wrong with the file
//   double mu = map.mu(2e5, 0.3);                               // pressure [Pa], velocity [m/s]
//
// A map holds ln of mu_H (hysteresis) and of A/A0, over x = ln v and z = ln p - s(x), each a bicubic polynomial a
// cell, with continuous first derivatives (C1) but between bands of z: where a correction changes its state, or, of a
// slanted map below, lines of constant v a_T the sides of the box that they end at. s is zero, or ln E* of the
// Greenwood-Williamson correction, which depends on p / E* alone. The adhesion is added in closed form,
//   mu = mu_H + (tau_f0 / p) (A/A0) exp(-c log10(v / v0)^2).
// The temperature shifts the velocity of mu_H and A/A0 by a_T; the adhesion takes the true velocity.
//
// A map with heat holds the friction of rubber that the friction warms, for one temperature T0 of the background or
// for a range of them, over which each cell holds cubics in T0 as well. No a_T leads from one T0 to another there: it
// is refused, as is a T0 on a map that knows none. Beside it lies the map without heat and the distance s0 over which
// sliding that begins heats up, so that after a distance s slid since rest
//   mu(s) = mu_hot + (mu_cold - mu_hot) exp(-s / s0),
//   map.mu(2e5, 0.3, Outside::clamp, {.background = 293.15, .distance = 1e-3});   // T0 [K], s [m] (C++20's way to say)
// B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006); arXiv:1007.2713. s0(v, T0) is that at the middle of the
// box's pressures (geometric), of which it hardly depends.
//
// A map of a surface with a lay knows directions: a look-up takes the angle of sliding, `direction` [rad], from x
// towards y, of the axes that the map was made in, and gives the force across the sliding too, `lateral`: on the
// moving body it is -sigma0 (mu s + lateral n), s the unit vector of sliding and n that turned by +90 degrees. Half a
// turn changes neither. Its cells hold cubics in the angle, and beside it lies the map of lateral / mu_H. With heat, as
// of a scan, it is for one direction, and `direction` is ignored.
//   map.mu(2e5, 0.3, Outside::clamp, {.direction = 0.5});  map.lateral(2e5, 0.3, Outside::clamp, {.direction = 0.5});
//
// mu is even in v: mu(p, -v) = mu(p, v); the traction is odd, and 0 at v = 0 and where p <= 0, whatever the map's box.
// Outside of the box, v = 0 and p <= 0 among it, the caller otherwise chooses (Outside): a status that names
// what is outside, NaN, or the nearest point of the box, whose derivatives across the box's side are 0. Numbers that
// are NaN, or a negative distance, give NaN (status not_a_number) always, and so does what a map has not
// (not_on_this_map).
//
// The file, little-endian, doubles as IEEE 754, offsets in bytes:
//     0  8   "ASPERMAP"
//     8  u32 0x01020304, which a file of the other byte order has reversed
//    12  u32 version of this layout, 4; those before it were of no release
//    16  u64 size of the file
//    24  f64 pressure lo, hi [Pa], velocity lo, hi [m/s], T0 lo, hi [K]: the box. T0 is 0 without heat, lo = hi where
//            the map is for a single one. Of a map that takes the direction, which has no heat, 0 and pi [rad] are in
//            the place of T0, and angles in that of temperatures in all that follows; both are 0 where it is for one
//    72  f64 rtol asked for; max_error: twice the largest relative error of mu_H and A/A0 on the points on which the
//            map was certified, 12 a cell that it was not made from and a lattice; the largest on the points of the
//            check that followed; relative error that s0 of this file makes in mu, which 99 % of points and distances
//            keep, 0 without heat
//   104  f64 tau_f0 [Pa] (0: no adhesion), v0 [m/s], c [-]
//   128  u64 number of points of that check; how many were off by more than max_error; bytes of the maps inside
//   152  u32 1 with hysteresis, 0 without (a rubber that loses nothing), 2 more for a slanted map, and 4 more for one
//            with forces across; n bands, from
//            1 to 64; s nodes of s(x), 0 or from 2 on; m temperatures between which cells have polynomials, 1 where
//            there is a single T0 or none; a columns, b rows of ln s0, from 2 on, b = 1 for a single T0, both 0
//            without heat; g grids, from n on; e entries; c cells, from 1 on; t bytes of text
//   192  f64 2 m: ln a_T, of the map without heat, and d ln a_T / dT0 at m equal steps from T0 lo to hi; cubic Hermite
//            between them; none where m is 1 or there is no heat
//        f64 2 a b: ln s0 and its slope over x at a equal steps of x, cubic Hermite between them, for each of b equal
//            steps of T0, linear between them
//        f64 n + 1 values of z, rising: where bands begin, and the end
//        f64 2 s: s(x) and s'(x) at s nodes, equal steps of x from ln v lo to ln v hi; cubic Hermite between them; none
//            with heat
//        g x (f64 x, z of a corner; f64 columns per x, rows per z; u32 columns, rows, first entry, 0): grid k < n is
//            that of band k; each entry is of one grid, in their order
//        e x i32 row by row, the row the faster index: a cell, or -1 - k for grid k, which comes after the grid it
//            is in; no more than 64 grids lie one in another
//        c x (2 + 32 k) f64, k = 1 where m is 1, else 4 (m - 1): x, z of a corner, then 32 coefficients for each power
//            0 to 3 of T0 - T_i on each step i of T0: of (x - x0)^i (z - z0)^j at 8 j + 2 i for ln mu_H, at
//            8 j + 2 i + 1 for ln A/A0
//        the map without heat of one with it, a whole file, for the same direction; then of one with forces across that
//            of lateral / mu_H, which stands in the place of ln mu_H there, beside zeros: with heat with the same s0,
//            and without a map inside
//        t   text, lines of UTF-8: what the map was made of
//        zeros up to a multiple of 8 after the entries and after the text
//        u32 CRC-32 (that of zip and PNG) of all before; u32 0
//
// A slanted map is for a range of T0 and rubber that was measured, whose mu is smooth over T0 along lines of constant
// v a_T alone. ln a_T = a t / (1 + b t), t = T0 - lo, is between 0 and its value at T0 hi, the lesser of which is l and
// the larger h. Instead of the table of ln a_T it has f64 a, b [1/K], and its cells have the first coordinate ln p, the
// second z = ln v + ln a_T, and instead of T0 the share of the way along the line of constant z in the box,
//   above / (above + below), above = min(ln a_T - l, ln(v hi / v)), below = min(h - ln a_T, ln(v / v lo)),
// in m - 1 equal steps from 0 to 1. Where the smaller of two numbers becomes the other one a band of z ends: n = 3.
#ifndef ASPERITY_FRICTION_MAP_HPP
#define ASPERITY_FRICTION_MAP_HPP

#ifdef __cplusplus

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#ifdef __GNUC__
#define ASPERITY_MAP_INLINE __attribute__((always_inline))
#define ASPERITY_MAP_APART __attribute__((noinline))
#else
#define ASPERITY_MAP_INLINE
#define ASPERITY_MAP_APART
#endif

#ifdef _MSC_VER
#pragma warning(push)
#pragma warning(disable : 4996)  // fopen and strerror are standard C++
#endif

namespace asperity {

namespace map_detail {

template <class To, class From>
To as(From x) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  To result{};
  std::memcpy(&result, &x, sizeof x);
  return result;
}
inline std::uint64_t bits(double x) noexcept { return as<std::uint64_t>(x); }
inline double from_bits(std::uint64_t u) noexcept { return as<double>(u); }
inline double magnitude(double x) noexcept { return from_bits(bits(x) & 0x7fffffffffffffff); }

/// Two numbers, which a vector unit takes at once where there is one.
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))
#define ASPERITY_MAP_PAIRS
using Pair = double __attribute__((vector_size(16), may_alias));
using PairOfBits = std::uint64_t __attribute__((vector_size(16)));
/// From where two of them are aligned.
inline Pair pair(const double* x) noexcept { return *static_cast<const Pair*>(static_cast<const void*>(x)); }
inline PairOfBits bits(Pair x) noexcept { return as<PairOfBits>(x); }
inline Pair from_bits(PairOfBits u) noexcept { return as<Pair>(u); }
#else
struct Pair {
  double two[2];
  double operator[](int i) const noexcept { return two[i]; }
};
inline Pair pair(const double* x) noexcept { return {{x[0], x[1]}}; }
inline Pair operator+(Pair a, Pair b) noexcept { return {{a[0] + b[0], a[1] + b[1]}}; }
inline Pair operator*(Pair a, double b) noexcept { return {{a[0] * b, a[1] * b}}; }
#endif

/// ln c and 1 / c for c = (i + 1/2) / 128, i from 128 to 255, and 2^(i / 128): the tables of ln and exp below.
struct Tables {
  double ln[128] = {}, inverse[128] = {}, power[128] = {};

  constexpr Tables() {
    for (int i = 0; i < 128; ++i) {
      const double c = (128.5 + i) / 128, s = (c - 1) / (c + 1);
      double sum = 0;
      for (int k = 39; k > 0; k -= 2) sum = sum * s * s + 2.0 / k;
      ln[i] = sum * s;  // 2 artanh s
      inverse[i] = 1 / c;
      double factor = 1;  // e^(i ln(2) / 128)
      for (int k = 20; k > 0; --k) factor = 1 + factor * i * (0.693147180559945309417 / 128) / k;
      power[i] = factor;
    }
  }
};
inline constexpr Tables tables;

inline double look_up(const double* table, std::uint64_t i) noexcept { return table[i]; }
#ifdef ASPERITY_MAP_PAIRS
inline Pair look_up(const double* table, PairOfBits i) noexcept { return Pair{table[i[0]], table[i[1]]}; }
#endif

// 2^52, whose last bits are those of the integer that is added to it; and 1.5 * 2^52, from which the integer may have
// either sign, and to which a number is added to be rounded to one. Bits instead of differences hold under -ffast-math.
constexpr double whole = 4503599627370496.0, rounding = 1.5 * whole;
constexpr std::uint64_t bits_of_whole = 0x4330000000000000;

/// ln of a positive normal number, to 5e-16 of the larger of it and 1, the same digits on every host:
/// x = 2^k m, m = c (1 + r) with c from the table, |r| < 1 / 256.
ASPERITY_MAP_INLINE inline double ln(double x) noexcept {
  const std::uint64_t u = bits(x), i = (u >> 45) & 127;
  const double k = from_bits((u >> 52) | bits_of_whole) - (whole + 1023);
  const double m = from_bits((u & 0x000fffffffffffff) | 0x3ff0000000000000);
  const double r = m * tables.inverse[i] - 1, r2 = r * r;
  const double tail = (-1.0 / 2 + 1.0 / 3 * r) + r2 * ((-1.0 / 4 + 1.0 / 5 * r) + r2 * (-1.0 / 6 + 1.0 / 7 * r));
  return (k * 0.693147180559945309417 + tables.ln[i]) + (r + r2 * tail);
}

constexpr double steps_per_unit = 128 / 0.693147180559945309417;  // of ln(2) / 128
// The first part of ln(2) / 128 has zeros enough to be multiplied exactly.
constexpr double step_high = 0.693147180369123816490 / 128, step_low = 1.90821492927058770002e-10 / 128;

inline double held(double x) noexcept {
  const double above = x < -700 ? -700 : x;
  return above > 700 ? 700 : above;
}
#ifdef ASPERITY_MAP_PAIRS
inline Pair held(Pair x) noexcept {
#ifdef __SSE2__
  return __builtin_ia32_minpd(Pair{700, 700}, __builtin_ia32_maxpd(Pair{-700, -700}, x));
#else
  return Pair{held(x[0]), held(x[1])};
#endif
}
#endif

/// e^x, of both of a pair, to 4e-16 for |x| < 700, beyond which x is held there: x = (128 n + i) ln(2) / 128 + r,
/// |r| < ln(2) / 256.
template <class Number>
ASPERITY_MAP_INLINE inline Number exp(Number x) noexcept {
  x = held(x);
  const auto u = bits(x * steps_per_unit + rounding);
  const Number steps = from_bits(u | bits_of_whole) - rounding, r = (x - steps * step_high) - steps * step_low,
               r2 = r * r;
  const Number tail = (1.0 / 2 + 1.0 / 6 * r) + r2 * (1.0 / 24 + 1.0 / 120 * r);
  return (1 + (r + r2 * tail)) * from_bits(bits(look_up(tables.power, u & 127)) + ((u >> 7) << 52));  // times 2^n
}
#ifndef ASPERITY_MAP_PAIRS
inline Pair exp(Pair x) noexcept { return {{exp(x[0]), exp(x[1])}}; }
#endif

inline bool is_nan(double x) noexcept { return (bits(x) & 0x7fffffffffffffff) > 0x7ff0000000000000; }

/// Comparisons of bits instead of numbers hold under a host's -ffast-math too.
inline bool within(double x, const std::array<double, 2>& box) noexcept {
  return bits(x) - bits(box[0]) <= bits(box[1]) - bits(box[0]);
}

/// A line of the processor's cache: numbers that are read together begin with one.
struct alignas(64) Line {
  double number[8];
};
inline const double* numbers(const std::vector<Line>& of) noexcept {
  return reinterpret_cast<const double*>(of.data());
}

/// Equal steps of a coordinate, from 0 to `last`.
struct Steps {
  double per_unit = 0;
  std::int64_t last = 0;

  /// Which of them, the first or the last one beyond all, and the share of it, so far from where they begin. The loader
  /// has seen to it that numbers of steps are far below the largest integer.
  ASPERITY_MAP_INLINE std::int64_t at(double from_first, double& share) const noexcept {
    share = from_first * per_unit;
    auto i = static_cast<std::int64_t>(share);
    i = i < 0 ? 0 : i > last ? last : i;
    share -= static_cast<double>(i);
    return i;
  }
};

struct Grid {
  double x, z;
  Steps columns, rows;
  std::uint32_t first;
  [[nodiscard]] std::uint64_t entries() const noexcept {
    return static_cast<std::uint64_t>(columns.last + 1) * static_cast<std::uint64_t>(rows.last + 1);
  }
};

constexpr std::uint32_t layout = 4;
constexpr std::size_t head_size = 192;
constexpr std::size_t corner_size = 2, block_size = 32;     // numbers of a cell: its corner, then one block or more
constexpr double tiny = 1e-300, huge = 1e300;               // limits of numbers in the file
constexpr double long_slid = huge;                          // [m]
constexpr std::uint32_t most_bands = 64, most_nested = 64;  // what a look-up goes through is bounded

/// Of the axes of a map and of its tables, and the law of its adhesion: numbers alone.
struct Scales {
  double ln_shear_stress_ = 0, ln_reference_ = 0, width_ = 0;  // width of the adhesion over ln(10)^2
  double first_x_ = 0, last_x_ = 0;                            // ln of the box's velocities
  std::size_t cell_size_ = block_size;                         // numbers from one to the next
  std::uint32_t steps_ = 0;  // of the third axis in cells: T0, the direction, or a slanted map's share
  bool is_slanted_ = false;
  Steps offset_steps_, third_, sliding_x_, sliding_T_;
  double step_of_third_ = 0;
  std::int64_t row_size_ = 0;  // of ln s0
  double log_a_T_[2] = {};     // its sides, of a slanted map
};

class Reader;
struct Head;
/// What a file is: a map, or inside of one the map without heat or that of forces across.
enum class Part { outer, cold, across };

}  // namespace map_detail

/// The header of a map's file.
struct FrictionMapInfo {
  std::array<double, 2> pressure{}, velocity{};               // the box [Pa], [m/s]
  double rtol = 0, max_error = 0, largest_checked_error = 0;  // relative, of mu
  std::uint64_t checked = 0, exceeded = 0;  // random points of the last check, and those beyond max_error
  double shear_stress = 0, reference_velocity = 0, width = 0;  // tau_f0 [Pa], v0 [m/s], c of the adhesion
  bool hysteresis = false;                                     // false: mu_H is 0 everywhere
  std::size_t cells = 0;
  std::string text;  // lines: what the map was made of
  bool heat = false;
  std::array<double, 2> temperature{};  // T0 of a map with heat [K], equal ends where it is for one; of a map that
                                        // takes the direction 0 and half a turn [rad]
  std::size_t temperatures = 0;         // at which, or shares of the way along a line, its cells have polynomials
  double memory_error = 0;              // relative, that s0 makes in mu while the rubber heats up, at 99 % of points
  bool directional = false;             // there are forces across; off by max_error of mu_H + |lateral| at most
  bool turns = false;                   // and look-ups take the direction of sliding
};

/// Another temperature than the one that the map was made for; of a map with heat that of the background, and how far
/// the rubber slid.
struct MapTemperature {
  double a_T = 1;                           // mu_H and A/A0 are those at the velocity a_T v
  bool shifts_adhesion = false;             // the adhesion too, as if v0 were v0 / a_T
  double background = 0;                    // T0 [K]; 0: the only one that the map has
  double distance = map_detail::long_slid;  // slid since rest [m]
  double direction = 0;                     // of sliding [rad], of a map that takes it; others ignore it
};

struct MapPoint {
  double mu, hysteresis, adhesion, contact_area;  // [-]
  double dmu_dlnp, dmu_dlnv;                      // d mu / d ln p, d mu / d ln |v|
  double lateral;                                 // the force across over the load [-]
};

class FrictionMap : map_detail::Scales {
 public:
  /// The treatment of points outside of the box. To treat them as errors, look at the status of `at`.
  enum class Outside { nan, clamp };
  enum class Status { ok, pressure_outside, velocity_outside, not_a_number, temperature_outside, not_on_this_map };

  /// mu [-] at a pressure [Pa] and a velocity [m/s] of either sign.
  [[nodiscard]] double mu(double pressure, double velocity, Outside outside = Outside::nan,
                          const MapTemperature& temperature = {}) const noexcept {
    using map_detail::Pair;
    const double speed = map_detail::magnitude(velocity), shifted = speed * temperature.a_T;
    if (!is_inside(pressure, shifted) || !is_usual(temperature))
      return settled_mu(pressure, velocity, outside, temperature);
    const Third third = third_at(temperature.background);
    const double x = map_detail::ln(shifted), ln_p = map_detail::ln(pressure);
    const double adhesion = log_adhesion(ln_p, takes_shifted(temperature) ? x : map_detail::ln(speed));
    if (!remembers(temperature)) return mu_of(functions(place(x, ln_p, third)), adhesion);
    // what waits for the memory longest comes first: the processor has the hot map's polynomials to sum meanwhile
    const double length = log_sliding_length(x, third);
    const Pair cold = functions(cold_->place(cold_x(x, third), ln_p, {})), hot = functions(place(x, ln_p, third));
    const Pair begun = map_detail::exp(Pair{-length, cold[0]});
    const Pair last = map_detail::exp(Pair{-(temperature.distance * begun[0]), cold[1] + adhesion});
    return blend(mu_of(hot, adhesion), sum_of(Pair{begun[1], last[1]}), last[0]);
  }

  /// The same at each of n points, to the last digit, in two thirds of the time: whole steps are taken for many points,
  /// as a processor waits where one point's have to follow each other. `result` may be one of the columns. Maps over a
  /// range of T0 take 36 kB of the stack, but for slanted ones.
  void mu_at_points(std::size_t n, const double* pressure, const double* velocity, double* result,
                    Outside outside = Outside::nan, const MapTemperature& temperature = {}) const noexcept {
    if (steps_ == 0 || is_slanted_) {
      mu_of_blocks(n, pressure, velocity, result, outside, temperature, nullptr);
    } else {
      CellsAtT0 cells;
      mu_of_blocks(n, pressure, velocity, result, outside, temperature, &cells);
    }
  }

  /// Everything at a point. The status says whether it lies outside of the box, whatever `outside` is.
  Status at(double pressure, double velocity, MapPoint& point, Outside outside = Outside::nan,
            const MapTemperature& temperature = {}) const noexcept {
    const Where at = where(pressure, velocity, outside, temperature);
    if (at.place.coefficients == nullptr) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      point = {nan, nan, nan, nan, nan, nan, nan};
      return at.status;
    }
    point = everything(at);
    if (!remembers(temperature)) return at.status;
    Where in_cold = at;
    in_cold.x = cold_x(at.x, at.third);
    in_cold.place = cold_->place(in_cold.x, at.ln_p, {}, nullptr, &in_cold.offset_slope);
    const MapPoint cold = cold_->everything(in_cold);
    double slope = 0;
    const double lengths = temperature.distance * map_detail::exp(-log_sliding_length(at.x, at.third, &slope));
    const double share = map_detail::exp(-lengths),
                 by_v = at.free_v ? share * lengths * slope * (cold.mu - point.mu) : 0;
    for (double MapPoint::*const number :
         {&MapPoint::mu, &MapPoint::hysteresis, &MapPoint::adhesion, &MapPoint::contact_area, &MapPoint::dmu_dlnp,
          &MapPoint::dmu_dlnv, &MapPoint::lateral})
      point.*number = blend(point.*number, cold.*number, share);
    point.dmu_dlnv += by_v;
    return at.status;
  }

  /// s0 [m] of a map with heat, over which friction that begins to slide at a velocity comes to within 1 / e of that
  /// with its heat; NaN where the map has none.
  [[nodiscard]] double sliding_length(double velocity, double background = 0,
                                      Outside outside = Outside::nan) const noexcept {
    const Where at = where(info_.pressure[0], velocity, outside, {1, false, background, map_detail::long_slid});
    if (at.place.coefficients == nullptr || !info_.heat) return std::numeric_limits<double>::quiet_NaN();
    return map_detail::exp(log_sliding_length(at.x, at.third));
  }

  /// Shear traction sign(v) mu p [Pa]; 0 at rest and without load.
  [[nodiscard]] double traction(double pressure, double velocity, Outside outside = Outside::nan,
                                const MapTemperature& temperature = {}) const noexcept {
    if (map_detail::is_nan(pressure) || map_detail::is_nan(velocity)) return std::numeric_limits<double>::quiet_NaN();
    if (pressure <= 0 || velocity == 0) return 0;
    const double size = mu(pressure, velocity, outside, temperature) * pressure;
    return velocity < 0 ? -size : size;
  }

  /// The force across the sliding over the load [-]: on the moving body -lateral p along n, the direction of sliding
  /// turned by 90 degrees from x towards y. 0 where the map knows no directions.
  [[nodiscard]] double lateral(double pressure, double velocity, Outside outside = Outside::nan,
                               const MapTemperature& temperature = {}) const noexcept {
    MapPoint point;
    at(pressure, velocity, point, outside, temperature);
    return point.lateral;
  }

  [[nodiscard]] const FrictionMapInfo& info() const noexcept { return info_; }
  /// The map without heat of one with it, over a_T v, a_T that from its temperature to another; else nullptr.
  [[nodiscard]] const FrictionMap* cold() const noexcept { return cold_.get(); }

  /// From the bytes of a file. False with the reason, and the map as it was, where they are not those of a map.
  bool read(const void* data, std::size_t size, std::string& why);
  /// From a regular file: devices and pipes, for which one might wait or which do not end, are refused.
  bool load(const char* path, std::string& why);

 private:
  /// A place on the third axis of cells.
  struct Third {
    double value = 0, d = 0;  // T0 or direction, and from the node below it; of a slanted map d of the share
    std::int64_t step = 0;    // between nodes
    double log_a_T = 0;       // of a slanted map
  };

  /// Polynomials of cells at the one T0 of a call, which points that follow share.
  struct CellsAtT0 {
    static constexpr std::size_t size = 128;
    const double* cell[size] = {};
    alignas(16) double coefficients[size][32];

    const double* at(const double* of, const Third& third) noexcept {
      const std::uint64_t scattered = std::uint64_t{reinterpret_cast<std::uintptr_t>(of) / 1024} * 0x9e3779b97f4a7c15;
      const std::uint64_t slot = (scattered >> 32) % size;
      if (cell[slot] != of) to_temperature(of + 128 * third.step, third.d, coefficients[slot]);
      cell[slot] = of;
      return coefficients[slot];
    }
  };

  /// Coefficients of a cell, over two axes or three, and how far a point is from its corner and from the node below it.
  struct Place {
    const double* coefficients;
    double dx, dz, t;
    bool is_over_three;
  };

  /// A point that was looked for, without a place where there is no value.
  struct Where {
    Place place{};
    double x = 0, ln_p = 0, ln_v = 0;  // ln_v as the adhesion takes it
    double offset_slope = 0;           // s'(x)
    Third third;
    Status status = Status::ok;
    bool free_p = true, free_v = true;  // not held at a side of the box
  };

  /// ln mu_H and ln A/A0.
  ASPERITY_MAP_INLINE static map_detail::Pair functions(const Place& at) noexcept {
    return at.is_over_three ? bicubic(at.coefficients, at.dx, at.dz, At(at.t))
                            : bicubic(at.coefficients, at.dx, at.dz, Plain{});
  }

  /// mu from ln mu_H, ln A/A0, and ln of mu_A over A/A0.
  ASPERITY_MAP_INLINE double mu_of(map_detail::Pair f, double log_adhesion) const noexcept {
    if (!(info_.shear_stress > 0)) return info_.hysteresis ? map_detail::exp(f[0]) : 0;
    return sum_of(map_detail::exp(map_detail::Pair{f[0], f[1] + log_adhesion}));
  }
  /// mu of mu_H and mu_A, of which a map may be without either.
  [[nodiscard]] double sum_of(map_detail::Pair parts) const noexcept {
    return (info_.hysteresis ? parts[0] : 0) + (info_.shear_stress > 0 ? parts[1] : 0);
  }
  static double blend(double hot, double cold, double share) noexcept { return hot + share * (cold - hot); }

  /// `mu` of all other points: outside of the box, or at a temperature that the map has not.
  [[nodiscard]] ASPERITY_MAP_APART double settled_mu(double pressure, double velocity, Outside outside,
                                                     const MapTemperature& temperature) const noexcept {
    MapPoint point;
    at(pressure, velocity, point, outside, temperature);
    return point.mu;
  }

  static constexpr std::size_t together = 64;  // points

  /// Each loop is a step of `mu`.
  void mu_of_blocks(std::size_t n, const double* pressure, const double* velocity, double* result, Outside outside,
                    const MapTemperature& temperature, CellsAtT0* cells) const noexcept {
    using map_detail::Pair;
    const bool usual = is_usual(temperature), memory = usual && remembers(temperature);
    const Third third = usual ? third_at(temperature.background) : Third{};
    std::size_t point[together];
    double speed[together], x[together], ln_p[together], adhesion[together];
    Pair hot[together], cold[together], begun[together];
    for (std::size_t begin = 0; begin < n; begin += together) {
      std::size_t inside = 0;
      for (std::size_t i = begin; i < n && i < begin + together; ++i) {
        const double v = map_detail::magnitude(velocity[i]);
        if (!usual || !is_inside(pressure[i], v * temperature.a_T)) {
          result[i] = settled_mu(pressure[i], velocity[i], outside, temperature);
          continue;
        }
        speed[inside] = v;
        ln_p[inside] = pressure[i];
        point[inside++] = i;
      }
      for (std::size_t k = 0; k < inside; ++k) x[k] = map_detail::ln(speed[k] * temperature.a_T);
      for (std::size_t k = 0; k < inside; ++k) ln_p[k] = map_detail::ln(ln_p[k]);
      for (std::size_t k = 0; k < inside; ++k)
        adhesion[k] = log_adhesion(ln_p[k], takes_shifted(temperature) ? x[k] : map_detail::ln(speed[k]));
      functions(inside, x, ln_p, third, cells, hot);
      for (std::size_t k = 0; k < inside; ++k) hot[k] = Pair{hot[k][0], hot[k][1] + adhesion[k]};
      exps(inside, hot);
      for (std::size_t k = 0; k < inside && !memory; ++k) result[point[k]] = sum_of(hot[k]);
      if (!memory) continue;
      double* const length = speed;
      for (std::size_t k = 0; k < inside; ++k) length[k] = log_sliding_length(x[k], third);
      for (std::size_t k = 0; k < inside; ++k) x[k] = cold_x(x[k], third);
      cold_->functions(inside, x, ln_p, {}, nullptr, cold);
      for (std::size_t k = 0; k < inside; ++k) begun[k] = Pair{-length[k], cold[k][0]};
      exps(inside, begun);
      for (std::size_t k = 0; k < inside; ++k)
        cold[k] = Pair{-(temperature.distance * begun[k][0]), cold[k][1] + adhesion[k]};
      exps(inside, cold);
      for (std::size_t k = 0; k < inside; ++k)
        result[point[k]] = blend(sum_of(hot[k]), sum_of(Pair{begun[k][1], cold[k][1]}), cold[k][0]);
    }
  }
  ASPERITY_MAP_APART void functions(std::size_t n, const double* x, const double* ln_p, const Third& third,
                                    CellsAtT0* summed, map_detail::Pair* f) const noexcept {
    Place at[together];
    for (std::size_t k = 0; k < n; ++k) at[k] = place(x[k], ln_p[k], third, summed);
    for (std::size_t k = 0; k < n; ++k) f[k] = functions(at[k]);
  }
  ASPERITY_MAP_APART static void exps(std::size_t n, map_detail::Pair* x) noexcept {
    for (std::size_t k = 0; k < n; ++k) x[k] = map_detail::exp(x[k]);
  }

  [[nodiscard]] MapPoint everything(const Where& at) const noexcept {
    using map_detail::Pair;
    using map_detail::pair;
    alignas(16) double room[32];
    const auto [coefficients, x, z, t, is_over_three] = at.place;
    const double* const c = is_over_three ? to_temperature(coefficients, t, room) : coefficients;
    const Pair f = bicubic(c, x, z, Plain{});
    Pair fx{0, 0}, fz{0, 0};
    for (int j = 4; j-- > 0;) {
      const double* const r = &c[8 * j];
      fx = fx * z + (pair(r + 2) + (pair(r + 4) * 2 + pair(r + 6) * (x * 3)) * x);
      if (j > 0) fz = fz * z + (pair(r) + (pair(r + 2) + (pair(r + 4) + pair(r + 6) * x) * x) * x) * j;
    }
    fx = fx + fz * -at.offset_slope;  // at a constant pressure
    if (is_slanted_) to_velocity(at, fx, fz);
    MapPoint point{};
    point.hysteresis = info_.hysteresis ? map_detail::exp(f[0]) : 0;
    point.adhesion = info_.shear_stress > 0 ? map_detail::exp(f[1] + log_adhesion(at.ln_p, at.ln_v)) : 0;
    point.contact_area = map_detail::exp(f[1]);
    point.mu = point.hysteresis + point.adhesion;
    if (across_)
      point.lateral = point.hysteresis * functions(across_->place(at.x, at.ln_p, across_->third_at(at.third.value)))[0];
    const double falling = -2 * width_ * (at.ln_v - ln_reference_);
    point.dmu_dlnp = at.free_p ? point.hysteresis * fz[0] + point.adhesion * (fz[1] - 1) : 0;
    point.dmu_dlnv = at.free_v ? point.hysteresis * fx[0] + point.adhesion * (fx[1] + falling) : 0;
    return point;
  }

  /// Of a slanted map: from slopes over ln p and over ln v a_T to those over ln v, at a constant T0, and ln p.
  void to_velocity(const Where& at, map_detail::Pair& fx, map_detail::Pair& fz) const noexcept {
    using map_detail::pair;
    const auto by_share = [t = at.place.t](const double* c) {
      return pair(c + 32) + (pair(c + 64) * 2 + pair(c + 96) * (t * 3)) * t;
    };
    const map_detail::Pair by_p = fx, along = bicubic(at.place.coefficients, at.place.dx, at.place.dz, by_share);
    fx = fz + along * slope_of_share(at.x, at.third.log_a_T);
    fz = by_p;
  }

  /// Two coefficients, of ln mu_H and ln A/A0, as they stand, or t from a node of the third axis.
  struct Plain {
    ASPERITY_MAP_INLINE map_detail::Pair operator()(const double* c) const noexcept { return map_detail::pair(c); }
  };
  struct At {
    double t, t2;
    explicit At(double from_node) noexcept : t(from_node), t2(from_node * from_node) {}
    ASPERITY_MAP_INLINE map_detail::Pair operator()(const double* c) const noexcept {
      using map_detail::pair;
      return (pair(c) + pair(c + 32) * t) + (pair(c + 64) + pair(c + 96) * t) * t2;
    }
  };

  /// The polynomials of a cell there, put into `room`.
  static const double* to_temperature(const double* c, double t, double* room) noexcept {
    for (int i = 0; i < 32; i += 2) {
      const map_detail::Pair both = At(t)(c + i);
      room[i] = both[0];
      room[i + 1] = both[1];
    }
    return room;
  }

  /// ln mu_H and ln A/A0 of a cell at once, from its coefficients; sums in pairs, so that the terms need not wait for
  /// each other.
  template <class Coefficient>
  ASPERITY_MAP_INLINE static map_detail::Pair bicubic(const double* c, double x, double z, Coefficient of) noexcept {
    const double x2 = x * x, z2 = z * z;
    const auto row = [=](const double* r)
                         ASPERITY_MAP_INLINE { return (of(r) + of(r + 2) * x) + (of(r + 4) + of(r + 6) * x) * x2; };
    return (row(c) + row(c + 8) * z) + (row(c + 16) + row(c + 24) * z) * z2;
  }

  /// ln s0, and its slope: cubics over shares of steps of x, and between the rows of two T0 what is in their middle.
  [[nodiscard]] ASPERITY_MAP_INLINE double log_sliding_length(double x, const Third& third,
                                                              double* slope = nullptr) const noexcept {
    using map_detail::Pair;
    using map_detail::pair;
    double t = 0, share = 0;
    const std::int64_t i = sliding_x_.at(x - first_x_, t), j = sliding_T_.at(third.value - info_.temperature[0], share);
    const double* const c = map_detail::numbers(sliding_) + row_size_ * j + 8 * i;
    const Pair low = pair(c) + pair(c + 4) * share, high = pair(c + 2) + pair(c + 6) * share;
    if (slope != nullptr) *slope = (low[1] + t * (2 * high[0] + t * 3 * high[1])) * sliding_x_.per_unit;
    return (low[0] + low[1] * t) + (high[0] + high[1] * t) * (t * t);
  }

  /// Whether what was without heat is not forgotten.
  [[nodiscard]] bool remembers(const MapTemperature& temperature) const noexcept {
    return info_.heat && temperature.distance < map_detail::long_slid;
  }

  /// ln of a_T v on the map without heat.
  [[nodiscard]] ASPERITY_MAP_INLINE double cold_x(double x, const Third& third) const noexcept {
    if (steps_ == 0) return x;
    const double log_a_T =
        is_slanted_ ? third.log_a_T : cubic(shift_.data() + 4 * third.step, third.d * third_.per_unit);
    const double shifted = x + log_a_T, first = cold_->first_x_, last = cold_->last_x_;
    return shifted < first ? first : shifted > last ? last : shifted;  // by rounding
  }

  /// ln of mu_A over A/A0.
  [[nodiscard]] double log_adhesion(double ln_p, double ln_v) const noexcept {
    const double off = ln_v - ln_reference_;
    return ln_shear_stress_ - ln_p - width_ * off * off;
  }

  [[nodiscard]] Where where(double pressure, double velocity, Outside outside,
                            const MapTemperature& temperature) const noexcept {
    double speed = map_detail::magnitude(velocity), shifted = speed * temperature.a_T;
    Where at;
    if (!settle(pressure, speed, shifted, outside, temperature, at)) return at;
    at.third = third_at(at.third.value);
    at.x = map_detail::ln(shifted);
    at.ln_p = map_detail::ln(pressure);
    at.ln_v = takes_shifted(temperature) ? at.x : map_detail::ln(speed);
    at.place = place(at.x, at.ln_p, at.third, nullptr, &at.offset_slope);
    return at;
  }

  /// A box of an empty map holds nothing.
  [[nodiscard]] bool is_inside(double pressure, double shifted) const noexcept {
    return map_detail::within(pressure, info_.pressure) && map_detail::within(shifted, info_.velocity) &&
           !cells_.empty();
  }

  /// Whether the adhesion takes the velocity that the others take.
  static bool takes_shifted(const MapTemperature& temperature) noexcept {
    return temperature.a_T == 1 || temperature.shifts_adhesion;
  }

  /// Whether the map takes it as it is.
  [[nodiscard]] bool is_usual(const MapTemperature& temperature) const noexcept {
    if (map_detail::bits(temperature.distance) > map_detail::bits(map_detail::long_slid)) return false;  // or below 0
    if (map_detail::is_nan(temperature.direction)) return false;
    const bool only = steps_ == 0 && map_detail::bits(temperature.background) << 1 == 0;
    if (!info_.heat) return only;
    return (only || map_detail::within(temperature.background, info_.temperature)) && temperature.a_T == 1 &&
           !temperature.shifts_adhesion;
  }

  /// The status of a point and its place on the third axis; moves it to the nearest one of the box if it shall. False
  /// where there is no value.
  bool settle(double& pressure, double& speed, double& shifted, Outside outside, const MapTemperature& temperature,
              Where& at) const noexcept {
    using map_detail::within;
    const auto nearest = [](double x, const std::array<double, 2>& box) { return box[x > box[0] ? 1 : 0]; };
    const double a_T = temperature.a_T;
    at.status = Status::not_a_number;
    if (map_detail::is_nan(temperature.background) || map_detail::is_nan(temperature.distance) ||
        map_detail::is_nan(temperature.direction) || temperature.distance < 0)
      return false;
    at.status = Status::not_on_this_map;
    if (info_.heat ? a_T != 1 || temperature.shifts_adhesion : temperature.background != 0) return false;
    at.status = Status::not_a_number;
    if (map_detail::is_nan(pressure) || map_detail::is_nan(shifted) ||
        map_detail::bits(a_T) - 1 >= 0x7fefffffffffffff || cells_.empty())  // not positive and finite
      return false;
    double third = temperature.background;
    if (info_.heat && steps_ == 0 && third == 0) third = info_.temperature[0];
    if (info_.turns) {  // half a turn makes no other direction
      if (!within(map_detail::magnitude(temperature.direction), {0, map_detail::huge})) return false;
      const double half = info_.temperature[1],
                   rest = temperature.direction - half * std::floor(temperature.direction / half);
      third = rest > 0 ? rest < half ? rest : half : 0;
    }
    at.free_p = within(pressure, info_.pressure);
    at.free_v = within(shifted, info_.velocity);
    const bool free_third = !info_.heat || within(third, info_.temperature);
    at.status = !at.free_p   ? Status::pressure_outside
                : !at.free_v ? Status::velocity_outside
                : free_third ? Status::ok
                             : Status::temperature_outside;
    if ((at.status != Status::ok && outside == Outside::nan) || (!free_third && !(third > 0))) return false;
    if (!at.free_p) pressure = nearest(pressure, info_.pressure);
    if (!at.free_v) {
      shifted = nearest(shifted, info_.velocity);
      speed = shifted / a_T;
    }
    at.third.value = free_third ? third : nearest(third, info_.temperature);
    return true;
  }

  ASPERITY_MAP_INLINE Third third_at(double value) const noexcept {
    Third third;
    third.value = value;
    const double from_first = value - info_.temperature[0];
    if (is_slanted_)
      third.log_a_T = shift_[0] * from_first / (1 + shift_[1] * from_first);
    else if (steps_ > 0)
      set_step(from_first, third);
    return third;
  }

  ASPERITY_MAP_INLINE void set_step(double from_first, Third& third) const noexcept {
    double share = 0;
    third.step = third_.at(from_first, share);
    third.d = from_first - static_cast<double>(third.step) * step_of_third_;
  }

  /// How far it is along the line of constant v a_T from its lower end and from its upper one.
  struct Way {
    double above, below;
    [[nodiscard]] double length() const noexcept { return above + below; }
  };
  [[nodiscard]] ASPERITY_MAP_INLINE Way way_of(double x, double log_a_T) const noexcept {
    return {least(last_x_ - x, log_a_T - log_a_T_[0]), least(x - first_x_, log_a_T_[1] - log_a_T)};
  }
  /// The smaller one, but not below 0 by rounding.
  static double least(double a, double b) noexcept {
    const double smaller = a < b ? a : b;
    return smaller < 0 ? 0 : smaller;
  }

  /// d of the share of the way / d ln v at a constant T0, whichever sides lines in the point's band begin and end on.
  [[nodiscard]] double slope_of_share(double x, double log_a_T) const noexcept {
    std::size_t band = 0;
    while (x + log_a_T >= ends_[band]) ++band;
    const bool is_wide = last_x_ - first_x_ > log_a_T_[1] - log_a_T_[0];
    const bool from_v = band >= (is_wide ? 2 : 1), to_v = band < (is_wide ? 1 : 2);
    const Way way = way_of(x, log_a_T);
    constexpr double rounding = 1e-14;  // at the two ends of z there is no way, and nothing changes along it
    return -((from_v ? way.below : 0) + (to_v ? way.above : 0)) / (way.length() * way.length() + rounding);
  }

  /// A cubic over a share of a step.
  ASPERITY_MAP_INLINE static double cubic(const double* c, double t) noexcept {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

  /// s(x) and its slope.
  double log_modulus_offset(double x, double& slope) const noexcept {
    slope = 0;
    if (offset_.empty()) return 0;
    double t = 0;
    const double* const c = offset_.data() + 4 * offset_steps_.at(x - first_x_, t);
    slope = (c[1] + t * (2 * c[2] + t * 3 * c[3])) * offset_steps_.per_unit;
    return cubic(c, t);
  }

  ASPERITY_MAP_INLINE Place place(double x, double ln_p, Third third, CellsAtT0* summed = nullptr,
                                  double* offset_slope = nullptr) const noexcept {
    double first = x, second = 0, slope = 0;
    if (is_slanted_) {
      const Way way = way_of(x, third.log_a_T);
      // where there is no way, that side of it on which the point's T0 is
      const double nothing = 1e-300, is_last = third.log_a_T >= log_a_T_[1] ? nothing : 0;
      set_step((way.above + is_last) / (way.length() + nothing), third);
      first = ln_p;
      second = x + third.log_a_T;
    } else {
      second = ln_p - log_modulus_offset(x, slope);
    }
    if (offset_slope != nullptr) *offset_slope = slope;
    const std::size_t entry = entry_at(first, second);
    const double* const cell = cells() + entry * cell_size_;
    const double dx = first - corners_[2 * entry], dz = second - corners_[2 * entry + 1];
    if (steps_ == 0) return {cell, dx, dz, 0, false};
    if (summed != nullptr) return {summed->at(cell, third), dx, dz, 0, false};
    return {cell + 128 * third.step, dx, dz, third.d, true};
  }

  [[nodiscard]] const double* cells() const noexcept { return map_detail::numbers(cells_); }

  /// Which cell.
  [[nodiscard]] ASPERITY_MAP_INLINE std::size_t entry_at(double x, double z) const noexcept {
    std::size_t g = 0;
    while (z >= ends_[g]) ++g;  // the last is beyond all
    for (;;) {
      const std::int32_t entry = entries_[entry_of(grids_[g], x, z)];
      if (entry >= 0) return static_cast<std::size_t>(entry);
      g = static_cast<std::size_t>(-1 - entry);
    }
  }

  static std::size_t entry_of(const map_detail::Grid& grid, double x, double z) noexcept {
    double share = 0;
    const std::int64_t column = grid.columns.at(x - grid.x, share), row = grid.rows.at(z - grid.z, share);
    return grid.first + static_cast<std::size_t>(column * (grid.rows.last + 1) + row);
  }

  /// From the bytes of a file, maybe of one inside of another; what is wrong with them, or nothing.
  std::string take(const unsigned char* bytes, std::size_t size, map_detail::Part part);
  bool take_tables(map_detail::Reader& in, const map_detail::Head& head);
  bool take_grids(map_detail::Reader& in, const map_detail::Head& head);

  friend class FrictionMapBatch;  // of the full library: many points at once

  FrictionMapInfo info_;
  std::vector<double> ends_, offset_;      // of the bands; cubics of s(x)
  std::vector<double> shift_;              // cubics of ln a_T over T0, or the law of a slanted map
  std::vector<map_detail::Line> sliding_;  // of ln s0 over x and T0
  std::shared_ptr<const FrictionMap> cold_, across_;
  std::vector<map_detail::Grid> grids_;
  std::vector<std::int32_t> entries_;
  std::vector<double> corners_;  // of cells: x, z
  std::vector<map_detail::Line> cells_;
};

namespace map_detail {

inline std::uint32_t crc32(const unsigned char* data, std::size_t size) noexcept {
  std::uint32_t table[256];
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t r = i;
    for (int k = 0; k < 8; ++k) r = (r >> 1) ^ ((r & 1) != 0 ? 0xedb88320u : 0u);
    table[i] = r;
  }
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 0; i < size; ++i) crc = (crc >> 8) ^ table[(crc ^ data[i]) & 0xff];
  return ~crc;
}

/// Little-endian numbers one after another; the caller has made sure that they are there.
class Reader {
 public:
  explicit Reader(const unsigned char* at) noexcept : at_(at) {}
  std::uint32_t u32() noexcept { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() noexcept { return number(8); }
  double f64() noexcept { return from_bits(number(8)); }
  const unsigned char* skip(std::size_t n) noexcept { return std::exchange(at_, at_ + n); }

  /// Where one is not finite or beyond its limits, not all is good any more.
  bool good = true;
  double f64(double least, double most) noexcept {
    const double x = f64();
    good = good && !is_nan(x) && x >= least && x <= most;
    return x;
  }
  void numbers(std::initializer_list<double*> to, double least, double most) noexcept {
    for (double* const x : to) *x = f64(least, most);
  }
  void numbers(std::vector<double>& to, std::size_t n, double most) {
    to.resize(n);
    for (double& x : to) x = f64(-most, most);
  }
  /// Cells: corners, of which powers of the distance stay finite, and so many lines of polynomials.
  void cells(std::vector<double>& corners, std::vector<Line>& to, std::size_t n, std::size_t lines, double most) {
    corners.resize(2 * n);
    to.resize(n * lines);
    for (std::size_t i = 0; i < n; ++i) {
      numbers({&corners[2 * i], &corners[2 * i + 1]}, -1e4, 1e4);
      for (std::size_t k = lines * i; k < lines * (i + 1); ++k)
        for (double& c : to[k].number) c = f64(-most, most);
    }
  }

 private:
  std::uint64_t number(int n) noexcept {
    std::uint64_t result = 0;
    for (int i = n; i-- > 0;) result = (result << 8) | at_[i];
    at_ += n;
    return result;
  }
  const unsigned char* at_;
};

/// What a file says before its tables, whose sizes it holds.
struct Head {
  std::uint32_t flags = 0, bands = 0, offsets = 0, nodes = 0, columns = 0, rows = 0;
  std::uint32_t grids = 0, entries = 0, cells = 0, text = 0;
  unsigned long long inside = 0;  // bytes of maps

  /// From a file of that many bytes; false where it contradicts itself.
  bool read(Reader& in, FrictionMapInfo& info, std::uint64_t size, Part part) noexcept {
    in.numbers({&info.pressure[0], &info.pressure[1], &info.velocity[0], &info.velocity[1]}, tiny, huge);
    in.numbers({&info.temperature[0], &info.temperature[1]}, 0, 1e6);
    in.numbers({&info.rtol, &info.max_error, &info.largest_checked_error, &info.memory_error, &info.shear_stress,
                &info.reference_velocity, &info.width},
               0, huge);
    info.checked = in.u64();
    info.exceeded = in.u64();
    inside = in.u64();
    for (std::uint32_t* const n : {&flags, &bands, &offsets, &nodes, &columns, &rows, &grids, &entries, &cells, &text})
      *n = in.u32();
    constexpr std::uint32_t most = 9999;
    const bool sizes_fit = flags < 8 && bands > 0 && bands <= most_bands && offsets != 1 && grids >= bands &&
                           entries > 0 && cells > 0 && nodes > 0 && nodes <= most && columns <= most && rows <= most &&
                           inside < size;
    info.hysteresis = (flags & 1) != 0;
    info.heat = columns > 0;
    info.turns = !info.heat && nodes > 1;
    info.directional = (flags & 4) != 0;
    info.temperatures = info.heat ? nodes : 0;
    info.cells = cells;
    const bool law_fits = info.shear_stress == 0 || (info.shear_stress >= tiny && info.reference_velocity >= tiny);
    return in.good && sizes_fit && sides_fit(info) && heat_fits(info, part) && law_fits &&
           (!is_slanted() || (nodes > 1 && bands == 3)) && bytes() == size;
  }

  [[nodiscard]] bool is_slanted() const noexcept { return (flags & 2) != 0; }
  /// Numbers of a cell beside its corner.
  [[nodiscard]] std::size_t cell_size() const noexcept {
    return block_size * (nodes < 2 ? 1 : 4 * (std::size_t{nodes} - 1));
  }
  /// Numbers of ln a_T: of a law, or at nodes.
  [[nodiscard]] std::size_t shifts() const noexcept {
    return is_slanted() ? 2 : nodes < 2 || columns == 0 ? 0 : 2 * std::size_t{nodes};
  }
  /// Zeros behind the entries or the text.
  [[nodiscard]] static std::size_t padding(unsigned long long bytes) noexcept {
    return static_cast<std::size_t>((8 - bytes % 8) % 8);
  }

 private:
  [[nodiscard]] static bool sides_fit(const FrictionMapInfo& info) noexcept {
    constexpr double least = 1 + 1e-9;
    return info.pressure[1] > info.pressure[0] * least && info.velocity[1] > info.velocity[0] * least;
  }
  [[nodiscard]] bool heat_fits(const FrictionMapInfo& info, Part part) const noexcept {
    const auto [lo, hi] = info.temperature;
    constexpr double half_turn = 3.141592653589793;
    const unsigned maps = part == Part::across ? 0u : (info.heat ? 1u : 0u) + (info.directional ? 1u : 0u);
    if (inside % 8 != 0 || (maps == 0 ? inside > 0 : inside < maps * (head_size + 8ull))) return false;
    if (part == Part::across ? info.directional : part == Part::cold && info.turns) return false;
    if (!info.heat)
      return lo == 0 && hi == (nodes > 1 ? half_turn : 0) && info.memory_error == 0 && rows == 0 && !is_slanted();
    return lo >= 1 && (nodes == 1 ? lo == hi && rows == 1 : lo + 1e-3 <= hi && rows > 1) && columns > 1 && offsets == 0;
  }
  [[nodiscard]] std::uint64_t bytes() const noexcept {
    const std::uint64_t numbers = shifts() + 2ull * columns * rows + bands + 1 + 2ull * offsets + 6ull * grids +
                                  (1ull * corner_size + cell_size()) * cells;
    const std::uint64_t of_entries = 4ull * entries;
    return head_size + 8 * numbers + of_entries + padding(of_entries) + inside + text + padding(text) + 8;
  }
};

/// The coefficients of cubics over shares of steps, from rows of values and slopes at nodes a step apart.
inline std::vector<double> cubics(const std::vector<double>& values, std::size_t nodes, double step) {
  std::vector<double> result;
  for (std::size_t row = 0; row < values.size(); row += 2 * nodes)
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
      const double* const s = &values[row + 2 * i];
      const double rise = s[2] - s[0];
      for (const double c : {s[0], step * s[1], 3 * rise - step * (2 * s[1] + s[3]), step * (s[1] + s[3]) - 2 * rise})
        result.push_back(c);
    }
  return result;
}

/// Rows of cubics, each beside by how much that of the next row differs, if there is one; but the last of several.
inline std::vector<Line> with_differences(const std::vector<double>& cubics, std::size_t row) {
  const std::size_t rows = cubics.size() / row;
  std::vector<Line> result((rows < 2 ? 1 : rows - 1) * row / 4);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = cubics[4 * i + k];
      result[i].number[k] = c;
      result[i].number[4 + k] = rows < 2 ? 0 : cubics[4 * i + k + row] - c;
    }
  return result;
}

/// Every grid comes after those that it is in, and they are no more than look-ups shall go through.
inline bool no_grid_in_itself(const std::vector<Grid>& grids, const std::vector<std::int32_t>& entries) {
  std::vector<std::uint32_t> around(grids.size());  // how many grids each is in
  for (std::size_t k = 0; k < grids.size(); ++k)
    for (std::size_t i = 0; i < grids[k].entries(); ++i) {
      const std::int32_t entry = entries[grids[k].first + i];
      if (entry >= 0) continue;
      const auto inner = static_cast<std::size_t>(-1 - entry);
      if (inner <= k || around[k] + 1 >= most_nested) return false;
      if (around[inner] <= around[k]) around[inner] = around[k] + 1;
    }
  return true;
}

}  // namespace map_detail

inline bool FrictionMap::read(const void* data, std::size_t size, std::string& why) {
  FrictionMap map;
  why = map.take(static_cast<const unsigned char*>(data), size, map_detail::Part::outer);
  if (!why.empty()) return false;
  *this = std::move(map);
  return true;
}

inline std::string FrictionMap::take(const unsigned char* bytes, std::size_t size, map_detail::Part part) {
  if (size < 8 || std::memcmp(bytes, "ASPERMAP", 8) != 0) return "is no friction map: it begins otherwise";
  if (size < map_detail::head_size + 8) return "is truncated: " + std::to_string(size) + " bytes";
  map_detail::Reader in(bytes + 8);
  const std::uint32_t order = in.u32(), version = in.u32();
  if (order == 0x04030201) return "was written in the other byte order: must be little-endian";
  if (order != 0x01020304) return "is damaged: bytes 8 to 11";
  if (version != map_detail::layout)
    return "has layout version " + std::to_string(version) + ": must be " + std::to_string(map_detail::layout) +
           (version < map_detail::layout ? ", so the map has to be made again" : "");
  const std::uint64_t stated = in.u64();
  if (stated != size)
    return std::string(size < stated ? "is truncated: " : "is too long: ") + std::to_string(size) + " bytes, must be " +
           std::to_string(stated);
  if (map_detail::Reader(bytes + size - 8).u64() != map_detail::crc32(bytes, size - 8))  // its upper half is 0
    return "is damaged: its checksum is not that of its contents";
  map_detail::Head head;
  if (!head.read(in, info_, size, part)) return "is damaged: its head contradicts itself";
  if (part == map_detail::Part::cold && info_.heat) return "has one too";
  is_slanted_ = head.is_slanted();
  if (!take_tables(in, head)) return "is damaged: its tables contradict each other";
  using map_detail::Part;
  auto left = static_cast<std::size_t>(head.inside);
  for (const Part of : {Part::cold, Part::across}) {
    if (part == Part::across || !(of == Part::cold ? info_.heat : info_.directional)) continue;
    // the first of two says how long it is
    std::size_t length = left;
    if (of == Part::cold && info_.directional) {
      const std::uint64_t stated_length = map_detail::Reader(in.skip(0) + 16).u64();
      if (stated_length % 8 != 0 || stated_length > left - map_detail::head_size - 8)
        return "is damaged: its maps differ";
      length = static_cast<std::size_t>(stated_length);
    }
    auto inside = std::make_shared<FrictionMap>();
    const std::string reason = inside->take(in.skip(length), length, of);
    left -= length;
    if (!reason.empty())
      return std::string("is damaged: its map ") + (of == Part::cold ? "without heat " : "of forces across ") + reason;
    const bool fits = of == Part::cold ? inside->info_.directional == info_.directional
                                       : inside->info_.temperature == info_.temperature &&
                                             inside->info_.heat == info_.heat && inside->is_slanted_ == is_slanted_;
    if (!fits) return "is damaged: its maps differ";
    (of == Part::cold ? cold_ : across_) = std::move(inside);
  }
  if (left > 0) return "is damaged: its maps differ";
  info_.text.assign(reinterpret_cast<const char*>(in.skip(head.text)), head.text);
  return {};
}

/// Takes all from the table of ln a_T to the cells, and what look-ups need of it; false where it contradicts itself.
inline bool FrictionMap::take_tables(map_detail::Reader& in, const map_detail::Head& head) {
  const double kelvin = info_.temperature[1] - info_.temperature[0];
  in.numbers(shift_, head.shifts(), 1e3);
  if (is_slanted_) {
    const double end = 1 + shift_[1] * kelvin;
    if (!in.good || !(end >= 1e-9)) return false;  // there is a pole
    const double whole = shift_[0] * kelvin / end;
    if (!(std::fabs(whole) <= 1e3)) return false;
    log_a_T_[whole < 0 ? 0 : 1] = whole;
  }
  std::vector<double> sliding;
  in.numbers(sliding, 2 * std::size_t{head.columns} * head.rows, 1e3);
  in.numbers(ends_, head.bands + std::size_t{1}, 2000);
  for (std::size_t i = 0; i < head.bands; ++i)
    if (!(ends_[i] < ends_[i + 1])) return false;
  ends_.erase(ends_.begin());
  ends_.back() = 1e308;  // beyond all
  in.numbers(offset_, 2 * std::size_t{head.offsets}, 1e3);
  if (!take_grids(in, head)) return false;
  cell_size_ = head.cell_size();
  in.cells(corners_, cells_, head.cells, cell_size_ / 8, 1e100);
  if (!in.good) return false;

  first_x_ = map_detail::ln(info_.velocity[0]);
  last_x_ = map_detail::ln(info_.velocity[1]);
  const auto over = [](double length, std::uint32_t nodes) {
    return map_detail::Steps{(nodes - 1) / length, nodes < 2 ? 0 : std::int64_t{nodes} - 2};
  };
  if (head.nodes > 1) {
    steps_ = head.nodes - 1;
    third_ = over(is_slanted_ ? 1 : kelvin, head.nodes);
    step_of_third_ = 1 / third_.per_unit;
    if (info_.heat && !is_slanted_) shift_ = map_detail::cubics(shift_, head.nodes, step_of_third_);
  }
  if (info_.heat) {
    sliding_x_ = over(last_x_ - first_x_, head.columns);
    if (head.rows > 1) sliding_T_ = over(kelvin, head.rows);
    row_size_ = 8 * (std::int64_t{head.columns} - 1);
    sliding_ = map_detail::with_differences(map_detail::cubics(sliding, head.columns, 1 / sliding_x_.per_unit),
                                            4 * (std::size_t{head.columns} - 1));
  }
  if (head.offsets > 0) {
    offset_steps_ = over(last_x_ - first_x_, head.offsets);
    offset_ = map_detail::cubics(offset_, head.offsets, 1 / offset_steps_.per_unit);
  }
  ln_shear_stress_ = info_.shear_stress > 0 ? map_detail::ln(info_.shear_stress) : 0;
  ln_reference_ = info_.shear_stress > 0 ? map_detail::ln(info_.reference_velocity) : 0;
  width_ = info_.width / (2.302585092994045684 * 2.302585092994045684);
  return true;
}

inline bool FrictionMap::take_grids(map_detail::Reader& in, const map_detail::Head& head) {
  // Steps of a grid are counted in 64 bits; x is no further from 0 than 700, s between its nodes than 1e7.
  constexpr double far_x = 1e3, far_z = 2e7, most_steps = 4e18;
  std::uint64_t used = 0;
  grids_.resize(head.grids);
  for (map_detail::Grid& grid : grids_) {
    in.numbers({&grid.x, &grid.z, &grid.columns.per_unit, &grid.rows.per_unit}, -1e12, 1e12);
    for (map_detail::Steps* const steps : {&grid.columns, &grid.rows}) steps->last = std::int64_t{in.u32()} - 1;
    grid.first = in.u32();
    if (in.u32() != 0 || !in.good || grid.columns.last < 0 || grid.rows.last < 0 || grid.first != used ||
        !((std::fabs(grid.x) + far_x) * std::fabs(grid.columns.per_unit) < most_steps) ||
        !((std::fabs(grid.z) + far_z) * std::fabs(grid.rows.per_unit) < most_steps) ||
        grid.entries() > head.entries - used)
      return false;
    used += grid.entries();
  }
  entries_.resize(head.entries);
  for (std::int32_t& entry : entries_) {
    entry = static_cast<std::int32_t>(in.u32());
    if (entry >= std::int64_t{head.cells} || -1 - std::int64_t{entry} >= std::int64_t{head.grids}) return false;
  }
  in.skip(map_detail::Head::padding(4ull * head.entries));
  return used == head.entries && map_detail::no_grid_in_itself(grids_, entries_);
}

inline bool FrictionMap::load(const char* path, std::string& why) {
  const auto unreadable = [&](const std::string& reason) {
    why = std::string(path) + ": cannot be read: " + reason;
    return false;
  };
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (status.type() == std::filesystem::file_type::not_found || status.type() == std::filesystem::file_type::none)
    return unreadable(problem ? problem.message() : "no such file");
  if (!std::filesystem::is_regular_file(status)) return unreadable("is no regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path, "rb"), &std::fclose);
  if (!file) return unreadable(std::strerror(errno));
  std::vector<unsigned char> bytes;
  unsigned char block[65536];
  std::size_t n = 0;
  while ((n = std::fread(block, 1, sizeof block, file.get())) > 0) {
    bytes.insert(bytes.end(), block, block + n);
    if (bytes.size() >= 8 && std::memcmp(bytes.data(), "ASPERMAP", 8) != 0) break;  // it is no map, however long
  }
  if (std::ferror(file.get()) != 0) return unreadable(std::strerror(errno));
  if (read(bytes.data(), bytes.size(), why)) return true;
  why = std::string(path) + ": " + why;
  return false;
}

}  // namespace asperity

#ifdef _MSC_VER
#pragma warning(pop)
#endif

extern "C" {
#else
#include <stddef.h>
#endif

// The same for C, Fortran (iso_c_binding) and Simulink (S-functions, coder.ceval). One C++ file of the host holds
//   #define ASPERITY_FRICTION_MAP_C
//   #include <asperity/friction_map.hpp>
// and thereby the definitions; C files include this header for the declarations alone.

typedef struct asperity_map asperity_map;

/// A map, or NULL and in `why`, of `size` bytes, a line that says why not.
asperity_map* asperity_map_load(const char* path, char* why, size_t size);
void asperity_map_free(asperity_map* map);

/// mu [-] at pressure [Pa], velocity [m/s] and a_T (1: the map's own temperature). Outside of the box NaN, or with
/// `clamp` other than 0 the value at the nearest point of the box.
double asperity_map_mu(const asperity_map* map, double pressure, double velocity, double a_T, int clamp);

/// mu at each of n points, the digits of asperity_map_mu in less time.
void asperity_map_mu_at_points(const asperity_map* map, size_t n, const double* pressure, const double* velocity,
                               double a_T, int clamp, double* mu);

/// `out` receives mu, hysteresis, adhesion, contact area, dmu/dlnp, dmu/dlnv. Returns 0, 1 or 2 where the pressure or
/// the velocity is outside of the box, 3 where a number is NaN, 5 (and NaN) where a_T is not 1 on a map with heat.
int asperity_map_at(const asperity_map* map, double pressure, double velocity, double a_T, int clamp, double out[6]);

/// The same of a map that knows directions, at one of sliding [rad]; out[6] receives the force across over the load.
int asperity_map_toward(const asperity_map* map, double pressure, double velocity, double a_T, double direction,
                        int clamp, double out[7]);

/// The same of a map with heat, at a temperature [K] of the background (0: its only one), a distance [m] slid since
/// rest (1e300: long ago). NaN and 5 on a map without heat, 4 where the temperature is outside of the box.
double asperity_map_hot_mu(const asperity_map* map, double pressure, double velocity, double temperature,
                           double distance, int clamp);
int asperity_map_hot_at(const asperity_map* map, double pressure, double velocity, double temperature, double distance,
                        int clamp, double out[6]);

/// Relative error that the map was certified for.
double asperity_map_max_error(const asperity_map* map);

#ifdef __cplusplus
}  // extern "C"

#ifdef ASPERITY_FRICTION_MAP_C

struct asperity_map {
  asperity::FrictionMap map;
};

asperity_map* asperity_map_load(const char* path, char* why, size_t size) {
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
  try {
#endif
    auto loaded = std::make_unique<asperity_map>();
    std::string reason;
    if (loaded->map.load(path, reason)) return loaded.release();
    if (size > 0) std::snprintf(why, size, "%s", reason.c_str());
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
  } catch (...) {  // which must not reach C: nothing else is thrown
    if (size > 0) std::snprintf(why, size, "%s: does not fit into memory", path);
  }
#endif
  return nullptr;
}

void asperity_map_free(asperity_map* map) { delete map; }

namespace asperity::map_detail {

inline FrictionMap::Outside outside_of(int clamp) noexcept {
  return clamp != 0 ? FrictionMap::Outside::clamp : FrictionMap::Outside::nan;
}

inline int numbers_at(const FrictionMap& map, double pressure, double velocity, const MapTemperature& temperature,
                      int clamp, double* out, int n = 6) noexcept {
  MapPoint point;
  const auto status = map.at(pressure, velocity, point, outside_of(clamp), temperature);
  const double values[] = {point.mu,       point.hysteresis, point.adhesion, point.contact_area,
                           point.dmu_dlnp, point.dmu_dlnv,   point.lateral};
  for (int i = 0; i < n; ++i) out[i] = values[i];
  return static_cast<int>(status);
}

/// A temperature of the background as a map with heat takes it, which one without refuses.
inline MapTemperature hot(const FrictionMap& map, double temperature, double distance) noexcept {
  return {1, false, map.info().heat ? temperature : -1, distance};
}

}  // namespace asperity::map_detail

double asperity_map_mu(const asperity_map* map, double pressure, double velocity, double a_T, int clamp) {
  return map->map.mu(pressure, velocity, asperity::map_detail::outside_of(clamp), {a_T, false});
}

void asperity_map_mu_at_points(const asperity_map* map, size_t n, const double* pressure, const double* velocity,
                               double a_T, int clamp, double* mu) {
  map->map.mu_at_points(n, pressure, velocity, mu, asperity::map_detail::outside_of(clamp), {a_T, false});
}

int asperity_map_at(const asperity_map* map, double pressure, double velocity, double a_T, int clamp, double out[6]) {
  return asperity::map_detail::numbers_at(map->map, pressure, velocity, {a_T, false}, clamp, out);
}

int asperity_map_toward(const asperity_map* map, double pressure, double velocity, double a_T, double direction,
                        int clamp, double out[7]) {
  using asperity::map_detail::long_slid;
  return asperity::map_detail::numbers_at(map->map, pressure, velocity, {a_T, false, 0, long_slid, direction}, clamp,
                                          out, 7);
}

double asperity_map_hot_mu(const asperity_map* map, double pressure, double velocity, double temperature,
                           double distance, int clamp) {
  using namespace asperity::map_detail;
  return map->map.mu(pressure, velocity, outside_of(clamp), hot(map->map, temperature, distance));
}

int asperity_map_hot_at(const asperity_map* map, double pressure, double velocity, double temperature, double distance,
                        int clamp, double out[6]) {
  using namespace asperity::map_detail;
  return numbers_at(map->map, pressure, velocity, hot(map->map, temperature, distance), clamp, out);
}

double asperity_map_max_error(const asperity_map* map) { return map->map.info().max_error; }

#endif  // ASPERITY_FRICTION_MAP_C
#endif  // __cplusplus
#endif  // ASPERITY_FRICTION_MAP_HPP
