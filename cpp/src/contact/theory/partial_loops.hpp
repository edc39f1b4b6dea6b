// The loop over nodes that the root of PartialContact's rule takes, compiled for several vector units.
#pragma once

#include <cstddef>

#include "numerics/kernels.hpp"

namespace asperity {

/// A / rest and (d A / d ln G) / rest, rest = 1 / (1 + sqrt(G)), as polynomials in u = `steps` rest - i about each i.
struct ShareTable {
  static constexpr std::size_t steps = 128, terms = 8;
  using Powers = double[steps + 1][terms];
  Powers share, slope;
};

/// Rows of n numbers, n a multiple of `lanes`: G at unit load, g' likewise, the weight times dG, and I1 / I2.
struct PartialNodes {
  const double *g, *steepness, *weight, *ratio;
  std::size_t n;
};

/// int R dG and int (I1 / I2) R dG at unit load, and their slopes over ln kappa.
struct PartialSums {
  double variance = 0, variance_slope = 0, friction = 0, friction_slope = 0;
};

/// A and R of each node, and dR / dln G at its Z / A^2.
struct PartialColumns {
  double *share, *stress, *stress_slope;
};

/// At kappa times the scale of G, with Z = `obstacle` A^2 steepness and the slope of ln obstacle over ln kappa.
PartialSums partial_sums(const PartialNodes& nodes, double scale, double obstacle, double obstacle_slope,
                         const PartialColumns& result);

/// A of each G, as the loop takes it.
void contact_shares(const double* g, std::size_t n, double* share);

/// Of n numbers, n a multiple of `lanes`.
void eighth_roots(const double* of, std::size_t n, double* result);

}  // namespace asperity
