// The measured range of corrections, and the notes of a result on the limits of the theory and of its input.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/correction.hpp"
#include "asperity/strain_factors.hpp"
#include "contact/model_error.hpp"
#include "contact/theory/s_factor.hpp"

namespace asperity {

/// The range of the boundary-element contacts that corrections were measured on: Nayak's parameter, and the load
/// p* = sigma0 / (E* h').
inline constexpr double lowest_measured_nayak = 1.75, highest_measured_nayak = 201, lowest_measured_load = 0.005;

/// Whether a correction leaves the range of those contacts at one pressure and velocity.
struct ValidityFlags {
  bool light = false;  // the load is below theirs
  // an affine shift takes the area further from the truth, as NayakSFactor knows it, than none would
  bool worse = false;
  std::optional<SpeedRegime> regime;  // of PartialContact, where exact contacts are known
  double strained = 0;                // share of mu_H from strains beyond the last row of factors
};

/// The flags at one wavenumber.
class ValidityRange {
 public:
  ValidityRange(std::span<const Segment> surface, Form form, double wavenumber);
  /// `g` as the affine shift `p` made it.
  [[nodiscard]] ValidityFlags operator()(double g, double p);

 private:
  std::span<const Segment> surface_;
  Form form_;
  double wavenumber_;
  std::optional<SInside> best_;
};

class Notes {
 public:
  Notes(const Spectrum& spectrum, const Rubber& rubber, const Correction& correction);
  void add(const Shift& shift, double velocity, const ValidityFlags& flags);
  /// What others found on other points of the same scene.
  void add(const Notes& others);
  /// The largest share of mu_H from strains beyond the last row of factors.
  [[nodiscard]] double strained() const { return strained_; }
  /// `heated`: the heat of sliding is taken into account.
  [[nodiscard]] std::vector<Diagnostic> texts(bool heated = false) const;

 private:
  double rms_slope_;
  bool corrected_;
  std::optional<double> unmeasured_nayak_;   // of a spectrum beyond the measured ones, where a correction is asked for
  std::array<double, 2> flagged_ends_;       // [1/m]: unreliable up to the first and from the second on
  bool slope_of_few_periods_;                // most of the slope is of waves up to the first
  std::optional<FrequencyRange> fitted_;     // [m/s]: v q stays where a Prony series was fitted
  std::optional<Diagnostic> heights_, lay_;  // of a correction that knows the spectrum alone
  bool by_sliding_ = false;                  // PartialContact, which was measured on sliding contacts
  bool ridges_ = false;                      // a spectrum that knows directions
  bool plain_ = false;                       // no correction
  bool slow_ = false, constant_ = false, fast_regime_ = false, unmeasured_ = false;
  bool beyond_fit_ = false;
  double strained_ = 0;
  bool lowest_bin_ = false, fast_ = false, full_ = false, no_contact_ = false, far_ = false, worse_ = false,
       light_ = false;
};

/// Where the roughness strains the rubber by more than the factors go; `share` of mu_H rests on that.
std::optional<Diagnostic> note_on_strain(const StrainFactors& factors, double rms_slope, double share);

}  // namespace asperity
