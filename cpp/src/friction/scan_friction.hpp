// Friction with the contact of a scan: PartialContact's on the rings of the map, times the ratios of the exact
// contacts.
#pragma once

#include <optional>
#include <span>

#include "asperity/friction.hpp"
#include "contact/scan_ratio.hpp"

namespace asperity {

/// The spectrum and the model that engines solve for a model: its own, but for one with a ScanContact.
class ScanFriction {
 public:
  ScanFriction(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model);
  [[nodiscard]] const Spectrum& spectrum() const { return ratios_ ? ratios_->spectrum() : spectrum_; }
  [[nodiscard]] const ContactModel& model() const { return ratios_ ? rule_ : model_; }
  [[nodiscard]] bool of_scan() const { return ratios_.has_value(); }
  /// Of one point with heat.
  ScanRatio hot(double pressure, double velocity, const HotRule& rule) {
    return ratios_->hot(pressure, velocity, rule);
  }
  /// Makes the result that of the model: `a_T` of the points, none where the rubber is not shifted.
  void apply(Friction& f, std::span<const double> a_T, unsigned threads);

 private:
  const Spectrum& spectrum_;
  const ContactModel& model_;
  ContactModel rule_;
  std::optional<ScanRatios> ratios_;
};

}  // namespace asperity
