// How far friction was off exact sliding contacts, by correction, speed and load.
#pragma once

#include <optional>

#include "asperity/correction.hpp"

namespace asperity {

/// Speeds by n, the mean over ln q of d ln(I1 / I2) / d ln omega on the band: +1 where all frequencies are slow, 0
/// where the loss tangent is constant, -1 where all are fast.
enum class SpeedRegime { slow, constant, fast };
SpeedRegime speed_regime(double n);

/// The errors of one correction on one surface with one rubber.
class ModelError {
 public:
  ModelError(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber);
  /// Takes up a velocity.
  void start(double velocity);
  /// Of mu, relative, at an uncorrected G(q1); NaN where nothing is known.
  [[nodiscard]] double operator()(double g) const;
  [[nodiscard]] SpeedRegime regime() const { return regime_; }

 private:
  const double (*by_load_)[4] = nullptr;  // by speed and load
  const double* by_speed_ = nullptr;      // or by speed alone
  const double* at_least_ = nullptr;      // over ridges, by speed
  const Rubber& rubber_;
  std::optional<Rubber> unlimited_;  // instead of it: a series without the range that it was fitted on
  double q0_ = 0, q1_ = 0, lightest_ = 0, heaviest_ = 0;
  bool known_ = false;
  SpeedRegime regime_ = SpeedRegime::slow;
};

}  // namespace asperity
