// The preparation of a map for its transform: windows that bring it to zero at its ends, their effect on the
// statistics, the rows that they leave reliable, the trend, and the factors that make |sum|^2 a density.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "asperity/spectrum.hpp"
#include "numerics/rounding.hpp"
#include "surface/detrend.hpp"

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
    int bits = 0;
    if (is_below(wavenumber, lowest)) bits |= few_periods;  // exactly 16 periods are 16 periods
    if (is_above(wavenumber, highest)) bits |= near_nyquist;
    if (modes < fewest) bits |= few_modes;
    return static_cast<std::uint8_t>(bits);
  }
};

/// Heights on one side of a mean about it, the others at 0; how many are of that side.
inline double keep_side(std::span<double> heights, double mean, Part part) {
  double points = 0;
  for (double& z : heights) {
    const bool mine = part == Part::top ? z > mean : z < mean;
    z = mine ? z - mean : 0;
    points += mine;
  }
  return points;
}

struct Preparation {
  std::vector<double> wy, wx;  // window weights
  std::optional<Trend> trend;  // taken out
  /// Eqs 26-27 with n = nx ny points: C = A / ((2 pi)^2 n^2) |sum|^2, over the window's mean square.
  double scale;
  std::vector<double> ring_covariances;  // of rings 0, 1, ... apart, as ring_covariances() gives
};

/// Throws where the map has drop-outs.
void require_filled(const HeightMap& map);

/// Throws where the map has drop-outs or no two-dimensional spectrum.
void require_plane(const HeightMap& map);

/// Throws as require_plane does.
Preparation prepare(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads);

/// Covariances of ring means, times n / 2 over the squares of the densities, of rings 0, 1, ... apart, as far as they
/// are worth telling; `step` is the distance of neighbouring modes along either side in units of the width of a ring.
/// With a `shift`, of the means of two maps that lie so many points apart on one surface.
std::vector<double> ring_covariances(const std::vector<double>& window_y, const std::vector<double>& window_x,
                                     std::array<double, 2> step, std::array<std::size_t, 2> shift = {});

/// |W(j)|^2 of w(x) w(x + shift), over the square of the sum of w^2, for j = 0, 1, ... as far as it is worth telling:
/// the covariance of |h|^2 of two modes, j apart, of profiles that lie `shift` apart, over the product of their
/// densities.
std::vector<double> mode_covariances(const std::vector<double>& window, std::size_t shift = 0);

}  // namespace asperity
