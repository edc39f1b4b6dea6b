// Polynomials through values at Chebyshev's points. L. N. Trefethen, Approximation Theory and Approximation Practice,
// SIAM (2013), chapters 2 to 4.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <numbers>
#include <vector>

namespace asperity {

/// n of Chebyshev's points on [-1, 1]: the zeros of T_n, or his extreme points, with both ends among them, as beyond
/// the last zero a kink would not be seen.
template <std::size_t n, bool with_ends>
struct ChebyshevRule {
  std::array<double, n> point;
  std::array<std::array<double, n>, n> transform;  // a value at point k adds transform[m][k] to the coefficient of T_m

  ChebyshevRule() {
    const double intervals = with_ends ? n - 1 : n;
    const auto half_at_ends = [](std::size_t i) { return with_ends && (i == 0 || i == n - 1) ? 0.5 : 1.0; };
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) + (with_ends ? 0 : 0.5)) / intervals;
      point[k] = std::cos(angle);
      for (std::size_t m = 0; m < n; ++m)
        transform[m][k] = 2 / intervals * (m == 0 ? 0.5 : half_at_ends(m)) * half_at_ends(k) *
                          std::cos(static_cast<double>(m) * angle);
    }
  }

  /// Coefficients of T_0, T_1 ... of the polynomial through values at the points.
  template <class V>
  [[nodiscard]] std::array<V, n> series(const std::array<V, n>& value) const {
    std::array<V, n> result{};
    for (std::size_t m = 0; m < n; ++m)
      for (std::size_t k = 0; k < n; ++k) result[m] += transform[m][k] * value[k];
    return result;
  }
};
template <std::size_t n>
using ChebyshevZeros = ChebyshevRule<n, false>;
template <std::size_t n>
using ChebyshevPoints = ChebyshevRule<n, true>;

template <std::size_t n>
const ChebyshevPoints<n>& chebyshev_points() {
  static const ChebyshevPoints<n> points;
  return points;
}

/// T_i at t.
template <std::size_t n>
std::array<double, n> chebyshev(double t) {
  std::array<double, n> value{1, t};
  for (std::size_t i = 2; i < n; ++i) value[i] = 2 * t * value[i - 1] - value[i - 2];
  return value;
}

/// T_i' and T_i'' at t.
template <std::size_t n>
std::array<std::array<double, n>, 2> chebyshev_slopes(double t) {
  const std::array<double, n> value = chebyshev<n>(t);
  std::array<double, n> slope{0, 1}, bend{};
  for (std::size_t i = 2; i < n; ++i) {
    slope[i] = 2 * value[i - 1] + 2 * t * slope[i - 1] - slope[i - 2];
    bend[i] = 4 * slope[i - 1] + 2 * t * bend[i - 1] - bend[i - 2];
  }
  return {slope, bend};
}

/// Coefficients of 1, t, t^2 ... of a Chebyshev series. Those of T_m grow as 2.4^m, so that the digits are kept where
/// the series falls faster.
template <class V, std::size_t n>
std::array<V, n> powers_of(const std::array<V, n>& series) {
  std::array<V, n> power{};
  std::array<double, n> last{1}, now{0, 1};
  for (std::size_t m = 0; m < n; ++m) {
    for (std::size_t i = 0; i < n; ++i) power[i] += series[m] * last[i];
    std::array<double, n> next{};  // T_m+2 = 2 t T_m+1 - T_m
    for (std::size_t i = 0; i < n; ++i) {
      if (i + 1 < n) next[i + 1] += 2 * now[i];
      next[i] -= last[i];
    }
    last = now;
    now = next;
  }
  return power;
}

/// A function, or several as one register V, as polynomials on equal pieces of a range, each made when a place on it is
/// first asked for. Below the range the value at its lower end holds.
template <class V>
class PiecewiseChebyshev {
 public:
  /// Of a function whose singularities are a unit and more away.
  PiecewiseChebyshev(double lowest, double highest, V (*exact)(double))
      : lowest_(lowest), highest_(highest), exact_(exact), pieces_(1 + piece_at(highest)) {}

  [[nodiscard]] double highest() const { return highest_; }
  /// Up to the highest.
  V operator()(double x) {
    const double at = std::fmax(0, (x - lowest_) / width);
    const auto index = static_cast<std::size_t>(at);
    Piece& piece = pieces_[index];
    if (!piece.made.load(std::memory_order_acquire)) make(index);
    const double u = 2 * (at - static_cast<double>(index)) - 1, square = u * u;
    V even{}, odd{};
    for (std::size_t m = terms; m > 0; m -= 2) {
      odd = odd * square + piece.power[m - 1];
      even = even * square + piece.power[m - 2];
    }
    return even + u * odd;
  }

 private:
  static constexpr std::size_t terms = 18;  // to rounding
  static constexpr double width = 0.5;
  struct Piece {
    std::once_flag once;
    std::atomic<bool> made = false;
    std::array<V, terms> power{};
  };

  [[nodiscard]] std::size_t piece_at(double x) const { return static_cast<std::size_t>((x - lowest_) / width); }
  void make(std::size_t index) {
    std::call_once(pieces_[index].once, [&] {
      static const ChebyshevZeros<terms> zeros;
      std::array<V, terms> value;
      for (std::size_t k = 0; k < terms; ++k)
        value[k] = exact_(lowest_ + width * (static_cast<double>(index) + (1 + zeros.point[k]) / 2));
      pieces_[index].power = powers_of(zeros.series(value));
      pieces_[index].made.store(true, std::memory_order_release);
    });
  }

  double lowest_, highest_;
  V (*exact_)(double);
  std::vector<Piece> pieces_;
};

/// The integral of a Chebyshev series, 0 at -1.
template <std::size_t n>
std::array<double, n + 1> integral_of(const std::array<double, n>& series) {
  std::array<double, n + 1> result{};
  for (std::size_t m = 1; m <= n; ++m) {
    const double below = m == 1 ? 2 * series[0] : series[m - 1], above = m + 1 < n ? series[m + 1] : 0;
    result[m] = (below - above) / (2 * static_cast<double>(m));
    result[0] += m % 2 == 0 ? -result[m] : result[m];
  }
  return result;
}

}  // namespace asperity
