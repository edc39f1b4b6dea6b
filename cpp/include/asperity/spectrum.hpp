// Roughness spectra C(q): self-affine, tabulated, measured from a map; moments, cut-offs, fit, synthesis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "asperity/export.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// C(q) = C_r (q / q_r)^(-2 (H + 1)) on [q_r, q1], flat C_r on [q0, q_r], zero elsewhere; q_r is the roll-off,
/// or q0 where there is none. C_r follows from rms_height^2 = 2 pi int_q0^q1 q C dq.
/// With an axis ratio r other than 1 the same law is one of k = |q| sqrt(r cos^2(phi - lay) + sin^2(phi - lay) / r),
/// phi the direction of q from x towards y, flat for k below q_r; the band is in |q|, and C(q) the mean over
/// directions.
struct ASPERITY_EXPORT SelfAffineSpectrum {
  double rms_height;                             // h_rms on the band [m]
  double hurst;                                  // H [-], 0 < H <= 1
  double q0, q1;                                 // lower and upper cut-off [1/m]
  std::optional<double> rolloff = std::nullopt;  // q_r [1/m]
  double axis_ratio = 1;                         // r [-], 1 to 10
  double lay = 0;                                // direction of the ridges [rad]
  bool operator==(const SelfAffineSpectrum&) const = default;

  /// The article's Eq. 12 as printed, C = (h0 / q0)^2 (H / 2 pi) (q / q0)^(-2 (H + 1)), cut at q1: its rms
  /// height is h0 / sqrt 2 for q1 >> q0.
  static SelfAffineSpectrum from_article(double h0, double hurst, double q0, double q1);
};

/// Why a row of a measured spectrum is not to be trusted: bits of RowQuality::flag.
enum RowFlag : std::uint8_t {
  few_periods = 1,   // fewer than 16 (split cosine bell), 12 (Blackman) or 10 (Hann) periods on the scan
  near_nyquist = 2,  // beyond half of pi / pixel: what lies beyond pi / pixel is folded back, 5 % at H = 0.8
  few_modes = 4      // so few that their mean is uncertain by more than a quarter
};

/// What the heights are that a spectrum was measured on, which the spectrum does not tell.
struct HeightShape {
  double skewness, kurtosis;  // about the trend [-], 0 and 3 for Gaussian heights
  // Kurtosis of second differences over two pixels, the larger one of both axes: 3 where short waves are spread evenly
  // and above where they are gathered in places.
  std::optional<double> curvature_kurtosis = {};
  std::optional<double> slope_ratio = {};  // rms slope across the lay over that along it, of reliable waves
  bool operator==(const HeightShape&) const = default;
};

/// The quality of each row of a measured spectrum; a vector is empty or has an entry a row.
struct RowQuality {
  std::vector<double> count;           // modes averaged: the weights of a fit
  std::vector<double> standard_error;  // of the density, in its unit
  std::vector<std::uint8_t> flag;      // RowFlag bits, 0: reliable
  // Of the errors of a row and of those after it, as many entries a row as rows that a window ties together: the first
  // is that with the next row. Pairs further apart are independent; entries beyond the last row are not read.
  std::vector<double> correlation = {};
  std::optional<HeightShape> heights = {};  // of the whole map, where they are known
  /// How many rows after a row its correlations reach.
  [[nodiscard]] ASPERITY_EXPORT std::size_t lags() const;
  /// Of the errors of row i and of row j >= i.
  [[nodiscard]] ASPERITY_EXPORT double correlation_of(std::size_t i, std::size_t j) const;
  bool operator==(const RowQuality&) const = default;
};

/// C(q, phi) = C(q) (1 + 2 sum_m [a_m cos 2 m phi + b_m sin 2 m phi]), m = 1 to `count`, phi the direction of q from x
/// towards y; between rows a_m and b_m are linear in ln q.
struct RingHarmonics {
  std::size_t count = 0;
  std::vector<double> cosine, sine;         // a_m and b_m, `count` a row
  std::vector<double> standard_error = {};  // of each of them; empty where unknown
  bool operator==(const RingHarmonics&) const = default;
};

class TableSurface;  // internal

/// Densities at given wavenumbers, log-log linear between rows (linear in q beside a zero). The band, on which moments
/// and contact are taken, ends at q1 [1/m], by default the last row; `truncated` up to the last row takes more.
class ASPERITY_EXPORT TabulatedSpectrum {
 public:
  TabulatedSpectrum(std::vector<double> wavenumber, std::vector<double> density, RowQuality quality = {},
                    RingHarmonics harmonics = {}, std::optional<double> q1 = std::nullopt);
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  [[nodiscard]] double q1() const { return q1_; }
  [[nodiscard]] const std::vector<double>& density() const { return density_; }
  [[nodiscard]] const RowQuality& quality() const { return quality_; }
  /// None, of count 0, where the spectrum is a mean over directions.
  [[nodiscard]] const RingHarmonics& harmonics() const { return harmonics_; }
  /// Results that depend on the rows alone, computed once: copies and threads share them.
  [[nodiscard]] TableSurface& surface() const { return *surface_; }
  bool operator==(const TabulatedSpectrum& other) const;

