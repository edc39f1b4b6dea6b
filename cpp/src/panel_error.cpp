#include "panel_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

double larger(const double* tail, std::size_t k) { return std::fmax(std::fabs(tail[k]), std::fabs(tail[k + 1])); }

double beyond_rule(double size, const double* tail, double decay, double growth) {
  const double end = std::fmax(std::fabs(tail[0]), std::fabs(tail[1]) * decay) * decay;
  const double middle = larger(tail, LegendreRule::tails);
  if (!(end > 0)) return 0;
  if (!(end < size)) return end;
  const double at_n = std::log(size / end), half_way = std::log(size / std::fmin(size, std::fmax(middle, end)));
  return size * std::exp(-at_n * std::clamp(half_way > 0 ? at_n / half_way : growth, 1.0, growth));
}

double following(const double* effect, double decay) {
  double next = 0, fading = 1;
  for (std::size_t k = 0; k < LegendreRule::tails; ++k) next = std::fmax(next, effect[k] * (fading *= decay));
  return next / (1 - decay);
}

BreakUp break_up(const LegendreRule& rule, const double* g) {
  BreakUp result{.growth = 1.587};  // 2^(2/3)
  for (std::size_t i = 1; i < rule.n; ++i) {
    if (g[i] < 0.01 || g[i - 1] > 10) continue;
    // of ln G; an interpolated G may be 0 at the first nodes
    const double rise = std::log(g[i] / std::fmax(g[i - 1], 1e-3 * g[i])) / (rule.node[i] - rule.node[i - 1]);
    const double falling = std::asinh(std::numbers::pi / (2 * rise));
    result.least = std::fmax(result.least, std::exp(-static_cast<double>(rule.n) * falling));
  }
  return result;
}

double Foot::operator()(double g, double gamma) const {
  const double z = std::sqrt(g), root = 1 / std::cbrt(z);
  const double exponent = std::fmin(a / z, std::fmin(b * root * root, c * root));
  return (gamma * one + (1 - gamma) * three) * std::exp(-exponent);
}

}  // namespace asperity
