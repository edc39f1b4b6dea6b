// I1 and I2 of a rubber with their slopes over ln w, at any frequency.
#pragma once

#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"

namespace asperity {

/// I1 [Pa], I2 [Pa^2] and dI1/dln w, dI2/dln w at a number of frequencies.
struct AngularColumns {
  std::vector<double> i1, i2, slope1, slope2;
  void resize(std::size_t n);
};

/// While a temperature is searched for, frequencies may leave those that the rubber knows: a fitted series goes on, and
/// a master curve is held at its end. Whether the result stays inside is for the caller to check.
class AngularSlopes {
 public:
  /// `factors` of the waves that it is asked for, or none.
  explicit AngularSlopes(const Rubber& rubber, std::vector<ModulusFactors> factors = {});
  /// I1 and I2 alone.
  void values(std::span<const double> w, AngularColumns& result);
  void operator()(std::span<const double> w, AngularColumns& result);

 private:
  void of_series(std::span<const double> w, bool sloped, AngularColumns& result);
  void of_curve(const MasterCurve& curve, std::span<const double> w, AngularColumns& result);

  const Rubber& rubber_;
  std::vector<ModulusFactors> factors_;
  std::vector<double> around_[2], i1_[2], i2_[2], held_, of_loss_, loss_slope_;
};

}  // namespace asperity
