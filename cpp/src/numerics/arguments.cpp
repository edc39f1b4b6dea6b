// The texts of refused arguments: out of line, as every file checks arguments and none needs to compile this again.
#include "numerics/arguments.hpp"

#include <charconv>
#include <iterator>

namespace asperity {

// As std::to_chars writes it: no locale of a host puts a decimal comma in.
std::string show(double value, int digits) {
  char text[64];  // of 17 digits at most, which tell every double
  const auto end = std::to_chars(text, std::end(text), value, std::chars_format::general, digits).ptr;
  return {text, end};
}

void refuse(std::string_view name, double value, std::string_view allowed) {
  throw InvalidInput(std::string(name) + " = " + show(value) + ": must be " + std::string(allowed));
}

void require_each_finite(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) refuse(std::string(name) + "[" + std::to_string(i) + "]", values[i], "finite");
}

void require_each_positive(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i]))
      refuse(std::string(name) + "[" + std::to_string(i) + "]", values[i], "positive and finite");
}

void require_rising(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      refuse(std::string(name) + "[" + std::to_string(i) + "]", values[i],
             "above the entry before it, " + show(values[i - 1]) + " (strictly rising)");
}

void require_same_size(std::string_view name, std::size_t size, std::string_view other, std::size_t other_size) {
  if (size != other_size)
    throw InvalidInput(std::string(name) + " (" + std::to_string(size) + ") and " + std::string(other) + " (" +
                       std::to_string(other_size) + ") must have equal length");
}

}  // namespace asperity
