// From dynamic mechanical analysis to a modulus at any frequency: isotherms, shift factors, Prony fit, large strain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "asperity/export.hpp"
#include "asperity/rubber.hpp"
#include "asperity/strain_factors.hpp"

namespace asperity {

/// A frequency sweep at one temperature, small strain. Frequencies rise; points within 1 % of each other were averaged
/// in the logarithm, which `notes` says.
class ASPERITY_EXPORT Isotherm {
 public:
  /// temperature [K], angular frequency [rad/s] in any order, storage and loss modulus [Pa].
  Isotherm(double temperature, const std::vector<double>& angular_frequency, const std::vector<double>& storage_modulus,
           const std::vector<double>& loss_modulus);
  /// Rows of an isotherm as they are, its notes with them: frequencies that rise, none averaged again.
  Isotherm(double temperature, std::vector<double> angular_frequency, std::vector<double> storage_modulus,
           std::vector<double> loss_modulus, std::vector<Diagnostic> notes);
  [[nodiscard]] double temperature() const { return temperature_; }
  [[nodiscard]] const std::vector<double>& angular_frequency() const { return frequency_; }
  [[nodiscard]] const std::vector<double>& storage_modulus() const { return storage_; }
  [[nodiscard]] const std::vector<double>& loss_modulus() const { return loss_; }
  [[nodiscard]] const std::vector<Diagnostic>& notes() const { return notes_; }

 private:
  double temperature_;
  std::vector<double> frequency_, storage_, loss_;
  std::vector<Diagnostic> notes_;
};

/// log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref), with standard errors.
struct WlfFit {
  double c1, c2;              // [-], [K]
  double reference;           // T_ref [K]
  double c1_error, c2_error;  // [-], [K]
  double residual;            // rms of log10 a_T about the fit [-]
};

inline constexpr double gas_constant = 8.31446261815324;  // R [J/(mol K)], CODATA 2018, exact

/// ln a_T = (E_a / R) (1 / T - 1 / T_ref), with its standard error.
struct ArrheniusFit {
  double activation_energy;        // E_a [J/mol]
  double reference;                // T_ref [K]
  double activation_energy_error;  // [J/mol]
  double residual;                 // rms of log10 a_T about the fit [-]
};

/// log10 a_T and its slope over temperature.
struct ShiftValue {
  double log10_a_T;  // [-]
  double slope;      // d log10 a_T / dT [1/K]
};

/// log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref), by constants that are known.
struct WLF {
  double c1, c2;     // [-], [K]
  double reference;  // T_ref [K]
  bool operator==(const WLF&) const = default;
};

ASPERITY_EXPORT void validate(const WLF& law);

/// Shift factors over temperature, measured or read from outside.
class ASPERITY_EXPORT ShiftTable {
 public:
  /// Temperatures [K] rising; `standard_deviation` of log10 a_T (optional).
  ShiftTable(double reference, std::vector<double> temperature, std::vector<double> log10_a_T,
             std::vector<double> standard_deviation = {});
  [[nodiscard]] double reference() const { return reference_; }
  [[nodiscard]] const std::vector<double>& temperature() const { return temperature_; }
  [[nodiscard]] const std::vector<double>& log10_a_T() const { return log10_a_T_; }
  [[nodiscard]] const std::vector<double>& standard_deviation() const { return deviation_; }
  /// a_T at a temperature [K]: Steffen's interpolant of log10 a_T; OutOfRange outside of the table.
  [[nodiscard]] double shift_factor(double temperature) const;
  /// log10 a_T of the same and its slope.
  [[nodiscard]] ShiftValue shift_at(double temperature) const;
  /// Least squares. Standard errors: from the covariance of log10 a_T (n rows of n, as of a build) where it is given,
  /// times the scatter over that which it explains where there is more; without it from the scatter about the law. A
  /// row at the reference is no data: any law goes through it.
  [[nodiscard]] WlfFit fit_wlf(std::span<const double> covariance = {}) const;
  [[nodiscard]] ArrheniusFit fit_arrhenius(std::span<const double> covariance = {}) const;

