// Adaptive bisection with a Gauss rule, and the choice between it and GSL's routines.
#include "numerics/adaptive_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/libraries.hpp"

namespace asperity {

namespace {

struct Part {
  double lower, upper;
  Integral of;
};

/// Halves the part with the largest error until the sum of errors is small enough.
Integral by_bisection(const Integrand& f, double lower, double upper, double rtol, double atol) {
  std::vector<Part> parts{{lower, upper, integrate_smooth(f, lower, upper)}};
  const auto smaller = [](const Part& a, const Part& b) { return a.of.error < b.of.error; };
  for (;;) {
    Integral sum{0, 0};
    for (const Part& part : parts) sum = {sum.value + part.of.value, sum.error + part.of.error};
    const double allowed = std::fmax(atol, rtol * std::fabs(sum.value));
    if (sum.error <= allowed && std::isfinite(sum.value)) return sum;
    std::ranges::pop_heap(parts, smaller);
    const Part worst = parts.back();
    const double middle = worst.lower + (worst.upper - worst.lower) / 2;
    if (parts.size() == most_parts || !std::isfinite(sum.value) || middle == worst.lower || middle == worst.upper)
      throw NotConverged("integral over [" + show(lower) + ", " + show(upper) + "] = " + show(sum.value) +
                         " with error " + show(sum.error) + " where " + show(allowed) + " was asked for");
    parts.back() = {worst.lower, middle, integrate_smooth(f, worst.lower, middle)};
    std::ranges::push_heap(parts, smaller);
    parts.push_back({middle, worst.upper, integrate_smooth(f, middle, worst.upper)});
    std::ranges::push_heap(parts, smaller);
  }
}

}  // namespace

/// The last two Legendre coefficients c_k of f bound its error amply: a Gauss rule integrates twice as high degrees.
Integral integrate_smooth(const Integrand& f, double lower, double upper) {
  static const LegendreRule& rule = legendre_rule(20);
  const double half = (upper - lower) / 2, middle = lower + half;
  double sum = 0, last = 0, before = 0;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double value = f(middle + half * rule.node[i]);
    sum += rule.weight[i] * value;
    last += rule.last[i][0] * value;
    before += rule.last[i][1] * value;
  }
  return {half * sum, std::fabs(half) * (std::fabs(last) + std::fabs(before))};
}

Integral integrate(const Integrand& f, double lower, double upper, double rtol, double atol, Adaptive rule) {
  heed();
  if (rule == Adaptive::bisection) return by_bisection(f, lower, upper, rtol, atol);
  if constexpr (has_gsl_and_fftw) return integrate_by_gsl(f, lower, upper, rtol, atol, rule);
  throw Error("GSL's integration was called in a build without it");  // its methods are refused before
}

}  // namespace asperity
