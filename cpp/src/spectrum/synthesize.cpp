// Surfaces of a given spectrum: Fourier modes of fixed moduli and random phases, bent where a skewness is asked for.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"
#include "numerics/random.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/height_moments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Where the modes of a grid lie, in the half plane that a real transform keeps.
struct Modes {
  HeightMap::Shape shape;
  std::vector<std::complex<double>> values;  // ny x half
  [[nodiscard]] std::size_t half() const { return shape[1] / 2 + 1; }

  /// set(k_y, k_x, own) for every mode, `own` where it is its own mirror image and so real; those that are the mirror
  /// image of another in the same column become its conjugate.
  template <class Set>
  void fill(Set set) {
    const auto [ny, nx] = shape;
    for (std::size_t ky = 0; ky < ny; ++ky) {
      heed();
      for (std::size_t kx = 0; kx < half(); ++kx) {
        const bool own_column = kx == 0 || 2 * kx == nx;
        const std::size_t mirror = (ny - ky) % ny;
        std::complex<double> value = set(ky, kx, own_column && mirror == ky);
        if (own_column && mirror < ky) value = std::conj(values[mirror * half() + kx]);
        values[ky * half() + kx] = value;
      }
    }
  }
  [[nodiscard]] std::vector<double> heights() const {
    auto modes = values;
    return backward_transform(modes, {shape[0], shape[1]});
  }
};

/// sqrt(C (2 pi)^2 / A) of each mode.
std::vector<double> amplitudes(const Spectrum& spectrum, HeightMap::Shape shape, HeightMap::PixelSize pixel_size) {
  const auto [ny, nx] = shape;
  const PlaneDensity density(spectrum);
  const auto [q0, q1] = band(spectrum);
  const double ly = static_cast<double>(ny) * pixel_size[0], lx = static_cast<double>(nx) * pixel_size[1];
  const std::size_t half = nx / 2 + 1;
  std::vector<double> result(ny * half);
  const bool directional = is_directional(spectrum);
  bool any = false;
  for (std::size_t ky = 0; ky < ny; ++ky) {
    heed();
    const bool upper = 2 * ky > ny;  // negative wavenumbers
    const double qy = 2 * pi / ly * static_cast<double>(upper ? ny - ky : ky);
    for (std::size_t kx = 0; kx < half; ++kx) {
      const double q = std::hypot(qy, 2 * pi / lx * static_cast<double>(kx));
      if (!is_within(q, q0, q1)) continue;  // a band that starts at 2 pi / side holds the mode 2 pi / side
      const double inside = std::clamp(q, q0, q1);
      const double direction = directional ? std::atan2(upper ? -qy : qy, 2 * pi / lx * static_cast<double>(kx)) : 0;
      const double c = std::fmax(0, density(inside, direction));  // harmonics of a scan leave ripples
      result[ky * half + kx] = std::sqrt(c * 4 * pi * pi / (lx * ly));
      any = true;
    }
  }
  if (!any)
    throw InvalidInput(argument("spectrum") + ": its band [" + show(q0, 6) + ", " + show(q1, 6) +
                       "] 1/m holds no mode of this grid, whose wavenumbers run from " +
                       show(2 * pi / std::max(lx, ly), 6) + " to " +
                       show(std::hypot(pi / pixel_size[0], pi / pixel_size[1]), 6) + " 1/m");
  return result;
}

HeightMoments moments(const std::vector<double>& z) {
  HeightMoments result;
  result.add(Eigen::ArrayXd::Map(z.data(), static_cast<Eigen::Index>(z.size())), 0);
  return result;
}

double skewness_of(const std::vector<double>& z) { return moments(z).shape().value_or(HeightShape{}).skewness; }

