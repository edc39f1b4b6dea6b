// Chebyshev's extreme points and polynomials, with which maps are interpolated before they are cut into cells.
// L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM (2013), chapters 3 and 4.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace asperity {

/// Chebyshev's extreme points, both ends among them: beyond the last of his zeros a kink would not be seen. The
/// coefficient of T_m is the sum of transform[m][k] f(point[k]).
template <std::size_t n>
struct ChebyshevPoints {
  std::array<double, n> point;
  std::array<std::array<double, n>, n> transform;
  ChebyshevPoints() {
    const auto end = [](std::size_t k) { return k == 0 || k == n - 1 ? 0.5 : 1.0; };
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = std::numbers::pi * static_cast<double>(k) / (n - 1);
      point[k] = std::cos(angle);
      for (std::size_t m = 0; m < n; ++m)
        transform[m][k] = 2.0 / (n - 1) * end(m) * end(k) * std::cos(static_cast<double>(m) * angle);
    }
  }
};

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

}  // namespace asperity
