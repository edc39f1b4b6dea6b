#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "asperity/spectrum.hpp"
#include "checks.hpp"
#include "fourier.hpp"
#include "surface_rows.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Periodic windows, w(N) = w(0). Split cosine bell (Eq. 25): cos^2(5 pi n / N - pi / 2) = sin^2(5 pi n / N)
/// over the first and the last tenth.
std::vector<double> window_weights(Window window, std::size_t n) {
  std::vector<double> w(n, 1.0);
  for (std::size_t i = 0; i < n && window != Window::none; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n);
    if (window == Window::hann) w[i] = std::pow(std::sin(pi * x), 2);
    if (window == Window::split_cosine_bell && (x < 0.1 || x > 0.9)) w[i] = std::pow(std::sin(5 * pi * x), 2);
  }
  return w;
}

double mean_square(const std::vector<double>& w) {
  double sum = 0;
  for (const double x : w) sum += x * x;
  return sum / static_cast<double>(w.size());
}

/// Signed index of the k-th mode of n.
double mode(std::size_t k, std::size_t n) {
  return k <= n / 2 ? static_cast<double>(k) : static_cast<double>(k) - static_cast<double>(n);
}

}  // namespace

TabulatedSpectrum power_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend) {
  if (map.dropout_fraction() > 0)
    throw InvalidInput("surface: has drop-outs (" + show(100 * map.dropout_fraction(), 4) +
                       " %), fill_dropouts must come before power_spectrum");
  const auto [ny, nx] = map.shape();
  if (ny < 2 || nx < 2)
    throw InvalidInput("surface has shape (" + std::to_string(ny) + ", " + std::to_string(nx) +
                       "): must be 2 x 2 or more for a two-dimensional spectrum");
  const std::vector<double> wy = window_weights(window, ny), wx = window_weights(window, nx);
  const std::optional<Trend> trend = detrend ? std::optional<Trend>(std::in_place, map, *detrend) : std::nullopt;

  std::vector<double> heights(ny * nx);
  for (std::size_t y = 0; y < ny; ++y) {
    const std::span<double> row(heights.data() + y * nx, nx);
    map.read_row(y, row.data());
    if (trend) trend->subtract(y, row);
    for (std::size_t x = 0; x < nx; ++x) row[x] *= wy[y] * wx[x];
  }
  const std::vector<std::complex<double>> modes = forward_transform(heights, {ny, nx});

  // Rings round(|q| / dq), counted over the full plane: a mode off the axes k_x = 0 and k_x = nx / 2 stands for
  // its mirror image too.
  const auto [dy, dx] = map.pixel_size();
  const double ly = static_cast<double>(ny) * dy, lx = static_cast<double>(nx) * dx;
  const double dq = 2 * pi / std::max(ly, lx);
  const double corner = std::hypot(pi / dy, pi / dx);
  const auto rings = static_cast<std::size_t>(corner / dq + 0.5) + 1;
  std::vector<double> sum(rings, 0), sum_q(rings, 0), count(rings, 0);
  const std::size_t half = nx / 2 + 1;
  for (std::size_t ky = 0; ky < ny; ++ky) {
    const double qy = 2 * pi / ly * mode(ky, ny);
    for (std::size_t kx = 0; kx < half; ++kx) {
      const double q = std::hypot(qy, 2 * pi / lx * static_cast<double>(kx));
      const double weight = kx == 0 || 2 * kx == nx ? 1 : 2;
      const auto ring = std::min(rings - 1, static_cast<std::size_t>(q / dq + 0.5));
      sum[ring] += weight * std::norm(modes[ky * half + kx]);
      sum_q[ring] += weight * q;
      count[ring] += weight;
    }
  }

  // Eqs 26-27 with n = nx ny points: C = A / ((2 pi)^2 n^2) |sum|^2, over the window's mean square.
  const double n = static_cast<double>(ny) * static_cast<double>(nx);
  const double scale = ly * lx / (4 * pi * pi * n * n) / (mean_square(wy) * mean_square(wx));
  std::vector<double> wavenumber, density, counts;
  for (std::size_t ring = 1; ring < rings; ++ring) {  // ring 0 is the mean height
    if (count[ring] == 0) continue;                   // non-square pixels leave rings empty near the corner
    wavenumber.push_back(sum_q[ring] / count[ring]);
    density.push_back(scale * sum[ring] / count[ring]);
    counts.push_back(count[ring]);
  }
  if (wavenumber.size() < 2)
    throw InvalidInput("surface has shape (" + std::to_string(ny) + ", " + std::to_string(nx) +
                       "): must have more points, these make one ring of wavenumbers only");
  return TabulatedSpectrum(std::move(wavenumber), std::move(density), std::move(counts));
}

}  // namespace asperity
