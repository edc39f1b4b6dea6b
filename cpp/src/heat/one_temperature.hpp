// One temperature for all roughness: what keeps itself up as the mean rise over the hysteresis.
#pragma once

#include "heat/flash_solver.hpp"

namespace asperity {

/// The rise of one temperature at a point.
struct OneRise {
  double rise = 0, error = 0;  // [K]
  double slope_of_mu = 0;      // d mu / d rise [1/K]
  double macro_area = 1, gain = 0;
  int branches = 1;
};

/// Solves rise = sum_j theta(q_j) dmu_j / mu_H, theta the rise that T0 + rise at all q would make: on one grid, and for
/// its error on the next finer one.
class OneTemperatureSolver {
 public:
  OneTemperatureSolver(const HeatScene& scene, Branch branch)
      : scene_(scene), branch_(branch), passes_(scene, branch) {}
  /// To an error of mu below its relative tolerance. NotConverged, or OutOfRange above what rubber stands.
  OneRise operator()(const HeatPoint& point);
  void forget() { before_ = 0; }

 private:
  const HeatScene& scene_;
  Branch branch_;
  FlashSolver passes_;  // which has the grids
  double before_ = 0;   // rise of the point before [K]
};

}  // namespace asperity
