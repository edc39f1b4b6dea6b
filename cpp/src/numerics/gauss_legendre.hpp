// Gauss-Legendre rules with the integrals and derivatives of the interpolant that a panel needs.
#pragma once

#include <cstddef>

namespace asperity {

/// The rule of `n` nodes on [-1, 1], n a multiple of 4, and the polynomial of degree n - 1 through values at them.
/// Matrices are stored by columns: column j belongs to the value at node j. Plain arrays, as the loops over them are
/// compiled for several vector units (kernels.hpp).
struct LegendreRule {
  static constexpr std::size_t most = 32, tails = 4, kept = 2 * tails;

  std::size_t n;
  double node[most], weight[most];
  double at_lower[most], at_upper[most];  // the polynomial at -1 and at 1
  double cumulative[most][most];          // its integral from -1 to each node
  // the same for values that begin as 1 + x and as (1 + x)^3: the rest of them is interpolated, which keeps the digits
  // of small integrals beside -1
  double cumulative_linear[most][most], cumulative_cubic[most][most];
  double slope[most][most];  // weight times its derivative at each node
  // by nodes: the addition of each to Legendre coefficients, the last ones from the end down, two half way, zeros;
  // int_-1 P_k of the last degrees up to it, and its weight times P_k'
  double tail[most][kept], tail_integral[most][tails], tail_slope[most][tails];
};

/// The smallest rule kept that has at least `n` nodes (the largest where none has).
const LegendreRule& legendre_rule(std::size_t n);

}  // namespace asperity
