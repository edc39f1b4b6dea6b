// Checks of arguments: each failure names the argument, the value and what is allowed.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "asperity/errors.hpp"

namespace asperity {

/// A number as a person would write it, with all the digits that matter.
std::string show(double value, int digits = 12);

/// InvalidInput: "name = value: must be allowed".
[[noreturn]] void refuse(std::string_view name, double value, std::string_view allowed);

// Written so that NaN fails every one of them.
inline void require_positive(std::string_view name, double value) {
  if (!(value > 0) || !std::isfinite(value)) refuse(name, value, "positive and finite");
}
inline void require_finite(std::string_view name, double value) {
  if (!std::isfinite(value)) refuse(name, value, "finite");
}
inline void require_not_negative(std::string_view name, double value) {
  if (!(value >= 0) || !std::isfinite(value)) refuse(name, value, "finite and not negative");
}
/// Heights must differ by a finite number.
inline void require_span(std::string_view name, double highest, double lowest) {
  if (!std::isfinite(highest - lowest)) refuse(name, highest, "less than 1.8e308 above the lowest, " + show(lowest));
}
inline void require_poisson(std::string_view name, double value) {
  if (!(value >= 0 && value <= 0.5)) refuse(name, value, "in [0, 0.5]");
}
void require_each_finite(std::string_view name, std::span<const double> values);
void require_each_positive(std::string_view name, std::span<const double> values);
void require_rising(std::string_view name, std::span<const double> values);
/// Beyond this ratio ln(q1 / q0) has lost its digits.
inline void require_band(std::string_view name, double lowest, double highest) {
  if (!(highest / lowest <= 1e300)) refuse(name, highest, "at most 1e300 times the lowest, " + show(lowest));
}
void require_same_size(std::string_view name, std::size_t size, std::string_view other, std::size_t other_size);
/// Spans that results are written to must be as long as their argument.
inline void require_room(std::span<const double> w, std::span<const double> i1, std::span<const double> i2) {
  require_same_size("i1", i1.size(), "angular_frequency", w.size());
  require_same_size("i2", i2.size(), "angular_frequency", w.size());
}
inline void require_rtol(double rtol) {
  if (!(rtol >= 1e-12 && rtol <= 0.1)) refuse("rtol", rtol, "in [1e-12, 0.1]");
}

}  // namespace asperity
