// The temperature profile that keeps itself up.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>

#include "heat/march.hpp"

namespace asperity {

struct FixedPoint {
  Eigen::VectorXd theta;                        // at the grid's temperature points [K]
  Eigen::VectorXd residual;                     // F(theta) - theta
  double gain = 0;                              // eigenvalue of dF/dtheta of the largest size
  double mu_error = 0;                          // what the residual does to mu, at most
  double hysteresis_error = 0, area_error = 0;  // and to mu_H and A / A0
  int solutions = 1;                            // stable and unstable ones
};

/// The slopes of a pass, with which further ones step towards the fixed point.
struct Tangent {
  Eigen::MatrixXd jacobian;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;  // of 1 - dF/dtheta
  Eigen::RowVectorXd slope_of_mu;
  FlashMap::PartSlopes part_slopes;
  void take(FlashMap& map);
};

/// A solution of theta = F(theta): where there is one only, whose rise is about `only_rise` [K], by Newton's method
/// from `guess`, or from the profile of that rise; otherwise, or where that does not end or ends near others, the march
/// finds all. Tolerance relative to the largest rise. Leaves the map at the solution. NotConverged, or OutOfRange where
/// there is none up to the temperature that rubber stands.
FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const Eigen::VectorXd& guess,
                             std::optional<double> only_rise, Branch branch, double tolerance, Tangent& tangent);

/// The same on a finer grid from the solution of a coarser one, whose slopes do: `up` and `down` carry profiles from
/// the coarser grid to the finer one and back.
FixedPoint polish(FlashMap& map, const Eigen::VectorXd& theta, const Tangent& tangent, const Eigen::MatrixXd& up,
                  const Eigen::MatrixXd& down, double tolerance);

/// The eigenvalue of dF/dtheta of the largest size at the last pass, near which `tangent` was taken; to `tolerance`.
double gain_of(FlashMap& map, const Tangent& tangent, double tolerance);

}  // namespace asperity
