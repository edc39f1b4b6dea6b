// Windows that bring a scan to zero at its ends, their effect on the statistics, and the rows that they leave reliable.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Periodic weights, w(N) = w(0). Split cosine bell (Eq. 25): cos^2(5 pi n / N - pi / 2) = sin^2(5 pi n / N) over
/// the first and the last tenth. Blackman: 0.42 - 0.5 cos(2 pi n / N) + 0.08 cos(4 pi n / N) (F. J. Harris, Proc. IEEE
/// 66, 51 (1978)).
inline std::vector<double> window_weights(Window window, std::size_t n) {
  using std::numbers::pi;
  std::vector<double> w(n, 1.0);
  for (std::size_t i = 0; i < n && window != Window::none; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n);
    if (window == Window::hann) w[i] = std::pow(std::sin(pi * x), 2);
    if (window == Window::split_cosine_bell && (x < 0.1 || x > 0.9)) w[i] = std::pow(std::sin(5 * pi * x), 2);
    if (window == Window::blackman) w[i] = 0.42 - 0.5 * std::cos(2 * pi * x) + 0.08 * std::cos(4 * pi * x);
  }
  return w;
}

/// Periods on the scan below which a window lets longer waves into a row. On crops of self-affine maps (H 0.5, 0.8, 1,
/// 512^2 of 2048^2) rows from here on are within 4 % of the truth.
inline double smeared_periods(Window window) {
  switch (window) {
    case Window::none:
      return 0;
    case Window::hann:
      return 10;
    case Window::blackman:
      return 12;
    default:
      return 16;
  }
}

/// The effect of a window on the statistics.
struct WindowMoments {
  double mean_square;      // <w^2>: the variance that is left
  double variance_factor;  // <w^4> / <w^2>^2: by how much an average over many modes varies more than without it,
                           // because it makes neighbours alike
  explicit WindowMoments(const std::vector<double>& w) {
    double square = 0, fourth = 0;
    for (const double x : w) {
      square += x * x;
      fourth += x * x * x * x;
    }
    const auto n = static_cast<double>(w.size());
    mean_square = square / n;
    variance_factor = n * fourth / (square * square);
  }
};

/// Limits that follow from the scan and the window.
struct Reliability {
  double lowest;   // [1/m]: rows below hold too few periods of the window's
  double highest;  // [1/m]: rows above are aliased
  double fewest;   // modes: fewer make a mean that is uncertain by more than a quarter

  /// `length` and `pixel` [m] of the shorter side and the coarser pixel. A mean of |h|^2 over n modes, every other one
  /// a mirror image, has the relative standard error sqrt(2 f / n), f the window's variance factor.
  Reliability(Window window, double length, double pixel, double variance_factor)
      : lowest(2 * std::numbers::pi / length * smeared_periods(window)),
        highest(std::numbers::pi / pixel / 2),
        fewest(32 * variance_factor) {}

  [[nodiscard]] std::uint8_t flag(double wavenumber, double modes) const {
    constexpr double rounding = 1e-9;  // exactly 16 periods are 16 periods
    int bits = 0;
    if (wavenumber < lowest * (1 - rounding)) bits |= few_periods;
    if (wavenumber > highest * (1 + rounding)) bits |= near_nyquist;
    if (modes < fewest) bits |= few_modes;
    return static_cast<std::uint8_t>(bits);
  }
};

}  // namespace asperity