 private:
  std::vector<double> wavenumber_, density_;
  RowQuality quality_;
  RingHarmonics harmonics_;
  double q1_;
  std::shared_ptr<TableSurface> surface_;
};

using Spectrum = std::variant<SelfAffineSpectrum, TabulatedSpectrum>;

ASPERITY_EXPORT void validate(const SelfAffineSpectrum& spectrum);
ASPERITY_EXPORT void validate(const Spectrum& spectrum);

/// C(q) [m^4]. A self-affine spectrum is zero outside its band, a table throws OutOfRange.
ASPERITY_EXPORT double density(const Spectrum& spectrum, double wavenumber);
ASPERITY_EXPORT std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber);

/// Whether it knows directions: harmonics, or an axis ratio other than 1.
ASPERITY_EXPORT bool is_directional(const Spectrum& spectrum);
/// C of vectors q [m^4]: at |q| [1/m] and the direction of q from x towards y [rad], as many of both.
ASPERITY_EXPORT std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber,
                                            std::span<const double> direction);
/// A self-affine spectrum as rows with harmonics, to 1e-7 of C, or the table itself. Those left out have at most 1e-9.
ASPERITY_EXPORT TabulatedSpectrum directional_table(const Spectrum& spectrum);

/// Lower and upper end [1/m].
ASPERITY_EXPORT std::array<double, 2> band(const Spectrum& spectrum);
/// sqrt(2 pi int q C dq) [m].
ASPERITY_EXPORT double rms_height(const Spectrum& spectrum);
/// sqrt(2 pi int q^3 C dq) [-].
ASPERITY_EXPORT double rms_slope(const Spectrum& spectrum);
/// Nayak's parameter m0 m4 / m2^2 of the band [-]: 1.5 for a single wavenumber, the larger the wider the band.
ASPERITY_EXPORT double nayak_parameter(const Spectrum& spectrum);
/// The wavenumber up to which the rms slope is `slope`; q1 where the whole spectrum has less.
ASPERITY_EXPORT double cutoff_for_slope(const Spectrum& spectrum, double slope = 1.3);
/// 2 pi / `size` of the contamination particles [m]; q1 where that lies beyond.
ASPERITY_EXPORT double cutoff_for_contamination(const Spectrum& spectrum, double size);
/// The same densities on a narrower band.
ASPERITY_EXPORT Spectrum truncated(const Spectrum& spectrum, std::optional<double> q0, std::optional<double> q1);
/// The same law on another band: the power law goes on beyond the old ends, or the flat part below a roll-off.
ASPERITY_EXPORT SelfAffineSpectrum extended(const SelfAffineSpectrum& spectrum, std::optional<double> q0,
                                            std::optional<double> q1);
/// All densities times `factor`.
ASPERITY_EXPORT Spectrum scaled(const Spectrum& spectrum, double factor);
/// <h(x) h(0)> = 2 pi int q C(q) J0(q |x|) dq [m^2], the inverse of Eq. 6, at each distance [m].
ASPERITY_EXPORT std::vector<double> autocorrelation(const Spectrum& spectrum, std::span<const double> distance);

/// C1D(q) = int C(sqrt(q^2 + k^2)) dk over all k [m^3]: the two-sided spectrum of a line across the surface, whose
/// integral over positive and negative q is h_rms^2.
ASPERITY_EXPORT std::vector<double> line_density(const Spectrum& spectrum, std::span<const double> wavenumber);

enum class Window { split_cosine_bell, hann, none, blackman };
/// Which heights count: those above the mean plane alone make the top spectrum, those below it the bottom one.
enum class Part { all, top, bottom };

/// The radial spectrum of a map (Eqs 25-27): detrended, windowed, transformed, averaged over rings of width
/// dq = 2 pi / longest side, to the corner of the plane; the band ends at pi / coarser pixel, beyond which rings are
/// incomplete. The window's mean square is divided out. Drop-outs must have been filled.
ASPERITY_EXPORT TabulatedSpectrum power_spectrum(const HeightMap& map, Window window = Window::split_cosine_bell,
                                                 std::optional<Detrend> detrend = Detrend::plane, unsigned threads = 1,
                                                 Part part = Part::all);
/// The same with the harmonics of each ring, as many as the scan supports: up to the last that differs from 0 by more
/// than four standard errors in the mean over reliable rings, 16 at most.
ASPERITY_EXPORT TabulatedSpectrum directional_spectrum(const HeightMap& map, Window window = Window::split_cosine_bell,
                                                       std::optional<Detrend> detrend = Detrend::plane,
                                                       unsigned threads = 1);

