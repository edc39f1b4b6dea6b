#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/spectrum.hpp"
#include "checks.hpp"
#include "fourier.hpp"
#include "segments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Splitmix64 (Steele, Lea and Flood, OOPSLA 2014): the same stream on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [0, 1).
  double operator()() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

// h(x) = sum over all modes of sqrt(C (2 pi)^2 / A) exp(i (q x + phase)), phases of q and -q opposite. Modes that
// are their own mirror image are real: their phase is 0 or pi.
HeightMap synthesize(const Spectrum& spectrum, HeightMap::Shape shape, HeightMap::PixelSize pixel_size,
                     std::uint64_t seed) {
  const auto [ny, nx] = shape;
  if (ny < 2 || nx < 2)
    throw InvalidInput("shape = (" + std::to_string(ny) + ", " + std::to_string(nx) + "): must be 2 x 2 or more");
  require_positive("pixel_size", pixel_size[0]);
  require_positive("pixel_size", pixel_size[1]);
  const std::vector<Segment> pieces = segments(spectrum);
  const auto [q0, q1] = band(spectrum);
  const double ly = static_cast<double>(ny) * pixel_size[0], lx = static_cast<double>(nx) * pixel_size[1];
  constexpr double rounding = 1e-9;  // a band that starts at 2 pi / side holds the mode 2 pi / side
  Random random(seed);
  if (rms_height(spectrum) == 0)
    throw InvalidInput("spectrum: its density is 0 everywhere, must be positive somewhere");
  bool any = false;

  const std::size_t half = nx / 2 + 1;
  std::vector<std::complex<double>> modes(ny * half);
  for (std::size_t ky = 0; ky < ny; ++ky) {
    const double qy = 2 * pi / ly * static_cast<double>(std::min(ky, ny - ky));
    for (std::size_t kx = 0; kx < half; ++kx) {
      const double phase = 2 * pi * random();
      const double q = std::hypot(qy, 2 * pi / lx * static_cast<double>(kx));
      if (q < q0 * (1 - rounding) || q > q1 * (1 + rounding)) continue;
      const double inside = std::clamp(q, q0, q1);
      const double c = std::ranges::lower_bound(pieces, inside, {}, &Segment::b)->density(inside);
      const double amplitude = std::sqrt(c * 4 * pi * pi / (lx * ly));
      any = true;
      const bool own_column = kx == 0 || 2 * kx == nx;
      const std::size_t mirror = (ny - ky) % ny;
      if (own_column && mirror == ky)
        modes[ky * half + kx] = phase < pi ? amplitude : -amplitude;
      else if (own_column && mirror < ky)
        modes[ky * half + kx] = std::conj(modes[mirror * half + kx]);
      else
        modes[ky * half + kx] = std::polar(amplitude, phase);
    }
  }
  if (!any)
    throw InvalidInput("spectrum: its band [" + show(q0) + ", " + show(q1) +
                       "] 1/m holds no mode of this grid, whose wavenumbers run from " +
                       show(2 * pi / std::max(lx, ly)) + " to " +
                       show(std::hypot(pi / pixel_size[0], pi / pixel_size[1])) + " 1/m");
  return HeightMap(backward_transform(modes, {ny, nx}), shape, pixel_size);
}

}  // namespace asperity
