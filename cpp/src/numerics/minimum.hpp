// The least value of a function of one variable.
#pragma once

#include <numbers>

namespace asperity {

/// Where f, which has one minimum between `a` and `b`, is least, to `tolerance`: golden section, one new value a step.
template <class F>
double golden_section(F&& f, double a, double b, double tolerance) {
  constexpr double golden = std::numbers::phi - 1;
  double left = b - golden * (b - a), right = a + golden * (b - a), at_left = f(left), at_right = f(right);
  while (b - a > tolerance) {
    if (at_left < at_right) {
      b = right;
      right = left;
      at_right = at_left;
      at_left = f(left = b - golden * (b - a));
    } else {
      a = left;
      left = right;
      at_left = at_right;
      at_right = f(right = a + golden * (b - a));
    }
  }
  return (a + b) / 2;
}

}  // namespace asperity
