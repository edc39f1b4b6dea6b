// Friction with its heat by GSL's adaptive rules, as a check of the grids.
#pragma once

#include "contact/theory/s_factor.hpp"
#include "heat/flash_solver.hpp"

namespace asperity {

/// From the solution on grids to that of GSL's integrals: the friction, the contact and the heat that every temperature
/// point feels are integrated anew, at temperatures that are moved until these keep themselves up.
class GslHeat {
 public:
  explicit GslHeat(const HeatScene& scene);
  /// `found` on the grids of `panels`, of which only the slopes of a Newton step are taken. NotConverged where the
  /// temperatures do not settle.
  HotPoint operator()(const HeatPoint& point, const HotPoint& found, FlashSolver& panels);

 private:
  struct Pass {
    HotPoint at;
    Eigen::VectorXd rise;  // at the temperature points [K]
  };
  [[nodiscard]] Pass pass(const HeatPoint& point, const HeatGrid& grid, const Eigen::VectorXd& theta);

  const HeatScene& scene_;
  std::optional<SFunction> factor_;
  AreaG area_g_;
};

}  // namespace asperity
