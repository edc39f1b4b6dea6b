// Polynomials that are orthonormal under a measure given at points, and the Gauss rules of it.
#pragma once

#include <cstddef>
#include <vector>

namespace asperity {

/// x p_j = beside_j p_j+1 + diagonal_j p_j + beside_j-1 p_j-1; fewer degrees where x takes few values.
struct Jacobi {
  static constexpr std::size_t most = 12;
  std::size_t degrees = 0;
  double measure = 0, diagonal[most] = {}, beside[most] = {};
};

/// The recurrence of the points `x` with their weights, and square roots of the weights times p_j at the points in
/// `rows`, as many in a row as there are points.
Jacobi orthonormal(const std::vector<double>& weight, const std::vector<double>& x, std::vector<double>& rows);

/// Nodes, p_j(x_i) and weights of the Gauss rule of `count` nodes.
struct NodeRule {
  std::size_t count;
  double x[Jacobi::most], p[Jacobi::most][Jacobi::most], measure[Jacobi::most];
};

/// That of `wanted` nodes, or of fewer where there are fewer degrees.
NodeRule gauss(const Jacobi& jacobi, std::size_t wanted);

}  // namespace asperity
