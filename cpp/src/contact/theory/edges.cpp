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
#include "numerics/gauss_legendre.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = 16;
constexpr double longest = 2;  // in ln x: I1 and I2 of a Prony series have singularities pi / 2 off the axis
constexpr double power = partial_contact::tail_power;

/// (I2 / I2(v q_e))^(1/4) x^-3
double factor(double of_i2, double x) {
  static_assert(power == 3 && partial_contact::tail_excess == 0.25);
  return std::sqrt(std::sqrt(of_i2)) / (x * x * x);
}

void add(EdgeIntegrals& to, const EdgeIntegrals& part) {
  to.i1 += part.i1;
  to.i2 += part.i2;
  to.across += part.across;
  to.i1_outside += part.i1_outside;
  to.i1_error += part.i1_error;
  to.i2_error += part.i2_error;
}

}  // namespace

Edges::Edges(const Excitation& waves, double rtol)
    : waves_(waves),
      unlimited_(unlimited(waves.rubber())),
      highest_(std::numeric_limits<double>::infinity()),
      rtol_(rtol) {
  if (unlimited_) unlimited_waves_.emplace(*unlimited_, waves);
  limited_ = unlimited_ || std::holds_alternative<MasterCurve>(waves.rubber());
  if (const auto known = known_range(waves.rubber())) highest_ = known->highest;
}

Edges::Piece Edges::piece(const Place& place, double lower, double upper) const {
  const LegendreRule& rule = legendre_rule(nodes);
  const double middle = (lower + upper) / 2, half = (upper - lower) / 2;
  const double frequency = place.velocity * place.q_e;
  std::array<double, nodes> w, x, q, i1, i2, weight, across{};
  for (std::size_t k = 0; k < nodes; ++k) {
    x[k] = std::exp(middle + half * rule.node[k]);
    q[k] = place.q_e * x[k];
    w[k] = std::min(frequency * x[k], highest_);
  }
  (void)waves().of_waves(w, q, i1, i2, {}, place.harmonics, across);
  for (std::size_t k = 0; k < nodes; ++k) weight[k] = half * factor(i2[k] / place.i2_at_end, x[k]);
  Piece made{lower, upper, {}};
  EdgeIntegrals& result = made.value;
  // the last coefficients bound the error, as in numerics/adaptive_quadrature.cpp
  double last1[2] = {}, last2[2] = {};
  for (std::size_t k = 0; k < nodes; ++k) {
    const double of_i1 = weight[k] * i1[k], of_i2 = weight[k] * i2[k];
    result.i1 += rule.weight[k] * of_i1;
    result.i2 += rule.weight[k] * of_i2;
    result.across += rule.weight[k] * weight[k] * across[k];
    for (std::size_t m = 0; m < 2; ++m) {
      last1[m] += rule.last[k][m] * of_i1;
      last2[m] += rule.last[k][m] * of_i2;
    }
  }
  result.i1_error = std::fabs(last1[0]) + std::fabs(last1[1]);
  result.i2_error = std::fabs(last2[0]) + std::fabs(last2[1]);
  if (frequency * std::exp(middle) > highest_) result.i1_outside = result.i1;
  return made;
}

/// By the Gauss rule of four nodes in x^-3.
double Edges::outside(const Place& place, double lower, double upper) const {
  constexpr std::array node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
      weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double from = std::pow(upper, -power), to = std::pow(lower, -power);
  std::array<double, 4> w, q, i1, i2, i1_outside{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = std::pow((from + to) / 2 + (to - from) / 2 * node[k], -1 / power);
    w[k] = place.velocity * place.q_e * x;
    q[k] = place.q_e * x;
  }
  if (!waves_.of_waves(w, q, i1, i2, i1_outside, place.harmonics)) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += weight[k] * factor(i2[k] / place.i2_at_end, 1) * i1_outside[k];
  return sum * (to - from) / (2 * power);
}

/// Where the modulus changes its formula, in ln x.
std::vector<double> Edges::stops(const Place& place, double lower, double upper) const {
  std::vector<double> result;
  const double frequency = place.velocity * place.q_e;
  const auto add = [&](double at) {
    if (at > lower && at < upper) result.push_back(at);
  };
  if (const auto* const curve = std::get_if<MasterCurve>(&waves_.rubber()))
    for (auto knot = std::ranges::upper_bound(curve->knots(), frequency * std::exp(lower));
         knot != curve->knots().end() && *knot < frequency * std::exp(upper); ++knot)
      add(std::log(*knot / frequency));
  for (const double q : waves_.stops()) add(std::log(q / place.q_e));
  if (waves_.softening() || waves_.directions()) add(std::log(highest_ / frequency));
  std::ranges::sort(result);
  return result;
}

EdgeIntegrals Edges::operator()(double velocity, double q_e, double lower, double upper, std::size_t harmonics) const {
  const double frequency = velocity * q_e;
  double from = std::log(lower), to = std::log(upper);
  const double i2_at_end = waves()(std::fmin(frequency, highest_), q_e, Waves::of_edges).i2;
  const Place place{velocity, q_e, i2_at_end, harmonics};
  EdgeIntegrals held;
  held.i2_at_end = i2_at_end;
  double known_to = to;
  if (highest_ < frequency * upper) {
    const double at = std::fmax(lower, highest_ / frequency);
    known_to = std::log(at);
    if (!waves_.softening() && !waves_.directions()) {
      const AngularIntegrals last = angular_integrals(waves().rubber(), highest_);
      const double integral = factor(last.i2 / i2_at_end, 1) * (std::pow(at, -power) - std::pow(upper, -power)) / power;
      held = {last.i1 * integral, last.i2 * integral, 0, last.i1 * integral, 0, 0, i2_at_end};
      to = known_to;
    }
  }
  if (!(to > from)) return held;
  if (limited_ && known_to > from) held.i1_outside += outside(place, std::exp(from), std::exp(known_to));
  std::vector<Piece> pieces;
  pieces.reserve(8);
  const auto add_pieces_to = [&](double end) {
    const double count = std::ceil((end - from) / longest), begin = from;
    for (double k = 1; k <= count; ++k) {
      const double next = k == count ? end : begin + (end - begin) * (k / count);
      pieces.push_back(piece(place, from, next));
      from = next;
    }
  };
  for (const double at : stops(place, from, to))
    if (at > from) add_pieces_to(at);
  add_pieces_to(to);
  // halves of a piece take the place of it until the error of the sum is small enough, or that of rounding
  constexpr std::size_t most_pieces = 20000;
  for (;;) {
    EdgeIntegrals sum = held;
    for (const Piece& one : pieces) add(sum, one.value);
    const double allowed1 = rtol_ * sum.i1, allowed2 = rtol_ * sum.i2;
    if ((sum.i1_error <= allowed1 && sum.i2_error <= allowed2) || pieces.size() > most_pieces) return sum;
    const auto share = 0.5 / static_cast<double>(pieces.size());
    for (std::size_t i = 0, count = pieces.size(); i < count; ++i) {
      const Piece whole = pieces[i];
      if (whole.value.i1_error <= share * allowed1 && whole.value.i2_error <= share * allowed2) continue;
      const double middle = (whole.lower + whole.upper) / 2;
      pieces[i] = piece(place, whole.lower, middle);
      pieces.push_back(piece(place, middle, whole.upper));
    }
  }
}

}  // namespace asperity
