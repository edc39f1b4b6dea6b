// Slopes of functions by central differences.
#pragma once

namespace asperity {

/// Of a function that is good to twelve digits and changes over a unit both errors are some 1e-8: that of the rule, and
/// what is left of the digits.
inline constexpr double difference_step = 1e-4;

/// f'(0).
template <class F>
double slope_at_0(F f) {
  return (f(difference_step) - f(-difference_step)) / (2 * difference_step);
}

}  // namespace asperity
