// The error of a panel's hysteresis, sum of the terms (w a weight each, c_k Legendre coefficients, n nodes)
//   w max_k |c_k effect_k| decay / (1 - decay)      dG and R beyond the last coefficients known,
//   w c_n(F) c_n(dR) + w c_2n(F) int |dR|            the rule's error on int F dR, exact up to degree 2 n - 1,
//   w |error of the rule on F's foot| |dR/dG|        F ~ sqrt(G) leaves its power law where G ~ 1,
// and rounding. For the decay of the coefficients of analytic functions see L. N. Trefethen, Approximation Theory and
// Approximation Practice (2013), Theorems 8.1 and 19.3.
#include "contact/solver/panel_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

double larger(const double* tail, std::size_t k) { return std::max(std::fabs(tail[k]), std::fabs(tail[k + 1])); }

double beyond_rule(double size, const double* tail, double decay, double growth) {
  const double end = std::max(std::fabs(tail[0]), std::fabs(tail[1]) * decay) * decay;
  const double middle = larger(tail, LegendreRule::tails);
  if (!(end > 0)) return 0;
  if (!(end < size)) return end;
  if (growth == analytic && middle * middle >= size * end) return end * (end / size);
  const double at_n = std::log(size / end), half_way = std::log(size / std::min(size, std::max(middle, end)));
  return size * std::exp(-at_n * std::clamp(half_way > 0 ? at_n / half_way : growth, 1.0, growth));
}

namespace {

constexpr std::size_t tails = LegendreRule::tails;
constexpr double rounding = 1e-15;

/// Weights of the bounds, as none of them is sharp: set on random scenes (tests/stability, seeds 101 to 103 with Prony
/// series, 201 to 203 with tables, 11 and 12 with edges) so that the sum was above the error in each of 62,000, and
/// judged on others.
struct Weights {
  double following;  // the coefficients of dG and R after the last known ones, by the effect of those
  double far;        // R again: a coefficient of twice their degree against all of F
  double at_n;       // the rule: a coefficient of F and one of dR after the last ones
  double at_2n;      // the rule: a coefficient of F of twice the degree against all of dR
  double foot;       // the foot of a front
};
constexpr Weights twice_at_front{9, 0.5, 0.55, 0.0003, 7}, twice_in_front{9, 0.5, 0.55, 0.005, 7},
    at_front{6, 0.1, 0.1, 0.12, 7}, behind{0.2, 0.1, 0.3, 0.8, 5}, behind_on_few{0.2, 0.1, 0.3, 1.2, 5},
    tabulated{3, 0, 0.1, 0.25, 3};
constexpr double of_digits = 5;

const Weights& weights(const Panel& p, const OnPanel& at) {
  if (at.by_parts_twice) return at.g_upper < 10 ? twice_in_front : twice_at_front;  // the first break up all along
  if (p.tabulated) return tabulated;
  if (p.at_front) return at_front;
  return p.rule->n < 12 ? behind_on_few : behind;  // coefficients half way to 8 tell little
}

/// The coefficient of degree 2 n if the last four known ones keep falling as they do. sqrt(G) has a branch point at the
/// complex s where the growth of G over the panel cancels G at its lower end; where G grows many times it lies near,
/// and its coefficients outlast those of the smooth part. The factor is for the degrees below 2 n that dR raises to it.
double extrapolated_to_2n(const LegendreRule& rule, const double* tail) {
  const double last = larger(tail, 0), before = larger(tail, 2), fall = last < before ? last / before : 1;
  double result = 12 * last;
  for (std::size_t i = 0; i < rule.n; i += 4) result *= fall * fall;  // `fall` is that of two degrees
  return result;
}

/// The effect on a result of all degrees after the last known ones: of those, from the last one down, the largest, on
/// from which effects fall by `decay` a degree.
double following(const double* effect, double decay) {
  double next = 0, passed = 1;
  for (std::size_t k = 0; k < tails; ++k) next = std::max(effect[k] * (passed *= decay), next);
  return next / (1 - decay);
}

/// F(G) on a panel in which the contact breaks up: exp(-1 / 4 G) is tame where |arg G| < pi / 2 only, so that F is
/// rougher than G is.
struct BreakUp {
  double growth = analytic;  // see `beyond_rule`: like n^(2/3) at the foot of a front
  double least = 0;          // by how much the coefficients of F fall from n to 2 n at the most
};

BreakUp break_up(const LegendreRule& rule, const double* g) {
  double steepest = 0;  // slope of ln G
  for (std::size_t i = 1; i < rule.n; ++i) {
    if (g[i] < 0.005 || g[i - 1] > 10) continue;
    // an interpolated G may be lost at the first nodes; ln r < (r - 1) / sqrt(r)
    const double before = std::max(g[i - 1], 1e-3 * g[i]), run = rule.node[i] - rule.node[i - 1];
    steepest = std::max((g[i] - before) / (run * std::sqrt(g[i] * before)), steepest);
  }
  const double x = std::numbers::pi / (2 * steepest), falling = 1 / (x + std::sqrt(1 + x * x));  // exp(-asinh x)
  double least = 1;
  for (std::size_t i = 0; i < rule.n; ++i) least *= falling;
  return {.growth = 1.587, .least = least};  // 2^(2/3)
}

/// Error of a rule in t on the foot of a front, where F (or F2) leaves the law that it follows above G = 1. It depends
/// on G at the first node alone, whatever the number of nodes: `one` and `three` at most, for P and for P^3, as much
/// less as the exponent says. Measured at n = 12, 20 and 32 against mpmath, G from 1e-7 to 1600.
struct Foot {
  double one, three;
  double a, b, c;  // exponent: the least of a / z, b / z^(2/3), c / z^(1/3), with z = sqrt(G)
  [[nodiscard]] double operator()(double g, double gamma) const {
    const double z = std::sqrt(std::fmax(g, 1e-300));
    double exponent = a / z;
    if (z < 0.12) {  // from (a / b)^3 on it is the least
      const double root = 1 / std::cbrt(z);
      exponent = std::min({exponent, b * root * root, c * root});
    }
    return (gamma * one + (1 - gamma) * three) * std::exp(-exponent);
  }
};
constexpr Foot foot_of_f{0.021, 0.15, 0.45, 0.92, 3.1}, foot_of_f2{7e-4, 0.014, 0.35, 0.95, 3.4};

double foot(const Panel& p, const OnPanel& at, double gamma) {
  const auto error = [&](const Foot& of) {
    return of(at.g[0], gamma) * std::fabs(at.first_slope) / p.rule->weight[0] * (1 + p.rule->node[0]) /
           std::fmax(at.g[0], 1e-300);
  };
  if (at.by_parts_twice) return error(foot_of_f2);
  const bool from_front = at.g_lower < 100 && at.g[0] > 2 * at.g_lower;  // where a spectrum jumps, G as good as begins
  // sqrt(G) is as the square root of s beside a front, and as s where the rate is 0 or the panel's variable is s
  return from_front ? (p.sqrt_endpoint ? 1 : 7 * std::max(1.0, std::sqrt(std::fmax(0, at.g[0])))) * error(foot_of_f)
                    : 0;
}

double larger_end(const Panel::Smooth& of) { return std::max(std::fabs(of.lower), std::fabs(of.upper)); }

}  // namespace

