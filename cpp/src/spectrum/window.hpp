// Windows that bring a scan to zero at its ends, and what they do to the statistics.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Periodic weights, w(N) = w(0). Split cosine bell (Eq. 25): cos^2(5 pi n / N - pi / 2) = sin^2(5 pi n / N) over
/// the first and the last tenth.
inline std::vector<double> window_weights(Window window, std::size_t n) {
  using std::numbers::pi;
  std::vector<double> w(n, 1.0);
  for (std::size_t i = 0; i < n && window != Window::none; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n);
    if (window == Window::hann) w[i] = std::pow(std::sin(pi * x), 2);
    if (window == Window::split_cosine_bell && (x < 0.1 || x > 0.9)) w[i] = std::pow(std::sin(5 * pi * x), 2);
  }
  return w;
}

/// What a window does to the statistics.
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

}  // namespace asperity
