// I1 and I2 of a rubber with their slopes over ln w, at any frequency.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"

namespace asperity {

/// I1 [Pa], I2 [Pa^2] and dI1/dln w, dI2/dln w at a number of frequencies; with directions the sum across too.
struct AngularColumns {
  std::vector<double> i1, i2, slope1, slope2, across;
  void resize(std::size_t n);
};

/// While a temperature is searched for, frequencies may leave those that the rubber knows: a fitted series goes on, and
/// a master curve is held at its end. Whether the result stays inside is for the caller to check.
class AngularSlopes {
 public:
  /// `factors` and `rings` of the waves that it is asked for, or none.
  explicit AngularSlopes(const Rubber& rubber, std::vector<ModulusFactors> factors = {}, Rings rings = {});
  /// How many harmonics of the rings are taken.
  void take_harmonics(std::size_t count) { harmonics_ = count; }
  /// I1 and I2 alone.
  void values(std::span<const double> w, AngularColumns& result) { solve(w, false, result); }
  void operator()(std::span<const double> w, AngularColumns& result) { solve(w, true, result); }

 private:
  void solve(std::span<const double> w, bool sloped, AngularColumns& result);
  void of_series(std::span<const double> w, bool sloped, AngularColumns& result);
  void of_curve(const MasterCurve& curve, std::span<const double> w, bool sloped, AngularColumns& result);
  void add_rings(std::span<const double> w, bool sloped, AngularColumns& result);

  const Rubber& rubber_;
  std::optional<Rubber> unlimited_;  // instead of it: a series without the range that it was fitted on
  std::vector<ModulusFactors> factors_;
  Rings rings_;
  std::size_t harmonics_ = 0;
  std::vector<double> around_[2], i1_[2], i2_[2], held_, of_loss_, loss_slope_;
  std::vector<double> loss_, square_, slopes_;  // rows of harmonics
};

}  // namespace asperity
