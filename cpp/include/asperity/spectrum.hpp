// Roughness spectra C(q): self-affine, tabulated, measured from a map; moments, cut-offs, fit, synthesis.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "asperity/export.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// C(q) = C_r (q / q_r)^(-2 (H + 1)) on [q_r, q1], flat C_r on [q0, q_r], zero elsewhere; q_r is the roll-off,
/// or q0 where there is none. C_r follows from rms_height^2 = 2 pi int_q0^q1 q C dq.
struct ASPERITY_EXPORT SelfAffineSpectrum {
  double rms_height;                             // h_rms on the band [m]
  double hurst;                                  // H [-], 0 < H <= 1
  double q0, q1;                                 // lower and upper cut-off [1/m]
  std::optional<double> rolloff = std::nullopt;  // q_r [1/m]
  bool operator==(const SelfAffineSpectrum&) const = default;

  /// The article's Eq. 12 as printed, C = (h0 / q0)^2 (H / 2 pi) (q / q0)^(-2 (H + 1)), cut at q1: its rms
  /// height is h0 / sqrt 2 for q1 >> q0.
  static SelfAffineSpectrum from_article(double h0, double hurst, double q0, double q1);
};

/// Densities at given wavenumbers, log-log linear between rows (linear in q beside a zero).
class ASPERITY_EXPORT TabulatedSpectrum {
 public:
  /// `count` (optional): modes averaged in each row, the weights of a fit.
  TabulatedSpectrum(std::vector<double> wavenumber, std::vector<double> density, std::vector<double> count = {});
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  [[nodiscard]] const std::vector<double>& density() const { return density_; }
  [[nodiscard]] const std::vector<double>& count() const { return count_; }
  bool operator==(const TabulatedSpectrum&) const = default;

 private:
  std::vector<double> wavenumber_, density_, count_;
};

using Spectrum = std::variant<SelfAffineSpectrum, TabulatedSpectrum>;

ASPERITY_EXPORT void validate(const SelfAffineSpectrum& spectrum);
ASPERITY_EXPORT void validate(const Spectrum& spectrum);

/// C(q) [m^4]. A self-affine spectrum is zero outside its band, a table throws OutOfRange.
ASPERITY_EXPORT double density(const Spectrum& spectrum, double wavenumber);
ASPERITY_EXPORT std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber);

/// Lower and upper end [1/m].
ASPERITY_EXPORT std::array<double, 2> band(const Spectrum& spectrum);
/// sqrt(2 pi int q C dq) [m].
ASPERITY_EXPORT double rms_height(const Spectrum& spectrum);
/// sqrt(2 pi int q^3 C dq) [-].
ASPERITY_EXPORT double rms_slope(const Spectrum& spectrum);
/// The wavenumber up to which the rms slope is `slope`; q1 where the whole spectrum has less.
ASPERITY_EXPORT double cutoff_for_slope(const Spectrum& spectrum, double slope = 1.3);
/// 2 pi / `size` of the contamination particles [m]; q1 where that lies beyond.
ASPERITY_EXPORT double cutoff_for_contamination(const Spectrum& spectrum, double size);
/// The same densities on a narrower band.
ASPERITY_EXPORT Spectrum truncated(const Spectrum& spectrum, std::optional<double> q0, std::optional<double> q1);
/// All densities times `factor`.
ASPERITY_EXPORT Spectrum scaled(const Spectrum& spectrum, double factor);
/// <h(x) h(0)> = 2 pi int q C(q) J0(q |x|) dq [m^2], the inverse of Eq. 6, at each distance [m].
ASPERITY_EXPORT std::vector<double> autocorrelation(const Spectrum& spectrum, std::span<const double> distance);

enum class Window { split_cosine_bell, hann, none };

/// The radial spectrum of a map (Eqs 25-27): detrended, windowed, transformed, averaged over rings of width
/// dq = 2 pi / longest side. The window's mean square is divided out. Drop-outs must have been filled.
ASPERITY_EXPORT TabulatedSpectrum power_spectrum(const HeightMap& map, Window window = Window::split_cosine_bell,
                                                 std::optional<Detrend> detrend = Detrend::plane, unsigned threads = 1);

/// A power law through a spectrum, with standard errors of rms_height, hurst.
struct SelfAffineFit {
  SelfAffineSpectrum spectrum;
  double rms_height_error;  // [m]
  double hurst_error;       // [-]
  std::size_t rows;         // rows used
};
/// Least squares in ln C against ln q over [q_min, q_max], each row weighted by its count where it has one.
ASPERITY_EXPORT SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, std::optional<double> q_min,
                                              std::optional<double> q_max);

/// A periodic map with |h(q)|^2 exactly that of the spectrum at every mode the grid holds, phases random.
ASPERITY_EXPORT HeightMap synthesize(const Spectrum& spectrum, HeightMap::Shape shape, HeightMap::PixelSize pixel_size,
                                     std::uint64_t seed);

}  // namespace asperity
