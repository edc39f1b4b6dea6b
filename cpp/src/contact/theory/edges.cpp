// int I (I2 / I2(v q_e))^(1/4) x^-3 d ln x for I = I1 and I2, x = q / q_e, on Gauss-Legendre panels of ln x that end at
// the knots of a master curve and are halved until both are known well enough.
#include "contact/theory/edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/rule_error.hpp"
#include "numerics/kernels.hpp"
#include "rubber/unlimited_rubber.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = 16;
constexpr double longest = 2;  // in ln x: I1 and I2 of a Prony series have singularities pi / 2 off the axis
constexpr double power = partial_contact::tail_power;

struct Piece {
  double lower, upper;  // in ln x
};

/// (I2 / I2(v q_e))^(1/4) x^-3
double factor(double of_i2, double x) {
  static_assert(power == 3 && partial_contact::tail_excess == 0.25);
  return std::sqrt(std::sqrt(of_i2)) / (x * x * x);
}

EdgeIntegrals on_piece(const Rubber& rubber, double frequency, double i2_at_end, const Piece& piece) {
  const LegendreRule& rule = legendre_rule(nodes);
  const double middle = (piece.lower + piece.upper) / 2, half = (piece.upper - piece.lower) / 2;
  std::array<double, nodes> w, i1, i2, weight;
  for (std::size_t k = 0; k < nodes; ++k) w[k] = frequency * std::exp(middle + half * rule.node[k]);
  (void)angular_integrals(rubber, w, i1, i2, {});
  for (std::size_t k = 0; k < nodes; ++k) weight[k] = half * factor(i2[k] / i2_at_end, w[k] / frequency);
  EdgeIntegrals result;
  double tail[LegendreRule::kept];
  for (std::size_t k = 0; k < nodes; ++k) {
    i1[k] *= weight[k];
    i2[k] *= weight[k];
  }
  const Kernels& loops = kernels();
  loops.add_up(rule, i1.data(), &result.i1, tail);
  result.i1_error = rule_error(tail);
  loops.add_up(rule, i2.data(), &result.i2, tail);
  result.i2_error = rule_error(tail);
  return result;
}

void add(EdgeIntegrals& to, const EdgeIntegrals& part) {
  to.i1 += part.i1;
  to.i2 += part.i2;
  to.i1_error += part.i1_error;
  to.i2_error += part.i2_error;
}

}  // namespace

Edges::Edges(const Rubber& rubber, double rtol)
    : rubber_(rubber), unlimited_(unlimited(rubber)), highest_(std::numeric_limits<double>::infinity()), rtol_(rtol) {
  limited_ = unlimited_ || std::holds_alternative<MasterCurve>(rubber);
  if (const auto known = known_range(rubber)) highest_ = known->highest;
}

/// By the Gauss rule of four nodes in x^-3.
double Edges::outside(double frequency, double lower, double upper, double i2_at_end) const {
  constexpr std::array node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
      weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double from = std::pow(upper, -power), to = std::pow(lower, -power);
  std::array<double, 4> w, i1, i2, i1_outside{};
  for (std::size_t k = 0; k < 4; ++k)
    w[k] = frequency * std::pow((from + to) / 2 + (to - from) / 2 * node[k], -1 / power);
  if (!angular_integrals(rubber_, w, i1, i2, i1_outside)) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += weight[k] * factor(i2[k] / i2_at_end, 1) * i1_outside[k];
  return sum * (to - from) / (2 * power);
}

EdgeIntegrals Edges::operator()(double frequency, double lower, double upper) const {
  const Rubber& rubber = unlimited_ ? *unlimited_ : rubber_;
  double from = std::log(lower), to = std::log(upper);
  const double i2_at_end = angular_integrals(rubber, std::fmin(frequency, highest_)).i2;
  EdgeIntegrals held;
  held.i2_at_end = i2_at_end;
  if (highest_ < frequency * upper) {
    const double at = std::fmax(lower, highest_ / frequency);
    const AngularIntegrals last = angular_integrals(rubber, highest_);
    const double integral = factor(last.i2 / i2_at_end, 1) * (std::pow(at, -power) - std::pow(upper, -power)) / power;
    held = {last.i1 * integral, last.i2 * integral, last.i1 * integral, 0, 0, i2_at_end};
    to = std::log(at);
  }
  if (!(to > from)) return held;
  if (limited_) held.i1_outside += outside(frequency, std::exp(from), std::exp(to), i2_at_end);
  std::vector<Piece> pieces;
  const auto add_pieces_to = [&](double end) {
    const double count = std::ceil((end - from) / longest), begin = from;
    for (double k = 1; k <= count; ++k) {
      const double next = k == count ? end : begin + (end - begin) * (k / count);
      pieces.push_back({from, next});
      from = next;
    }
  };
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber)) {
    const std::span<const double> knots = curve->knots();
    for (auto knot = std::ranges::upper_bound(knots, frequency * lower); knot != knots.end(); ++knot) {
      const double at = std::log(*knot / frequency);
      if (!(at < to)) break;
      if (at > from) add_pieces_to(at);
    }
  }
  add_pieces_to(to);
  std::vector<EdgeIntegrals> values;
  for (const Piece& piece : pieces) values.push_back(on_piece(rubber, frequency, i2_at_end, piece));
  // halves of a piece take the place of it until the error of the sum is small enough, or that of rounding
  constexpr std::size_t most_pieces = 20000;
  for (;;) {
    EdgeIntegrals sum = held;
    for (const EdgeIntegrals& value : values) add(sum, value);
    const double allowed1 = rtol_ * sum.i1, allowed2 = rtol_ * sum.i2;
    if ((sum.i1_error <= allowed1 && sum.i2_error <= allowed2) || pieces.size() > most_pieces) return sum;
    const auto share = 0.5 / static_cast<double>(pieces.size());
    const std::size_t count = pieces.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (values[i].i1_error <= share * allowed1 && values[i].i2_error <= share * allowed2) continue;
      const Piece whole = pieces[i];
      const double middle = (whole.lower + whole.upper) / 2;
      pieces[i] = {whole.lower, middle};
      values[i] = on_piece(rubber, frequency, i2_at_end, pieces[i]);
      pieces.push_back({middle, whole.upper});
      values.push_back(on_piece(rubber, frequency, i2_at_end, pieces.back()));
    }
  }
}

}  // namespace asperity
