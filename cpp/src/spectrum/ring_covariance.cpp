// How alike a window makes the means of neighbouring rings of modes, from the window's own transform. For Gaussian
// heights whose spectrum hardly changes over the width of the window's transform, cov(|h(k)|^2, |h(k + j)|^2) is
// C(k)^2 |W(j)|^2, W the transform of w^2 with W(0) = 1 (D. B. Percival and A. T. Walden, Spectral Analysis for
// Physical Applications, Cambridge 1993, Sec. 6.3). Rings of width 1 add up such pairs: a step j of the plane leads m
// rings outwards for a share max(0, 1 - |m - j cos|) of the places in a ring, in the mean over its directions. Of two
// tiles of a map that overlap, W is the transform of the product of their windows where they lie (P. D. Welch, IEEE
// Trans. Audio Electroacoust. 15, 70 (1967)).
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "asperity/tiles.hpp"
#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"
#include "spectrum/window.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

// Where one side is many times the other, steps along the short one lead over many rings, and tie no two of them much.
constexpr std::size_t most_rings = 32;
constexpr double told = 1e-3;    // of what is left out
constexpr int directions = 180;  // in a quarter of a ring: the mean over them is exact to 1e-4

}  // namespace

std::vector<double> mode_covariances(const std::vector<double>& window, std::size_t shift) {
  const std::size_t n = window.size();
  const Scratch<double> products(n);
  const Scratch<std::complex<double>> modes(n / 2 + 1);
  double square = 0, fourth = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double product = i + shift < n ? window[i] * window[i + shift] : 0;
    products.data()[i] = product;
    square += window[i] * window[i];
    fourth += product * product;
  }
  const RealTransform<double> transform(n);
  transform(products.data(), modes.data());
  const double all = static_cast<double>(n) * fourth / (square * square);  // Parseval: over all j of either sign
  std::vector<double> result{std::norm(modes.data()[0]) / (square * square)};
  double sum = result[0];
  for (std::size_t j = 1; 2 * j < n && all - sum > told * all; ++j) {
    result.push_back(std::norm(modes.data()[j]) / (square * square));
    sum += 2 * result.back();
  }
  return result;
}

std::vector<double> ring_covariances(const std::vector<double>& window_y, const std::vector<double>& window_x,
                                     std::array<double, 2> step, std::array<std::size_t, 2> shift) {
  const std::vector<double> y = mode_covariances(window_y, shift[0]), x = mode_covariances(window_x, shift[1]);
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
  result[0] = 2 * result[0] - y[0] * x[0];
  while (result.size() > 1 && result.back() < told * result[0]) result.pop_back();
  return result;
}

std::vector<double> tile_covariances(Window window, HeightMap::Shape tile, HeightMap::PixelSize pixel_size,
                                     HeightMap::Shape shift) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (tile[side] < 2) refuse("tile", static_cast<double>(tile[side]), "2 points or more a side");
    if (shift[side] >= tile[side])
      refuse("shift", static_cast<double>(shift[side]), "less than the side of a tile: others share no points");
    require_positive("pixel_size", pixel_size[side]);
  }
  const double ly = static_cast<double>(tile[0]) * pixel_size[0], lx = static_cast<double>(tile[1]) * pixel_size[1];
  const double longest = std::max(ly, lx);
  return ring_covariances(window_weights(window, tile[0]), window_weights(window, tile[1]),
                          {longest / ly, longest / lx}, shift);
}

}  // namespace asperity
