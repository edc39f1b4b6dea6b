// Decimal numbers of few digits beside the ends of a range: rounding must not bring a number inside that lies outside,
// nor an end outside. A decimal of n digits is a multiple of 10^(floor(log10 x) + 1 - n).
#include "numerics/shown_range.hpp"

#include <charconv>
#include <cmath>

#include "numerics/arguments.hpp"

namespace asperity {

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
