// The complex modulus of rubber, as a Prony series or a measured master curve, and its angular integrals.
#pragma once

#include <complex>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "asperity/errors.hpp"
#include "asperity/export.hpp"

namespace asperity {

/// I1 = int_0^2pi cos(phi) Im E(w cos phi) dphi and I2 = int_0^2pi |E(w cos phi)|^2 dphi, with the shares of
/// them that come from frequencies outside of the measured range.
struct AngularIntegrals {
  double i1;              // [Pa]
  double i2;              // [Pa^2]
  double i1_outside = 0;  // [Pa]
  double i2_outside = 0;  // [Pa^2]
};

/// Harmonics of the rubber on a circle of wavevectors, L_k = int_0^2pi cos((2 k + 1) phi) Im E(w cos phi) dphi and
/// K_k = int_0^2pi cos(2 k phi) |E(w cos phi)|^2 dphi. Rows of k, an entry a frequency in each; L_0 = I1, K_0 = I2.
/// With them int cos(phi) cos(2 m phi) Im E dphi = (L_m-1 + L_m) / 2 and int sin(phi) sin(2 m phi) Im E dphi =
/// (L_m-1 - L_m) / 2.
struct AngularHarmonics {
  std::vector<double> loss;    // L_k [Pa]
  std::vector<double> square;  // K_k [Pa^2]
};

/// Angular frequencies from the lowest to the highest [rad/s].
struct FrequencyRange {
  double lowest, highest;
  bool operator==(const FrequencyRange&) const = default;
};

/// E(w) = E_inf + sum_k E_k i w tau_k / (1 + i w tau_k). Without terms: elastic. A series that was fitted knows on
/// which frequencies: OutOfRange beyond them, unless it was asked to go on by name; the parts from beyond are told
/// then.
class ASPERITY_EXPORT PronySeries {
 public:
  PronySeries(double equilibrium_modulus, std::vector<double> moduli, std::vector<double> relaxation_times);
  [[nodiscard]] double equilibrium_modulus() const { return equilibrium_; }
  [[nodiscard]] const std::vector<double>& moduli() const { return moduli_; }
  [[nodiscard]] const std::vector<double>& relaxation_times() const { return times_; }
  /// w_k = 2 E_k (E_inf + sum_l E_l tau_l / (tau_k + tau_l)) [Pa^2] of I2 = 2 pi (E_inf^2 + sum_k w_k s_k).
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }
  /// At angular frequency w [rad/s], 0 or more.
  [[nodiscard]] std::complex<double> modulus(double w) const;
  [[nodiscard]] AngularIntegrals angular_integrals(double w) const;
  /// At each of `w`, in one pass over the terms for all of them; `i1` and `i2` have as many entries, `i1_outside` too
  /// or none. True where more than 1e-7 of an I1 comes from outside of the fitted frequencies; `i1_outside` may not
  /// have been written otherwise.
  [[nodiscard]] bool angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                       std::span<double> i1_outside = {}) const;
  /// The same with L_1 and K_1 and so on into rows of w.size(), as many as `loss` and `square` have room for.
  [[nodiscard]] bool angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                       std::span<double> i1_outside, std::span<double> loss,
                                       std::span<double> square) const;
  /// The same rubber at a temperature of shift factor a_T: E(w) becomes E(a_T w), known where a_T w is.
  [[nodiscard]] PronySeries shifted(double a_T) const;
  /// The same series as one that was fitted on these frequencies; `extrapolated`: it may be asked beyond them.
  [[nodiscard]] PronySeries fitted_on(const FrequencyRange& frequencies, bool extrapolated = false) const;
  /// Frequencies that it was fitted on; none for a series given by hand, which holds at any.
  [[nodiscard]] std::optional<FrequencyRange> fitted_range() const;
  [[nodiscard]] bool extrapolated() const { return fit_ && fit_->extrapolated; }
  bool operator==(const PronySeries&) const = default;

 private:
  struct Fit {
    FrequencyRange range;
    bool extrapolated;
    double loss_below;  // no E'' is larger below the range [Pa]
    bool operator==(const Fit&) const = default;
  };
  void check_frequency(double w) const;
  void check_fitted(double w) const;
  [[nodiscard]] AngularIntegrals outside(double w, const AngularIntegrals& whole) const;
  bool outside(std::span<const double> w, std::span<const double> i1, std::span<const double> i2,
               std::span<double> i1_outside) const;

  double equilibrium_;
  std::vector<double> moduli_, times_;
  std::vector<double> weights_;
  double longest_;  // relaxation time, 0 where there is none
  std::optional<Fit> fit_;
};

