// Checks of arguments: each failure names the argument, the value and what is allowed.
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "asperity/errors.hpp"

namespace asperity {

/// A number as a person would write it, with all the digits that matter.
std::string show(double value, int digits = 12);

// The phrases of sentences, joined by +.
inline Phrase argument(std::string_view name) { return {Phrase::Kind::argument, std::string(name)}; }
inline Phrase value(std::string text, double number, std::string unit = {}) {
  return {Phrase::Kind::value, std::move(text), {number}, std::move(unit)};
}
inline Phrase value(double number, int digits = 12, std::string unit = {}) {
  return value(show(number, digits), number, std::move(unit));
}
/// "(first, second)"
Phrase pair(double first, double second);
inline Phrase word(std::string text) { return {Phrase::Kind::value, std::move(text)}; }
inline Phrase count(std::size_t number) { return value(std::to_string(number), static_cast<double>(number)); }
/// The unit behind a value.
inline Phrase unit(const char* name) { return {Phrase::Kind::unit, std::string(" ") + name, {}, name}; }
inline Phrase in_kelvin(double temperature) { return value(temperature, 6, "K"); }
inline Phrase must(std::string words) { return {Phrase::Kind::must, std::move(words)}; }
inline Phrase must_be() { return must(": must be "); }
inline Phrase advice(std::string code, std::string words, std::vector<double> numbers = {}) {
  return {Phrase::Kind::advice, std::move(words), std::move(numbers), std::move(code)};
}
inline Sentence operator+(Sentence sentence, Phrase phrase) {
  sentence.push_back(std::move(phrase));
  return sentence;
}
inline Sentence operator+(Phrase first, Phrase second) { return Sentence{std::move(first)} + std::move(second); }
inline Sentence operator+(Sentence sentence, const Sentence& end) {
  sentence.insert(sentence.end(), end.begin(), end.end());
  return sentence;
}
inline Sentence operator+(Phrase first, const Sentence& end) { return Sentence{std::move(first)} + end; }

// The notes of a result; `step` is what to do, by default the advice in the sentence.
inline Diagnostic note(std::string code, Sentence sentence, Sentence step = {}) {
  return {std::move(code), Severity::note, std::move(sentence), std::move(step)};
}
inline Diagnostic warning(std::string code, Sentence sentence, Sentence step = {}) {
  return {std::move(code), Severity::warning, std::move(sentence), std::move(step)};
}
inline Diagnostic fatal(std::string code, Sentence sentence, Sentence step = {}) {
  return {std::move(code), Severity::fatal, std::move(sentence), std::move(step)};
}

/// InvalidInput: "name = value: must be allowed".
[[noreturn]] void refuse(std::string_view name, double found, const Sentence& allowed);
[[noreturn]] void refuse(std::string_view name, double found, std::string allowed);
[[noreturn]] void refuse(const Sentence& what, double found, std::string allowed);
/// The same of an entry of a list.
[[noreturn]] void refuse(std::string_view name, std::size_t entry, double found, std::string allowed);

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
/// At least so many entries; `what` they are for goes on behind it.
void require_size(std::string_view name, std::size_t size, std::size_t least, const std::string& what = "");
void require_same_size(std::string_view name, std::size_t size, std::string_view other, std::size_t other_size);
struct Column {
  std::string_view name;
  std::span<const double> values;
};
/// As many entries in each as in the first, all of them positive.
void require_positive_columns(std::initializer_list<Column> columns);
/// Spans that results are written to must be as long as their argument.
inline void require_room(std::span<const double> w, std::span<const double> i1, std::span<const double> i2) {
  require_same_size("i1", i1.size(), "angular_frequency", w.size());
  require_same_size("i2", i2.size(), "angular_frequency", w.size());
}
/// Whether products of a number keep all their digits.
inline bool is_representable(double value) { return value >= 1e-280 && value <= 1e280; }
/// On an angle in radians that seems to be in degrees.
std::optional<Diagnostic> note_on_angle(double direction);
inline void require_rtol(double rtol) {
  if (!(rtol >= 1e-12 && rtol <= 0.1)) refuse("rtol", rtol, "in [1e-12, 0.1]");
}

/// A range of positive numbers as a message shows it. Its ends are rounded inwards: whoever types them is inside of it.
class ShownRange {
 public:
  ShownRange(double lowest, double highest);
  [[nodiscard]] Phrase lowest() const;
  [[nodiscard]] Phrase highest() const;
  /// "[lowest, highest]"
  [[nodiscard]] Sentence text() const;
  /// A number with six digits, or as many more as show on which side of the range it lies.
  [[nodiscard]] Phrase value(double x) const;

 private:
  [[nodiscard]] int side(double x) const;
  double lowest_, highest_;
  int digits_;
};

}  // namespace asperity
