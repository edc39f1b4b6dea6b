// The temperature profile that keeps itself up.
#pragma once

#include <Eigen/Core>

#include "heat/flash_map.hpp"

namespace asperity {

struct FixedPoint {
  Eigen::VectorXd theta;     // at the grid's temperature points [K]
  Eigen::VectorXd residual;  // F(theta) - theta
  double gain = 0;           // eigenvalue of dF/dtheta of the largest size
  double mu_error = 0;       // what the residual does to mu
  int solutions = 1;         // stable and unstable ones
};

/// A solution of theta = F(theta), from `guess` by Newton's method where heat takes from itself, that is where the cold
/// eigenvalue is not positive, and there is one. Otherwise theta = eps F(theta) is followed along theta(q1), which
/// finds all crossings of eps = 1. Tolerance relative to the largest rise. NotConverged, or OutOfRange where there is
/// none up to the temperature that rubber stands.
FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const Eigen::VectorXd& guess, Branch branch,
                             double tolerance);

/// The same from a profile that is a solution but for the discretisation.
FixedPoint polish(FlashMap& map, const Eigen::VectorXd& theta, double tolerance);

/// Rubber does not stand more [K].
inline constexpr double highest_rubber_temperature = 700;

}  // namespace asperity
