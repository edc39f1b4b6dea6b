// Comparisons of numbers that would be equal but for how each of them was computed or written down.
#pragma once

namespace asperity {

/// Relative: products, changes of unit and texts of eleven digits are off by less, and nothing that is measured by so
/// little.
inline constexpr double rounding_error = 1e-10;

inline bool is_below(double value, double limit) { return value < limit * (1 - rounding_error); }
inline bool is_above(double value, double limit) { return value > limit * (1 + rounding_error); }
inline bool is_within(double value, double lowest, double highest) {
  return value >= lowest * (1 - rounding_error) && value <= highest * (1 + rounding_error);
}

}  // namespace asperity