enum class Extrapolation { power_law, clamp };

class ShiftTable;  // asperity/dma.hpp

/// A measured modulus: Steffen's monotone interpolant of ln E' and ln E'' in ln w. Outside the table nothing
/// is known: OutOfRange, unless an extrapolation over at most one decade at either end is asked for by name.
class ASPERITY_EXPORT MasterCurve {
 public:
  MasterCurve(std::vector<double> angular_frequency, std::vector<double> storage_modulus,
              std::vector<double> loss_modulus, std::optional<Extrapolation> extrapolation = std::nullopt);
  [[nodiscard]] const std::vector<double>& angular_frequency() const;
  [[nodiscard]] const std::vector<double>& storage_modulus() const;
  [[nodiscard]] const std::vector<double>& loss_modulus() const;
  [[nodiscard]] std::optional<Extrapolation> extrapolation() const;
  [[nodiscard]] std::complex<double> modulus(double angular_frequency) const;
  /// cos(phi) always runs through zero: below the lowest frequency E' is taken constant and E'' as
  /// proportional to w, and what comes from there is returned as the part outside.
  [[nodiscard]] AngularIntegrals angular_integrals(double angular_frequency) const;
  /// At each of `w`, into spans of as many entries (`i1_outside` may be empty); true where more than 1e-7 of an I1
  /// comes from outside.
  [[nodiscard]] bool angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                       std::span<double> i1_outside = {}) const;
  /// The same with L_1 and K_1 and so on, to 1e-9 of I1 and I2, into rows of w.size(), as many as `loss` and `square`
  /// have room for.
  [[nodiscard]] bool angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                       std::span<double> i1_outside, std::span<double> loss,
                                       std::span<double> square) const;
  /// int (Im E(w cos phi))^2 cos(2 m phi) dphi, what E'' has of K_m [Pa^2], in rows of m = 0, 1 ... as many as fit.
  void loss_part(std::span<const double> w, std::span<double> part) const;
  [[nodiscard]] MasterCurve shifted(double a_T) const;
  /// Lowest and highest angular frequency at which angular integrals can be had [rad/s].
  [[nodiscard]] double lowest_frequency() const;
  [[nodiscard]] double highest_frequency() const;
  /// Shift factors of the measurement that the curve came from, where it knows them.
  [[nodiscard]] const std::shared_ptr<const ShiftTable>& shifts() const { return shifts_; }
  [[nodiscard]] MasterCurve with_shifts(std::shared_ptr<const ShiftTable> shifts) const;
  /// Where the interpolant changes its formula [rad/s], in rising order.
  [[nodiscard]] std::span<const double> knots() const;

 private:
  struct Table;
  std::shared_ptr<const Table> table_;
  std::shared_ptr<const ShiftTable> shifts_;
};

using Rubber = std::variant<PronySeries, MasterCurve>;

/// Where its modulus can be had; nothing for a rubber that has it at any frequency.
ASPERITY_EXPORT std::optional<FrequencyRange> known_range(const Rubber& rubber);

ASPERITY_EXPORT std::complex<double> modulus(const Rubber& rubber, double angular_frequency);
ASPERITY_EXPORT AngularIntegrals angular_integrals(const Rubber& rubber, double angular_frequency);

/// At each of `angular_frequency`, into spans of as many entries, harmonics into rows of as many. False where no more
/// than 1e-7 of any I1 comes from outside of the measured range; `i1_outside` may not have been written then.
ASPERITY_EXPORT bool angular_integrals(const Rubber& rubber, std::span<const double> angular_frequency,
                                       std::span<double> i1, std::span<double> i2, std::span<double> i1_outside,
                                       std::span<double> loss = {}, std::span<double> square = {});

/// Rows of k from 0 to `count`.
ASPERITY_EXPORT AngularHarmonics angular_harmonics(const Rubber& rubber, std::span<const double> angular_frequency,
                                                   std::size_t count);

/// 1 / E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2 (Eq. 15) [Pa].
ASPERITY_EXPORT double effective_modulus(double modulus, double poisson_ratio,
                                         double modulus_2 = std::numeric_limits<double>::infinity(),
                                         double poisson_ratio_2 = 0);

}  // namespace asperity
