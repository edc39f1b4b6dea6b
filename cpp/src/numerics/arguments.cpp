// The texts of refused arguments: out of line, as every file checks arguments and none needs to compile this again.
#include "numerics/arguments.hpp"

#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>

namespace asperity {

// As std::to_chars writes it: no locale of a host puts a decimal comma in.
std::string show(double value, int digits) {
  char text[64];  // of 17 digits at most, which tell every double
  const auto end = std::to_chars(text, std::end(text), value, std::chars_format::general, digits).ptr;
  return {text, end};
}

Phrase pair(double first, double second) {
  return {Phrase::Kind::value, "(" + show(first) + ", " + show(second) + ")", {first, second}};
}

namespace {

[[noreturn]] void refuse(const Sentence& what, double found, const Sentence& allowed) {
  throw InvalidInput(what + " = " + value(found) + must_be() + allowed, "invalid-value");
}

}  // namespace

void refuse(std::string_view name, double found, const Sentence& allowed) {
  refuse(Sentence{argument(name)}, found, allowed);
}

void refuse(std::string_view name, double found, std::string allowed) {
  refuse(Sentence{argument(name)}, found, Sentence{std::move(allowed)});
}

void refuse(const Sentence& what, double found, std::string allowed) {
  refuse(what, found, Sentence{std::move(allowed)});
}

void refuse(std::string_view name, std::size_t entry, double found, std::string allowed) {
  refuse(argument(name) + ("[" + std::to_string(entry) + "]"), found, Sentence{std::move(allowed)});
}

void require_each_finite(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) refuse(name, i, values[i], "finite");
}

void require_each_positive(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i])) refuse(name, i, values[i], "positive and finite");
}

void require_rising(std::string_view name, std::span<const double> values) {
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      refuse(name, i, values[i], "above the entry before it, " + show(values[i - 1]) + " (strictly rising)");
}

void require_positive_columns(std::initializer_list<Column> columns) {
  const Column& first = *columns.begin();
  for (const auto& [name, values] : columns) require_same_size(name, values.size(), first.name, first.values.size());
  for (const auto& [name, values] : columns) require_each_positive(name, values);
}

void require_size(std::string_view name, std::size_t size, std::size_t least, const std::string& what) {
  if (size < least)
    throw InvalidInput(
        argument(name) + " has " + count(size) + " entries" + must_be() + std::to_string(least) + " or more" + what,
        "too-few-entries");
}

void require_same_size(std::string_view name, std::size_t size, std::string_view other, std::size_t other_size) {
  if (size != other_size)
    throw InvalidInput(argument(name) + " (" + count(size) + ") and " + argument(other) + " (" + count(other_size) +
                           ")" + must(" must have ") + "equal length",
                       "unequal-lengths");
}

std::optional<Diagnostic> note_on_angle(double direction) {
  if (!(std::fabs(direction) > 2 * std::numbers::pi)) return std::nullopt;
  return warning("large-angle",
                 argument("direction") + " = " + value(direction, 6) + " is more than a turn: it is in radians",
                 {"give the angle in radians"});
}

// Decimal numbers of few digits beside the ends of a range: rounding must not bring a number inside that lies outside,
// nor an end outside. A decimal of n digits is a multiple of 10^(floor(log10 x) + 1 - n).

namespace {

constexpr int least_digits = 6, most_digits = 17;  // 17 tell every double

double read(const std::string& text) {
  double x = 0;
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

std::string inwards(double x, int digits, bool up) {
  std::string text = show(x, digits);
  const double rounded = read(text);
  if (up ? rounded >= x : rounded <= x) return text;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) + 1 - digits);
  return show(rounded + (up ? unit : -unit), digits);
}

}  // namespace

ShownRange::ShownRange(double lowest, double highest) : lowest_(lowest), highest_(highest), digits_(least_digits) {
  while (digits_ < most_digits && read(this->lowest().text) > read(this->highest().text)) ++digits_;
}

Phrase ShownRange::lowest() const {
  const std::string text = inwards(lowest_, digits_, true);
  return asperity::value(text, read(text));
}

Phrase ShownRange::highest() const {
  const std::string text = inwards(highest_, digits_, false);
  return asperity::value(text, read(text));
}

Sentence ShownRange::text() const { return "[" + lowest() + ", " + highest() + "]"; }

Phrase ShownRange::value(double x) const {
  int digits = least_digits;
  while (digits < most_digits && side(read(show(x, digits))) != side(x)) ++digits;
  return asperity::value(show(x, digits), x);
}

int ShownRange::side(double x) const { return x < lowest_ ? -1 : x > highest_ ? 1 : 0; }

}  // namespace asperity
