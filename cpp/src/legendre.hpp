// Gauss-Legendre rules with what a panel needs beside nodes and weights: integrals and derivatives of the interpolant.
#pragma once

#include <array>
#include <cstddef>

namespace asperity {

/// The rule of `n` nodes on [-1, 1] and the polynomial of degree n - 1 through values at them. Matrices are stored by
/// columns: column j belongs to the value at node j.
struct LegendreRule {
  static constexpr std::size_t most = 32, tails = 4;
  using Row = std::array<double, most>;

  std::size_t n;
  Row node, weight;
  Row at_lower, at_upper;                  // the polynomial at -1 and at 1
  std::array<Row, most> cumulative;        // its integral from -1 to each node
  std::array<Row, most> derivative;        // at each node
  std::array<Row, tails> tail;             // its Legendre coefficients, from the last one down
  std::array<Row, tails> tail_integral;    // int_-1 P_k of those degrees to each node
  std::array<Row, tails> tail_derivative;  // weight times P_k' at each node
};

/// The smallest rule kept that has at least `n` nodes (the largest where none has).
const LegendreRule& legendre_rule(std::size_t n);

}  // namespace asperity
