// The spectrum of a map in the plane of wave vectors.
#include <numbers>

#include "asperity/spectrum.hpp"
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

}  // namespace asperity
