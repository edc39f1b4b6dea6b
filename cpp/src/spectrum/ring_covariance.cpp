// How alike a window makes the means of neighbouring rings of modes, from the window's own transform. For Gaussian
// heights whose spectrum hardly changes over the width of the window's transform, cov(|h(k)|^2, |h(k + j)|^2) is
// C(k)^2 |W(j)|^2, W the transform of w^2 with W(0) = 1 (D. B. Percival and A. T. Walden, Spectral Analysis for
// Physical Applications, Cambridge 1993, Sec. 6.3). Rings of width 1 add up such pairs: a step j of the plane leads m
// rings outwards for a share max(0, 1 - |m - j cos|) of the places in a ring, in the mean over its directions.
#include "spectrum/ring_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "numerics/fft.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

// Where one side is many times the other, steps along the short one lead over many rings, and tie no two of them much.
constexpr std::size_t most_rings = 32;
constexpr double told = 1e-3;    // of what is left out
constexpr int directions = 180;  // in a quarter of a ring: the mean over them is exact to 1e-4

}  // namespace

std::vector<double> mode_covariances(const std::vector<double>& window) {
  const std::size_t n = window.size();
  const Scratch<double> squares(n);
  const Scratch<std::complex<double>> modes(n / 2 + 1);
  double square = 0, fourth = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w2 = window[i] * window[i];
    squares.data()[i] = w2;
    square += w2;
    fourth += w2 * w2;
  }
  const RealTransform<double> transform(n);
  transform(squares.data(), modes.data());
  const double all = static_cast<double>(n) * fourth / (square * square);  // Parseval: over all j of either sign
  std::vector<double> result{1};
  double sum = 1;
  for (std::size_t j = 1; 2 * j < n && all - sum > told * all; ++j) {
    result.push_back(std::norm(modes.data()[j]) / (square * square));
    sum += 2 * result.back();
  }
  return result;
}

std::vector<double> ring_covariances(const std::vector<double>& window_y, const std::vector<double>& window_x,
                                     std::array<double, 2> step) {
  const std::vector<double> y = mode_covariances(window_y), x = mode_covariances(window_x);
  std::vector<double> result(most_rings + 1);
  const auto add = [&](double distance, double covariance) {  // to the two rings that a step outwards leads to
    if (!(distance < most_rings)) return;
    const auto m = static_cast<std::size_t>(distance);
    const double upper = distance - static_cast<double>(m);
    result[m] += covariance * (1 - upper);
    result[m + 1] += covariance * upper;
  };
  for (int d = 0; d < directions; ++d) {
    const double angle = (d + 0.5) / directions * pi / 2;
    for (std::size_t jy = 0; jy < y.size(); ++jy)
      for (std::size_t jx = 0; jx < x.size(); ++jx) {
        const double up = static_cast<double>(jy) * step[0] * std::sin(angle);
        const double along = static_cast<double>(jx) * step[1] * std::cos(angle);
        const double covariance = y[jy] * x[jx] / directions;
        add(up + along, covariance);
        if (jy > 0 && jx > 0) add(std::fabs(up - along), covariance);
      }
  }
  // of a step and its opposite one leads outwards; both may stay in the ring, but it is one step to the mode itself
  result[0] = 2 * result[0] - 1;
  while (result.size() > 1 && result.back() < told * result[0]) result.pop_back();
  return result;
}

}  // namespace asperity
