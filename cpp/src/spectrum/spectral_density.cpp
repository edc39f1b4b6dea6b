// The spectrum of a map in the plane of wave vectors, and its anisotropy: the principal axes of
// <dh/dx_i dh/dx_j> = int q_i q_j C d^2q.
#include <cmath>
#include <numbers>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "spectrum/fft2d.hpp"
#include "spectrum/window.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Wavenumber of the k-th of n modes, those beyond n / 2 being negative. The Nyquist mode counts as negative.
double wavenumber_of(std::size_t k, std::size_t n, double pixel) {
  const double index = 2 * k >= n ? static_cast<double>(k) - static_cast<double>(n) : static_cast<double>(k);
  return 2 * pi / (static_cast<double>(n) * pixel) * index;
}

/// Position of the k-th mode when wavenumbers rise.
std::size_t place(std::size_t k, std::size_t n) { return (k + n / 2) % n; }

std::vector<double> rising_wavenumbers(std::size_t n, double pixel) {
  std::vector<double> q(n);
  for (std::size_t k = 0; k < n; ++k) q[place(k, n)] = wavenumber_of(k, n, pixel);
  return q;
}

}  // namespace

SpectralDensity spectral_density(const HeightMap& map, Window window, std::optional<Detrend> detrend) {
  const Preparation prepared = prepare(map, window, detrend, 1);
  const std::size_t ny = map.shape()[0], nx = map.shape()[1];
  SpectralDensity result{rising_wavenumbers(ny, map.pixel_size()[0]), rising_wavenumbers(nx, map.pixel_size()[1]),
                         std::vector<double>(ny * nx)};
  for_each_mode_column(map, prepared, 1, [&](unsigned, std::size_t kx, const auto* column) {
    for (std::size_t ky = 0; ky < ny; ++ky) {
      const double c = prepared.scale * std::norm(std::complex<double>(column[ky]));
      result.density[place(ky, ny) * nx + place(kx, nx)] = c;
      result.density[place((ny - ky) % ny, ny) * nx + place((nx - kx) % nx, nx)] = c;  // its mirror image
    }
  });
  return result;
}

// <dh/dx_i dh/dx_j> = int q_i q_j C d^2q, whose principal axis of the lesser value is the lay.
Anisotropy anisotropy(const HeightMap& map, Window window, std::optional<Detrend> detrend, std::optional<double> q_min,
                      std::optional<double> q_max) {
  if (q_min) require_positive("q_min", *q_min);
  if (q_max) require_positive("q_max", *q_max);
  const Preparation prepared = prepare(map, window, detrend, 1);
  const std::size_t ny = map.shape()[0], nx = map.shape()[1];
  const auto [dy, dx] = map.pixel_size();
  const double ly = static_cast<double>(ny) * dy, lx = static_cast<double>(nx) * dx;
  const Reliability reliable(window, std::min(ly, lx), std::max(dy, dx), prepared.ring_covariances[0]);
  const double lowest = q_min.value_or(reliable.lowest), highest = q_max.value_or(reliable.highest);
  if (!(highest > lowest))
    throw InvalidInput(argument("surface") + ": has no band between " + show(lowest, 6) +
                       " 1/m, the longest waves that the window leaves, and " + show(highest, 6) +
                       ", half of pi / pixel: is too small for its anisotropy; q_min and q_max choose one");
  double xx = 0, xy = 0, yy = 0;
  std::size_t modes = 0;
  for_each_mode_column(map, prepared, 1, [&](unsigned, std::size_t kx, const auto* column) {
    const double qx = 2 * pi / lx * static_cast<double>(kx), mirrored = kx == 0 || 2 * kx == nx ? 1 : 2;
    for (std::size_t ky = 0; ky < ny; ++ky) {
      const double qy = wavenumber_of(ky, ny, dy), q = std::hypot(qx, qy);
      if (q < lowest || q > highest || q == 0) continue;
      const double c = mirrored * std::norm(std::complex<double>(column[ky]));
      xx += c * qx * qx;
      xy += c * qx * qy;
      yy += c * qy * qy;
      ++modes;
    }
  });
  if (modes < 16)
    throw InvalidInput(argument("q_min") + ", " + argument("q_max") + ": " + std::to_string(modes) +
                       " modes of the map in [" + show(lowest, 6) + ", " + show(highest, 6) + "] 1/m" + must_be() +
                       "16 or more for its anisotropy");
  const double to_slope = prepared.scale * 4 * pi * pi / (lx * ly);
  const double mean = (xx + yy) / 2, split = std::hypot((xx - yy) / 2, xy);
  const double steep = std::atan2(2 * xy, xx - yy) / 2;  // direction of the greatest slope, in (-pi/2, pi/2]
  return {std::sqrt(to_slope * (mean + split)), std::sqrt(to_slope * std::fmax(0, mean - split)),
          steep > 0 ? steep - pi / 2 : steep + pi / 2};
}

}  // namespace asperity
