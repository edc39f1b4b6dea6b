// The temperature that one roughness feels from the heat of another, at one velocity.
#pragma once

#include "heat/universal.hpp"

namespace asperity {

/// With x = 2 q l, y = 2 q' l, l = sqrt(D t), t the longest residence: g = t x^2 y (N(x) / x - N(y) / y) / (y^2 - x^2).
class HeatKernel {
 public:
  HeatKernel(const Heating& heating, double velocity);

  /// A wavenumber as the kernel sees it.
  struct Place {
    double x, psi, q;  // 2 q l, N(x) / x, Q(x)
  };
  [[nodiscard]] Place at(double wavenumber) const;
  /// g [s].
  [[nodiscard]] double operator()(const Place& felt, const Place& heated) const;
  /// 2 q t N(2 q l) [s/m], the same from a unit of heat at the surface itself: the limit q' -> inf of g times q'.
  [[nodiscard]] double from_surface(const Place& felt) const { return felt.x * felt.x * felt.psi * time_ / length_; }

 private:
  Residence residence_;
  double time_, length_;
};

}  // namespace asperity