 private:
  double reference_;
  std::vector<double> temperature_, log10_a_T_, deviation_, slope_;
};

/// How a rubber's relaxation times follow its temperature.
using TemperatureShift = std::variant<WLF, WlfFit, ArrheniusFit, ShiftTable>;

/// log10 a_T at a temperature [K], at least 150. OutOfRange where the shift is not known.
ASPERITY_EXPORT ShiftValue shift_at(const TemperatureShift& shift, double temperature);

/// The rubber, which is given at the shift's reference, at a temperature [K].
ASPERITY_EXPORT Rubber shifted(const Rubber& rubber, const TemperatureShift& shift, double temperature);

/// InvalidInput for a temperature [K] that no rubber is used at.
ASPERITY_EXPORT void require_temperature(double temperature);

enum class VerticalShift { none, temperature_ratio, table };

struct MasterCurveOptions {
  double reference_temperature;                          // [K]
  VerticalShift vertical_shift = VerticalShift::none;    // b_T = 1; T_ref / T; or as given
  std::vector<double> b_T = {};                          // an entry an isotherm in rising temperature, for `table`
  std::optional<ShiftTable> shift_table = std::nullopt;  // a_T from outside instead of a fit
  bool smooth = true;                                    // the master spline instead of the merged points
  std::optional<Extrapolation> extrapolation = std::nullopt;
};

/// A measured point on the master curve.
struct MasterPoint {
  double angular_frequency;              // reduced, a_T w [rad/s]
  double storage_modulus, loss_modulus;  // reduced, E / b_T [Pa]
  std::size_t isotherm;                  // of origin: index in rising temperature
};

/// A shift with a larger standard deviation [decades] is one that the data do not fix.
inline constexpr double undetermined_shift = 0.3;

struct MasterCurveBuild {
  MasterCurve master_curve;
  ShiftTable shifts;
  std::vector<double> b_T;
  std::vector<MasterPoint> points;  // in rising frequency
  double residual;                  // rms of ln E', ln E'' about the master spline
  std::vector<double> covariance;   // of log10 a_T, n rows of n: zero at the isotherm nearest to T_ref
  std::vector<Diagnostic> notes;
};

/// Horizontal shifts on E' and E'' together: neighbours in pairs for a start, then all at once about one master spline,
/// by their restricted likelihood. A shift whose standard deviation exceeds 0.3 decades is one that the data do not
/// fix; a note says so.
ASPERITY_EXPORT MasterCurveBuild build_master_curve(std::span<const Isotherm> isotherms,
                                                    const MasterCurveOptions& options);

/// A build as its errors would have it: log10 a_T drawn from its covariance, the points moved, and the spline through
/// them with coefficients drawn from their own; smooth, extrapolated by power laws. The same for the same seed.
ASPERITY_EXPORT MasterCurveBuild draw_master_curve(const MasterCurveBuild& build, std::uint64_t seed);

/// What independent unit normals behind `draw_master_curve` change, to first order, a row each: ln E' and ln E'' at
/// given frequencies, and log10 a_T of the isotherms. The sum of squares of what they do to a number is its variance.
struct MasterCurveModes {
  std::size_t count = 0;
  std::vector<double> storage, loss, log10_a_T;
};
ASPERITY_EXPORT MasterCurveModes master_curve_modes(const MasterCurveBuild& build,
                                                    std::span<const double> angular_frequency);

struct PronyFitOptions {
  std::optional<double> modes_per_decade = std::nullopt;  // default: the fewest modes that reach the noise
  std::optional<double> residual = std::nullopt;          // ... or that reach this relative rms residual
  bool extrapolated = false;                              // whether the series may be asked beyond the rows
};

/// A Prony series through a measured modulus, known on the measured frequencies.
struct PronyFit {
  PronySeries series;
  double storage_residual, loss_residual;  // relative rms of E' and E'' [-]
  /// Prony series are causal: what no series can follow, noise apart, violates the Kramers-Kronig relations.
  bool causal;
  std::vector<Diagnostic> notes;
};
/// Non-negative least squares with relative weights over relaxation times from one decade below to one above those of
/// the measured range. The series is known on the frequencies of the rows, and OutOfRange beyond unless `extrapolated`.
ASPERITY_EXPORT PronyFit fit_prony(std::span<const double> angular_frequency, std::span<const double> storage_modulus,
                                   std::span<const double> loss_modulus, const PronyFitOptions& options = {});

/// A strain sweep at one temperature and one frequency.
class ASPERITY_EXPORT StrainSweep {
 public:
  /// temperature [K], angular frequency [rad/s], strain amplitude [-] rising, moduli [Pa].
  StrainSweep(double temperature, double angular_frequency, std::vector<double> strain,
              std::vector<double> storage_modulus, std::vector<double> loss_modulus);
  [[nodiscard]] double temperature() const { return temperature_; }
  [[nodiscard]] double angular_frequency() const { return frequency_; }
  [[nodiscard]] const std::vector<double>& strain() const { return strain_; }
  [[nodiscard]] const std::vector<double>& storage_modulus() const { return storage_; }
  [[nodiscard]] const std::vector<double>& loss_modulus() const { return loss_; }

 private:
  double temperature_, frequency_;
  std::vector<double> strain_, storage_, loss_;
};

struct LargeStrain {
  MasterCurve master_curve;
  std::vector<Diagnostic> notes;
};
/// The master curve at a large strain: E' and E'' times their own ratios to 0.5 % strain, each sweep placed at
/// a_T(T) w, interpolated in ln w, held beyond the first and the last sweep.
ASPERITY_EXPORT LargeStrain at_strain(const MasterCurve& small_strain, const ShiftTable& shifts, double strain,
                                      std::span<const StrainSweep> sweeps);

/// Factors over strain by sweeps, with the standard deviations of ln f and ln g among sweeps at each row, 0 of one.
struct StrainRatios {
  StrainFactors factors;
  std::vector<double> storage_error, loss_error;
  std::vector<Diagnostic> notes;
};
/// E' and E'' over those at `reference_strain` [-], the strain of the master curve: by default the lowest that all
/// sweeps have, and at and below it 1. Of several sweeps, whatever their temperatures and frequencies, ln f and ln g
/// rise by the mean of those that reach so far; between rows ln E is linear in ln strain.
ASPERITY_EXPORT StrainRatios strain_factors(std::span<const StrainSweep> sweeps,
                                            std::optional<double> reference_strain = std::nullopt,
                                            double strain_per_slope = 0.5);

}  // namespace asperity
