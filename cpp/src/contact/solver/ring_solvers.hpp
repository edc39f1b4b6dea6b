// Area and hysteresis on a measured spectrum, on a grid as fine as the rubber needs it.
#pragma once

#include <array>
#include <memory>

#include "contact/solver/ring_solver.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

class RingSolvers {
 public:
  /// Tables of fewer rows are quicker done one by one, and lesser tolerances not reached.
  static constexpr std::size_t least_rows = 16;
  static constexpr double least_rtol = 1e-7;

  RingSolvers(const TabulatedSpectrum& table, const Rubber& rubber, double poisson_ratio, double rtol)
      : table_(table), rubber_(rubber), poisson_ratio_(poisson_ratio), rtol_(rtol) {}

  /// Solves for G, and for mu_H where `contact` is given; one at the velocity of the point before is cheap. False where
  /// the tolerance is not reached for certain.
  [[nodiscard]] bool solve(double pressure, double velocity, double shift, const ContactIntegral* contact);

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return last_->hysteresis(); }
  /// G at the upper end of the spectrum and its relative error, where it is had: the same with mu_H and without.
  [[nodiscard]] bool has_g() const { return first_ != nullptr; }
  [[nodiscard]] double g() const { return first_->g(); }
  [[nodiscard]] double relative_error() const { return first_->relative_error(); }

 private:
  /// The solver on a grid, at the velocity of the point.
  RingSolver& at_velocity(std::size_t grid);
  [[nodiscard]] std::size_t first_grid();

  const TabulatedSpectrum& table_;
  const Rubber& rubber_;
  double poisson_ratio_, rtol_;
  double velocity_ = 0;
  std::size_t grid_ = 0;  // the coarsest on which G holds at the velocity
  std::array<std::unique_ptr<RingSolver>, TableSurface::grids> solvers_;
  const RingSolver *first_ = nullptr, *last_ = nullptr;  // of the point: where G holds, and where mu_H does
};

}  // namespace asperity
