// The choice of the grid: the error of polynomials through I2 and R on a coarse one tells which finer one will do.
#include "contact/solver/ring_solvers.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

RingSolver& RingSolvers::at_velocity(std::size_t grid) {
  std::unique_ptr<RingSolver>& solver = solvers_[grid];
  if (!solver)
    solver = std::make_unique<RingSolver>(table_.surface().rings(table_, grid), rubber_, poisson_ratio_, rtol_);
  if (solver->velocity() != velocity_) solver->start(velocity_);
  return *solver;
}

/// The finest where none will do for certain.
std::size_t RingSolvers::first_grid() {
  constexpr double gain = 16;  // by half the length of cells, at the knots of a master curve
  constexpr std::size_t finest = TableSurface::grids - 1;
  std::size_t grid = 0;
  while (grid < finest) {
    const double excess = at_velocity(grid).excess();
    if (excess <= 1) break;
    const double steps = std::ceil(std::log(excess) / std::log(gain));
    grid = std::min(finest, grid + static_cast<std::size_t>(std::clamp(steps, 1.0, static_cast<double>(finest))));
  }
  return grid;
}

bool RingSolvers::solve(double pressure, double velocity, double shift, const ContactIntegral* contact) {
  if (velocity != velocity_) {
    velocity_ = velocity;
    grid_ = first_grid();
  }
  first_ = nullptr;
  for (std::size_t grid = grid_; grid < TableSurface::grids; ++grid) {
    RingSolver& solver = at_velocity(grid);
    const RingSolver::Outcome outcome = solver.solve(pressure, shift, contact);
    if (!first_ && outcome != RingSolver::Outcome::no_g) first_ = &solver;
    last_ = &solver;
    if (outcome == RingSolver::Outcome::solved) return true;
    if (outcome == RingSolver::Outcome::not_converged) return false;
  }
  return false;
}

}  // namespace asperity
