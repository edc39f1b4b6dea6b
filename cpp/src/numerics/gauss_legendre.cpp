// Gauss-Legendre rules by Newton's steps on P_n, and the matrices that integrate and differentiate the polynomial
// through values at the nodes, from its Legendre coefficients c_k = (k + 1/2) sum_j weight_j P_k(x_j) f_j.
#include "numerics/gauss_legendre.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

using Real = long double;  // where it is longer the tables are good to the last digit
using Polynomials = std::array<Real, LegendreRule::most + 1>;

/// P_0 .. P_n at x.
Polynomials legendre(std::size_t n, Real x) {
  Polynomials p{1, x};
  for (std::size_t k = 1; k < n; ++k) {
    const auto d = static_cast<Real>(k);
    p[k + 1] = ((2 * d + 1) * x * p[k] - d * p[k - 1]) / (d + 1);
  }
  return p;
}

/// Integrals from -1 to the nodes of (1 + x) P_k, by the rule itself on each of the intervals.
std::vector<Polynomials> integrals_from_root(std::size_t n, const Real* node, const Real* weight) {
  std::vector<Polynomials> result(n, Polynomials{});
  for (std::size_t i = 0; i < n; ++i) {
    const Real half = (node[i] + 1) / 2;
    for (std::size_t l = 0; l < n; ++l) {
      const Real from_lower = half * (node[l] + 1);
      const Polynomials p = legendre(n, from_lower - 1);
      const Real part = half * weight[l] * from_lower;
      for (std::size_t k = 0; k < n; ++k) result[i][k] += part * p[k];
    }
  }
  return result;
}

LegendreRule make_rule(std::size_t n) {
  LegendreRule r{};
  r.n = n;
  const auto size = static_cast<Real>(n);
  std::vector<Real> node(n), weight(n);
  std::vector<Polynomials> p(n), slope(n), integral(n);
  for (std::size_t i = 0; i < n; ++i) {
    Real x = -std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + 0.75L) / (size + 0.5L));
    for (int step = 0; step < 10; ++step) {
      const Polynomials at = legendre(n, x);
      x -= at[n] * (1 - x * x) / (size * (at[n - 1] - x * at[n]));
    }
    p[i] = legendre(n, x);
    node[i] = x;
    weight[i] = 2 * (1 - x * x) / (size * size * p[i][n - 1] * p[i][n - 1]);
    r.node[i] = static_cast<double>(x);
    r.weight[i] = static_cast<double>(weight[i]);
    integral[i][0] = x + 1;
    for (std::size_t k = 1; k < n; ++k) {
      const auto d = static_cast<Real>(k);
      slope[i][k] = d * (p[i][k - 1] - x * p[i][k]) / (1 - x * x);
      integral[i][k] = (p[i][k + 1] - p[i][k - 1]) / (2 * d + 1);
    }
  }
  const auto linear = integrals_from_root(n, node.data(), weight.data());
  for (std::size_t j = 0; j < n; ++j) {
    std::array<Real, LegendreRule::most> cumulative{}, from_linear{}, change{};
    Real lower = 0, upper = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Real coefficient = (static_cast<Real>(k) + 0.5L) * weight[j] * p[j][k];
      upper += coefficient;
      lower += k % 2 == 1 ? -coefficient : coefficient;
      for (std::size_t i = 0; i < n; ++i) {
        cumulative[i] += coefficient * integral[i][k];
        from_linear[i] += coefficient * linear[i][k];
        change[i] += coefficient * slope[i][k];
      }
      if (k + 2 >= n) r.last[j][n - 1 - k] = static_cast<double>(coefficient);
    }
    r.at_lower[j] = static_cast<double>(lower);
    r.at_upper[j] = static_cast<double>(upper);
    for (std::size_t i = 0; i < n; ++i) {
      r.cumulative[j][i] = static_cast<double>(cumulative[i]);
      r.cumulative_linear[j][i] = static_cast<double>(from_linear[i] / (1 + node[j]));
      r.slope[j][i] = static_cast<double>(weight[i] * change[i]);
    }
  }
  return r;
}

}  // namespace

const LegendreRule& legendre_rule(std::size_t n) {
  static const std::vector<LegendreRule> rules = [] {
    std::vector<LegendreRule> made;
    for (const std::size_t size : {4UL, 8UL, 12UL, 16UL, 20UL, 24UL, 28UL, 32UL}) made.push_back(make_rule(size));
    return made;
  }();
  for (const LegendreRule& rule : rules)
    if (rule.n >= n) return rule;
  return rules.back();
}

}  // namespace asperity