/// C over the whole plane of wavevectors, both rising: wavenumber_y (ny), wavenumber_x (nx) [1/m], density
/// row by row [m^4].
struct SpectralDensity {
  std::vector<double> wavenumber_y, wavenumber_x, density;
};
ASPERITY_EXPORT SpectralDensity spectral_density(const HeightMap& map, Window window = Window::split_cosine_bell,
                                                 std::optional<Detrend> detrend = Detrend::plane);

/// Principal axes of the mean square slopes <dh/dx_i dh/dx_j> of a band (M. S. Longuet-Higgins, Phil. Trans. R. Soc.
/// Lond. A 249, 321 (1957)).
struct Anisotropy {
  double across, along;  // rms slopes [-], across >= along
  double direction;      // of the lay, along which the slope is least: angle from x towards y in (-pi/2, pi/2] [rad]
};
/// Over wavenumbers in [q_min, q_max]; by default those whose rows are reliable in `power_spectrum`.
ASPERITY_EXPORT Anisotropy anisotropy(const HeightMap& map, Window window = Window::split_cosine_bell,
                                      std::optional<Detrend> detrend = Detrend::plane,
                                      std::optional<double> q_min = std::nullopt,
                                      std::optional<double> q_max = std::nullopt);

/// The two-sided spectrum C1D of profiles [m^3] at positive wavenumbers.
class ASPERITY_EXPORT LineSpectrum {
 public:
  LineSpectrum(std::vector<double> wavenumber, std::vector<double> density, RowQuality quality = {});
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  [[nodiscard]] const std::vector<double>& density() const { return density_; }
  [[nodiscard]] const RowQuality& quality() const { return quality_; }
  bool operator==(const LineSpectrum&) const = default;

 private:
  std::vector<double> wavenumber_, density_;
  RowQuality quality_;
};
ASPERITY_EXPORT LineSpectrum line_spectrum(const LineScan& scan, Window window = Window::split_cosine_bell,
                                           std::optional<Detrend> detrend = Detrend::plane, Part part = Part::all);
/// Averaged over the rows of a map, each detrended and windowed as a scan of its own, its parts about its own mean.
ASPERITY_EXPORT LineSpectrum line_spectrum(const HeightMap& map, Window window = Window::split_cosine_bell,
                                           std::optional<Detrend> detrend = Detrend::plane, Part part = Part::all);
/// C of the isotropic surface whose profiles have this spectrum, C(q) = -(1 / pi) int_q dC1D/dk dk / sqrt(k^2 - q^2),
/// exact for the power laws between the rows; beyond the last one the slope of the last factor of 2 goes on.
ASPERITY_EXPORT TabulatedSpectrum isotropic(const LineSpectrum& spectrum);

/// Count-weighted means over bins of equal width in ln q, `per_decade` of them in a factor 10 from the lowest row on.
ASPERITY_EXPORT TabulatedSpectrum log_binned(const TabulatedSpectrum& spectrum, double per_decade);
ASPERITY_EXPORT LineSpectrum log_binned(const LineSpectrum& spectrum, double per_decade);
/// One spectrum of several scans: row by row where all have the same wavenumbers, else their reliable rows together
/// in logarithmic bins.
ASPERITY_EXPORT TabulatedSpectrum merge_spectra(std::span<const TabulatedSpectrum> spectra,
                                                std::optional<double> per_decade = std::nullopt);

enum class FitMethod { least_squares, slope };
enum class Rolloff { find, require, none };
struct FitOptions {
  std::optional<double> q_min = std::nullopt, q_max = std::nullopt;  // rows used [1/m]; default: the reliable ones
  FitMethod method = FitMethod::least_squares;  // slope: Eq. 28, a straight line without weights and roll-off
  Rolloff rolloff = Rolloff::find;
};
/// A self-affine spectrum through a measured one, with standard errors from the scatter of the rows about it, their
/// correlation, and what a roll-off would change that is neither sure nor excluded.
struct SelfAffineFit {
  SelfAffineSpectrum spectrum;
  // of rms height [m], Hurst exponent [-] and roll-off [1/m], zeros where there is no roll-off
  std::array<std::array<double, 3>, 3> covariance;
  double residual;   // weighted rms of ln(C / fit)
  std::size_t rows;  // rows used, with those below the reliable ones where they are flat
};
ASPERITY_EXPORT SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, const FitOptions& options = {});

/// A periodic map with |h(q)|^2 exactly that of the spectrum at every mode the grid holds. Phases are random, or,
/// for a `skewness` other than 0, such that the heights have it, to 1e-3.
ASPERITY_EXPORT HeightMap synthesize(const Spectrum& spectrum, HeightMap::Shape shape, HeightMap::PixelSize pixel_size,
                                     std::uint64_t seed, double skewness = 0);

}  // namespace asperity
