// The spectrum of line scans, C1D = L / (2 pi n^2) |sum w h exp(-i q x)|^2 over the window's mean square, averaged over
// the lines.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"
#include "spectrum/height_moments.hpp"
#include "spectrum/window.hpp"
#include "surface/rows.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Row `y` as a map of its own, its numbers shared.
HeightMap row_of(const HeightMap& map, std::size_t y) {
  const HeightMap::Data data = std::visit(
      [&](const auto* first) { return HeightMap::Data(first + static_cast<std::ptrdiff_t>(y) * map.strides()[0]); },
      map.data());
  return {data, map.strides(), map.owner(), {1, map.shape()[1]}, map.pixel_size()};
}

double mean_of(std::span<const double> heights) {
  return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

/// Heights of one side of their mean about it, the others at 0, less the mean of all; how many are of that side.
double keep_side(std::span<double> heights, Part part) {
  const double points = keep_side(heights, mean_of(heights), part), mean = mean_of(heights);
  for (double& z : heights) z -= mean;
  return points;
}

}  // namespace

// The sum of C1D over the modes of both signs, times 2 pi / L, is the mean square height. Rows nearer to each other
// than half a wavelength are not independent: the error counts one for each half wavelength.
LineSpectrum line_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend, Part part) {
  require_filled(map);
  const std::size_t rows = map.shape()[0], n = map.shape()[1];
  if (n < 4)
    throw InvalidInput(argument("surface") + " has " + count(n) + " points along x" + must(": must have ") +
                       "4 or more");
  const std::vector<double> w = window_weights(window, n);
  const WindowMoments moments(w);
  const RealTransform<double> transform(n);
  const Scratch<double> heights(n);
  const Scratch<std::complex<double>> modes(n / 2 + 1);
  std::vector<double> power(n / 2 + 1), square(n / 2 + 1);
  HeightMoments powers;
  double kept = 0;
  const double anchor = detrend ? 0 : first_height(map);
  for (std::size_t y = 0; y < rows; ++y) {
    heed();
    const HeightMap row = row_of(map, y);
    row.read_row(0, heights.data());
    if (detrend) Trend(row, *detrend).subtract(0, heights.data(), heights.data());
    powers.add(Eigen::ArrayXd::Map(heights.data(), static_cast<Eigen::Index>(n)), anchor);
    if (part != Part::all) kept += keep_side({heights.data(), n}, part);
    for (std::size_t x = 0; x < n; ++x) heights.data()[x] *= w[x];
    transform(heights.data(), modes.data());
    for (std::size_t k = 1; k < power.size(); ++k) {
      const double p = std::norm(modes.data()[k]);
      power[k] += p;
      square[k] += p * p;
    }
  }
  const auto [dy, dx] = map.pixel_size();
  const auto count = static_cast<double>(rows), points = static_cast<double>(n);
  const double share = kept > 0 ? kept / (points * count) : 1;  // a flat scan has no side
  const double scale = dx / (2 * pi * points * moments.mean_square * count * share);
  const Reliability reliable(window, points * dx, dx, moments.variance_factor);
  std::vector<double> wavenumber, density;
  RowQuality quality;
  if (part == Part::all) quality.heights = powers.shape();
  for (std::size_t k = 1; k < power.size(); ++k) {
    const double q = 2 * pi / (points * dx) * static_cast<double>(k), both_signs = 2 * k == n ? 1 : 2;
    const double independent = rows == 1 ? 1 : std::min(1.0, dy * q / pi);  // of each row
    wavenumber.push_back(q);
    density.push_back(scale * power[k]);
    quality.count.push_back(both_signs * count);
    quality.standard_error.push_back(scale * std::sqrt(moments.variance_factor * square[k] / 2 / independent));
    quality.flag.push_back(reliable.flag(q, 2 * count * independent));
  }
  return {std::move(wavenumber), std::move(density), std::move(quality)};
}

LineSpectrum line_spectrum(const LineScan& scan, Window window, std::optional<Detrend> detrend, Part part) {
  return line_spectrum(scan.row(), window, detrend, part);
}

}  // namespace asperity