double hysteresis_error(const Panel& p, const OnPanel& at, double scale, double gamma) {
  const LegendreRule& rule = *p.rule;
  const double* const tail = at.sums.tail;
  const double end = larger(tail, 0);
  double effect[tails], of_f[tails];  // of_f: int P_k dF
  for (std::size_t k = 0; k < tails; ++k) {
    of_f[k] = at.rise - at.by_r[k];
    effect[k] = std::fabs(p.g_tail[k] * scale * at.by_g[k]) + std::fabs(p.r.tail[k] * of_f[k]);
  }
  // F may fall slower than dG and R do
  const double earlier = larger(of_f, 2);
  const double decay = std::clamp(earlier > 0 ? std::sqrt(larger(of_f, 0) / earlier) : 0, p.decay, 0.9);

  double digits = rounding * (static_cast<double>(rule.n) * larger_end(p.r) * at.rise + 4 * p.r.change * at.f_upper);
  if (at.by_parts_twice) digits += rounding * larger_end(p.dr_dg) * at.f2_upper / scale;

  const Panel::Smooth& smooth = at.by_parts_twice ? p.dr_dg : p.r;
  const double size = at.by_parts_twice ? at.f2_upper : at.rise, per = at.by_parts_twice ? 1 / scale : 1;
  const bool breaks_up =
      at.g_upper > 0.01 && (p.at_front ? at.g[0] < (at.by_parts_twice ? 2e-4 : 5e-3) : at.g_lower < 1);
  const BreakUp rough = breaks_up ? break_up(rule, at.g) : BreakUp{};
  const double known = std::max(beyond_rule(size, tail, decay, rough.growth), end * rough.least);
  const bool branch_point_beside = !breaks_up && at.g_upper > 10 * at.g_lower;
  const double beyond = branch_point_beside ? std::max(known, extrapolated_to_2n(rule, tail)) : known;

  const Weights& w = weights(p, at);
  return w.following * following(effect, p.decay * decay) +
         per * (w.far * smooth.far * size + w.at_n * end * larger(smooth.tail, 0) + w.at_2n * beyond * smooth.change +
                w.foot * foot(p, at, gamma)) +
         of_digits * digits;
}

}  // namespace asperity