/// Heights z of skewness 0 or so, bent to a gamma distribution of skewness s (E. B. Wilson and M. M. Hilferty, Proc.
/// Natl. Acad. Sci. USA 17, 684 (1931)); then each mode gets its own modulus back and keeps the phase that the bend
/// gave it.
std::vector<double> bent(const std::vector<double>& z, double s, const std::vector<double>& amplitude,
                         HeightMap::Shape shape) {
  std::vector<double> heights(z.size());
  const HeightMoments of_z = moments(z);
  for (std::size_t i = 0; i < z.size(); ++i) {
    heed_at(i);
    const double t = 1 + s / 6 * ((z[i] - of_z.mean(0)) / of_z.rms() - s / 6);
    heights[i] = (s < 0 ? -1 : 1) * std::pow(std::fmax(t, 0), 3);
  }
  Modes modes{shape, forward_transform(heights, {shape[0], shape[1]})};
  modes.fill([&](std::size_t ky, std::size_t kx, bool own) {
    const std::size_t at = ky * modes.half() + kx;
    if (own) return std::complex(std::copysign(amplitude[at], modes.values[at].real()));
    const double modulus = std::abs(modes.values[at]);
    return modulus > 0 ? modes.values[at] * (amplitude[at] / modulus) : std::complex(amplitude[at]);
  });
  return modes.heights();
}

/// Heights of the wanted skewness: by the strength of the bend, between two that miss it on either side.
std::vector<double> skewed(const std::vector<double>& z, double skewness, const std::vector<double>& amplitude,
                           HeightMap::Shape shape) {
  constexpr double tolerance = 1e-3, strongest = 8;
  std::vector<double> found;
  const auto miss = [&](double s) {
    found = bent(z, s, amplitude, shape);
    return skewness_of(found) - skewness;
  };
  double a = 0, at_a = skewness_of(z) - skewness, b = at_a < 0 ? 0.5 : -0.5, at_b = miss(b);
  while (at_a * at_b > 0 && std::fabs(b) < strongest) {
    a = b;
    at_a = at_b;
    at_b = miss(b *= 2);
  }
  double best = at_b;
  for (int i = 0; i < 40 && at_a * at_b <= 0 && std::fabs(best) > tolerance; ++i) {
    const double c = i % 3 == 2 ? (a + b) / 2 : a - at_a * (b - a) / (at_b - at_a);
    best = miss(c);
    (best * at_a > 0 ? a : b) = c;
    (best * at_a > 0 ? at_a : at_b) = best;
  }
  if (std::fabs(best) > tolerance)
    throw NotConverged(argument("skewness") + " = " + value(skewness) +
                       ": heights of this spectrum on this grid reached " + show(best + skewness, 3) +
                       "; fewer long waves than some 8 x 8 leave too little room");
  return found;
}

}  // namespace

// h(x) = sum over all modes of sqrt(C (2 pi)^2 / A) exp(i (q x + phase)), phases of q and -q opposite. Modes that
// are their own mirror image are real: their phase is 0 or pi.
HeightMap synthesize(const Spectrum& spectrum, HeightMap::Shape shape, HeightMap::PixelSize pixel_size,
                     std::uint64_t seed, double skewness) {
  const auto [ny, nx] = shape;
  if (ny < 2 || nx < 2)
    throw InvalidInput(argument("shape") + " = " + pair(static_cast<double>(ny), static_cast<double>(nx)) + must_be() +
                       "2 x 2 or more");
  require_positive("pixel_size", pixel_size[0]);
  require_positive("pixel_size", pixel_size[1]);
  if (!(std::fabs(skewness) <= 2)) refuse("skewness", skewness, "in [-2, 2]");
  if (rms_height(spectrum) == 0)
    throw InvalidInput(argument("spectrum") + ": its density is 0 everywhere" + must(", must be ") +
                       "positive somewhere");
  const std::vector<double> amplitude = amplitudes(spectrum, shape, pixel_size);
  Random random(seed);
  Modes modes{shape, std::vector<std::complex<double>>(amplitude.size())};
  modes.fill([&](std::size_t ky, std::size_t kx, bool own) {
    const double phase = 2 * pi * random(), a = amplitude[ky * modes.half() + kx];
    return own ? std::complex(phase < pi ? a : -a) : std::polar(a, phase);
  });
  std::vector<double> heights = modes.heights();
  if (skewness != 0) heights = skewed(heights, skewness, amplitude, shape);
  return {std::move(heights), shape, pixel_size};
}

}  // namespace asperity
