// What the contact of the scan itself makes of PartialContact's rule: factors of its hysteresis and its area.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asperity/contact.hpp"
#include "sliding/scan.hpp"

namespace asperity {

/// Of one point.
struct ScanRatio {
  double hysteresis = 1, area = 1;
  double across = 0;  // the force across over that along
  // relative errors: of what is between contacts, of pixels, of having one scan, of contacts that did not converge, and
  // of short waves that were solved on pieces alone
  double interpolation = 0, pixels = 0, scan = 0, convergence = 0, joining = 0;
  /// Of mu, all together.
  [[nodiscard]] double model_error() const;
  /// What becomes of an error of the rule's mu, of which an adhesion may be a part.
  [[nodiscard]] double error_factor(double adhesion) const {
    return adhesion > 0 ? std::max(hysteresis, area) : hysteresis;
  }
};

/// What PartialContact says of a point with heat, and the shift factor that each wave has there.
struct HotRule {
  double hysteresis, area;
  double q0, q1;            // [1/m]
  std::vector<double> a_T;  // at equal steps of ln q from q0 to q1, beyond which it is constant
};

/// The contacts of a scan for one spectrum, of which the band counts, one rubber and one direction of sliding.
class ScanRatios {
 public:
  /// InvalidInput where the map is no sample of the spectrum.
  ScanRatios(const ScanContact& scan, const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model);

  /// What the ratios are factors of: the rings of the map, and the spectrum where it goes on beyond the map.
  [[nodiscard]] const Spectrum& spectrum() const { return spectrum_; }
  /// At pairs of pressure [Pa] and v a_T [m/s]; `threads` share the contacts that have to be solved.
  std::vector<ScanRatio> operator()(std::span<const double> pressure, std::span<const double> velocity,
                                    unsigned threads);
  /// At a pressure and a velocity with heat: the contact itself, solved with the modulus of each wave at its own
  /// temperature.
  ScanRatio hot(double pressure, double velocity, const HotRule& rule);
  /// What there is to say of the map.
  [[nodiscard]] std::vector<Diagnostic> notes() const;

 private:
  ScanContact contact_;
  const Rubber& rubber_;
  double poisson_ratio_, direction_;
  std::optional<StrainFactors> strain_;
  Band band_;
  Spectrum spectrum_;
  std::uint64_t fingerprint_;
};

}  // namespace asperity
