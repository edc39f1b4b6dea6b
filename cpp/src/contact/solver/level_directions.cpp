// Levels whose rings have directions (contact/grid/directions.hpp): their harmonics, and the force across.
#include <algorithm>
#include <cmath>

#include "contact/solver/level_solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

/// How many harmonics matter at the velocity.
void LevelSolver::take_harmonics() {
  constexpr double least = 0.02;  // of the tolerance
  const double band = surface_.back().b, end = window_ ? window_->end() * partial_contact::tail_end : band;
  FrequencyRange range{velocity_ * surface_.front().a, velocity_ * std::fmax(end, band)};
  if (known_) range.highest = std::clamp(range.highest, range.lowest, known_->highest);
  needed_ = (analytic_waves_ ? *analytic_waves_ : waves_).needed(range, least * model_.rtol);
}

/// `of_loss` has the part of I2 that E'' has, or nothing.
void LevelSolver::add_directions_of_pieces(Level& level, std::span<double> of_loss) {
  const RoughnessCells& cells = level.grid->pieces()->cells();
  const std::size_t rows = needed_.count, n = level.grid->size(), stride = n + RoughnessCells::excess,
                    points = frequency_.size();
  for (auto* const row : {&loss_at_nodes_, &square_at_nodes_}) row->resize(rows * stride);
  for (std::size_t m = 0; m < rows; ++m)
    cells.at_nodes(&loss_[m * points], &square_[m * points], &loss_at_nodes_[m * stride],
                   &square_at_nodes_[m * stride]);
  const std::span<double> i1{level.i1.data(), n};
  const bool outside = !level.i1_outside.empty();
  if (outside)  // as if it had the directions of all
    for (std::size_t i = 0; i < n; ++i) level.i1_outside[i] /= i1[i];
  add_directions(level.rings, {rows, stride, loss_at_nodes_, square_at_nodes_}, i1, level.across);
  const HarmonicRows squares{rows, stride, {}, square_at_nodes_};
  if (!level.about.empty()) {
    std::copy_n(level.i2.begin(), n, level.about.begin());
    add_directions(waves_.directions()->mean(), squares, {level.about.data(), n});
  }
  add_directions(level.rings, squares, {level.i2.data(), n});
  if (outside)
    for (std::size_t i = 0; i < n; ++i) level.i1_outside[i] *= i1[i];
  for (std::size_t m = 0; m < rows && !of_loss.empty(); ++m)
    cells.at_nodes(&of_loss_[(m + 1) * points], &of_loss_[(m + 1) * points], &square_at_nodes_[m * stride],
                   &square_at_nodes_[m * stride]);
  if (of_loss.empty()) return;
  if (!level.about.empty()) {
    std::vector<double> about_loss(of_loss.begin(), of_loss.begin() + static_cast<std::ptrdiff_t>(n));
    add_directions(waves_.directions()->mean(), squares, about_loss);
    soften_square(level.factors, about_loss, level.about);
  }
  add_directions(level.rings, squares, of_loss.first(n));
}

void LevelSolver::check_directions(const Level& level) const {
  if (!rings_of_) return;
  const VectorXd& weight = level.grid->weight();
  if (Eigen::Map<const VectorXd>(level.i2.data(), static_cast<Index>(level.grid->band_size())).minCoeff() > 0) return;
  for (std::size_t i = 0; i < level.grid->band_size(); ++i)
    if (weight[static_cast<Index>(i)] > 0 && !(level.i2[i] > 0))
      throw InvalidInput(argument("spectrum") +
                         ": its harmonics at wavenumber = " + show(level.grid->wavenumber()[i], 6) +
                         " 1/m are those of no density that is positive in all directions" + must(", must have ") +
                         "fewer of them, or wider rings");
}

/// What harmonics that scatter from ring to ring miss of friction, relative: stress follows G, whose rings scatter too.
/// From piece to piece it has any sign, and on two levels alike it is.
double LevelSolver::scatter(const Level& level, const ContactSums& sums) const {
  if (!(sums.friction > 0)) return 0;
  const std::vector<double>& of_pieces = level.grid->pieces()->nodes().scatter;
  const double *const weight = level.grid->weight().data(), *const g = level.theory->node_g().data(),
                      *const i2 = level.i2.data(), *const i1 = level.mean_i1.data(),
                      *const loss = level.per_loss.data();
  double squares = 0;
  for (std::size_t c = 0; c < of_pieces.size(); ++c) {
    const std::size_t i = 2 * c, k = i + 1;
    const double rise = (weight[i] * i2[i] + weight[k] * i2[k]) / std::max(g[k], 1e-300),
                 off = (loss[i] * i1[i] + loss[k] * i1[k]) * rise * of_pieces[c];
    squares += off * off;
  }
  return std::sqrt(squares) / sums.friction;
}

double LevelSolver::across(Level& level, const ContactSums& sums) const {
  if (!rings_of_ || !(sums.friction > 0)) {
    level.sideways.resize(0);
    level.cell_across.resize(0);
    return 0;
  }
  const ContactGrid& grid = *level.grid;
  const bool by_stress = window_ && grid.pieces();
  const auto n = static_cast<Index>(by_stress ? grid.band_size() : grid.size());
  constexpr double least = 1e-300;  // where E'' is lost, no node has a part
  if (by_stress)
    level.per_loss = grid.weight().cwiseProduct(level.theory->stress());
  else
    level.per_loss =
        level.theory->part().head(n).array() / (scale_ * Eigen::ArrayXd::Map(level.i1.data(), n).max(least));
  level.sideways = level.per_loss.cwiseProduct(VectorXd::Map(level.across.data(), n));
  sum_cells(grid, level.sideways, level.cell_across);
  const double edges = by_stress ? sums.edges * grid.beyond().end->window * edges_.across : 0;
  return edges + level.cell_across.sum();
}

}  // namespace asperity
