// The box of ln v and T0 in coordinates in which the friction of a measured modulus is smooth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asperity/build_friction_map.hpp"

namespace asperity {

/// A measured modulus has a kink at each of its rows, so that mu is rough over w = ln v + ln a_T(T0), at a constant v
/// over T0 too, and smooth over T0 at a constant w. With ln a_T = a t / (1 + b t), t = T0 - lowest, which all laws are,
/// ln v and ln a_T are between sides of their own, and on each line of constant w in the box ln a_T goes from `lower`
/// to `upper`: w and the share of this way are two coordinates between constant sides. Where a line changes the side
/// that it begins or ends on, the share has a kink over w: there maps are cut.
class Slant {
 public:
  Slant(const std::array<double, 2>& ln_velocity, const std::array<double, 2>& temperature,
        const TemperatureShift& shift)
      : x_(ln_velocity), coldest_(temperature[0]), hottest_(temperature[1]) {
    const ShiftValue first = shift_at(shift, coldest_), last = shift_at(shift, hottest_);
    const double range = hottest_ - coldest_, whole = std::log(10) * (last.log10_a_T - first.log10_a_T);
    a_ = std::log(10) * first.slope;
    b_ = (a_ * range / whole - 1) / range;
    sides_ = {std::fmin(0, whole), std::fmax(0, whole)};
  }

  [[nodiscard]] std::array<double, 2> coefficients() const { return {a_, b_}; }
  /// The sides of ln a_T, 0 one of them.
  [[nodiscard]] const std::array<double, 2>& log_a_T() const { return sides_; }

  /// w where lines change the sides, and its own sides.
  [[nodiscard]] std::vector<double> cuts() const {
    const double least = x_[0] + sides_[0], most = x_[1] + sides_[1];
    const double way = std::fmin(x_[1] - x_[0], sides_[1] - sides_[0]);
    // of a box that is as long as wide, the two are one
    const double between = std::fmax(most - way, (least + way) + 1e-9 * way);
    return {least, least + way, between, most};
  }

  struct Point {
    double ln_velocity, temperature;
  };
  [[nodiscard]] Point at(double w, double share) const {
    const double lower = std::fmax(sides_[0], w - x_[1]), upper = std::fmin(sides_[1], w - x_[0]);
    const double log_a_T = lower + share * (upper - lower);
    return {w - log_a_T, std::clamp(coldest_ + log_a_T / (a_ - b_ * log_a_T), coldest_, hottest_)};
  }

 private:
  std::array<double, 2> x_, sides_{};
  double coldest_, hottest_, a_ = 0, b_ = 0;
};

}  // namespace asperity
