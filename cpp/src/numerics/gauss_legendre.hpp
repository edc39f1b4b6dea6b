// Gauss-Legendre rules with the integrals and derivatives of the interpolant that a panel needs.
#pragma once

#include <cstddef>

namespace asperity {

/// The rule of `n` nodes on [-1, 1], n a multiple of 4, and the polynomial of degree n - 1 through values at them.
/// Matrices are stored by columns: column j belongs to the value at node j. Plain arrays, as the loops over them are
/// compiled for several vector units (kernels.hpp).
struct LegendreRule {
  static constexpr std::size_t most = 32;

  std::size_t n;
  double node[most], weight[most];
  double at_lower[most], at_upper[most];  // the polynomial at -1 and at 1
  double cumulative[most][most];          // its integral from -1 to each node
  // the same for values that begin as 1 + x: the rest of them is interpolated, which keeps the digits of small
  // integrals beside -1
  double cumulative_linear[most][most];
  double slope[most][most];  // weight times its derivative at each node
  double last[most][2];      // by nodes: what each adds to the last two Legendre coefficients
};

/// The smallest rule made that has at least `n` nodes (the largest where none has).
const LegendreRule& legendre_rule(std::size_t n);

}  // namespace asperity
