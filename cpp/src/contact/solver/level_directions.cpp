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

Directed LevelSolver::directed(Level& level) {
  if (!rings_of_) return {};
  const auto room = [n = level.grid->size()](std::vector<double>& row) {
    return std::span(row).first(std::min(n, row.size()));
  };
  Directed result{&level.rings, needed_.count, &level.rows, room(level.across), room(level.about)};
  result.mean = {level.mean_i1, level.mean_i2};
  return result;
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

double LevelSolver::across(Level& level, const ContactSums& sums) const {
  if (!rings_of_ || !(sums.friction > 0)) {
    level.sideways.resize(0);
    level.cell_across.resize(0);
    return 0;
  }
  using Row = Eigen::Map<const Eigen::ArrayXd>;
  const ContactGrid& grid = *level.grid;
  const bool by_stress = window_ && grid.pieces();
  const auto n = static_cast<Index>(by_stress ? grid.band_size() : grid.size());
  constexpr double least = 1e-300;  // where E'' is lost, no node has a part
  if (by_stress)
    level.per_loss = grid.weight().cwiseProduct(level.theory->stress());
  else
    level.per_loss = level.theory->part().head(n).array() / (scale_ * Row(level.i1.data(), n).max(least));
  level.sideways = level.per_loss.array() * Row(level.across.data(), n);
  sum_cells(grid, level.sideways, level.cell_across);
  const double edges = by_stress ? sums.edges * grid.beyond().end->window * edges_.across : 0;
  return edges + level.cell_across.sum();
}

/// The sum over the nodes of a piece has of harmonics a straight line each. Beside it, to first order in a and with f =
/// I1 / I2, int f R dG has I2^2 df/da dR/dG int a l_k (m - m_k) dm at each node, as G rises with what scatters in m;
/// and as a bows beside the line, which half of the slope over ln q from a node to the other makes up for. What steers
/// the force across of PartialContact is left to the next order.
double LevelSolver::add_rests(Level& level, ContactSums& sums) const {
  level.next_order = 0;
  if (level.cell_across.size() == 0) return 0;  // there is no friction
  const Index pieces = std::ssize(level.grid->cells());
  if (level.rests.count == 0) {
    level.rests = waves_.directions()->rests(*level.grid);
    const Rings& rings = level.rings;
    level.uneven.assign(level.grid->size(), 0.0);
    for (std::size_t m = 0; m < rings.count; ++m)
      for (std::size_t i = 0; i < rings.waves; ++i)
        level.uneven[i] +=
            2 * (std::fabs(rings.along[m * rings.waves + i]) + std::fabs(rings.across[m * rings.waves + i]));
  }
  for (auto* const row : {&level.rest_i1, &level.rest_i2, &level.rest_across}) row->resize(level.grid->size());
  take_rings(level.rows, level.factors, level.rests, false, {level.rest_i1, level.rest_i2, level.rest_across});
  const VectorXd& slope = level.theory->stress_slopes();
  const bool parted = level.cell_part.size() > 0;
  double of_friction = 0, beside = 0, squares = 0, squares_beside = 0;
  for (Index c = 0; c < pieces; ++c) {
    const auto i = static_cast<std::size_t>(2 * c), k = i + 1;
    const double at_i = slope[2 * c], at_k = slope[2 * c + 1];
    if (at_i == 0 && at_k == 0) continue;
    // half way from a node to the middle of its piece, `rest` of which is at the nodes
    const auto sum = [&](const std::vector<double>& of, const std::vector<double>& rest) {
      const double a = at_i * of[i], b = at_k * of[k];
      return (0.75 * a + 0.25 * b) * rest[i] + (0.25 * a + 0.75 * b) * rest[k];
    };
    const double here = sum(level.i2, level.rest_i1) - sum(level.i1, level.rest_i2),
                 across = sum(level.i2, level.rest_across) - sum(level.across, level.rest_i2);
    if (parted) level.cell_part[c] += scale_ * here;
    level.cell_across[c] += across;
    of_friction += here;
    beside += across;
    const double next = std::fmin(1, std::fmax(level.uneven[i], level.uneven[k]));  // order in harmonics
    squares += here * here * next * next;
    squares_beside += across * across * next * next;
  }
  sums.friction += of_friction;
  level.next_order = std::sqrt(std::fmax(squares, squares_beside));
  return beside;
}

double LevelSolver::left_out(const Level& level) const {
  const std::vector<double>& rest = level.grid->pieces()->nodes().rest_size;
  const double *const weight = level.grid->weight().data(), *const g = level.theory->node_g().data(),
                      *const i2 = level.i2.data(), *const i1 = level.i1.data(), *const loss = level.per_loss.data();
  double squares = 0;
  for (std::size_t c = 0; c < rest.size(); ++c) {
    const std::size_t i = 2 * c, k = i + 1;
    const double rise = (weight[i] * i2[i] + weight[k] * i2[k]) / std::max(g[k], 1e-300),
                 off = (loss[i] * i1[i] + loss[k] * i1[k]) * rise * rest[c];
    squares += off * off;
  }
  return std::sqrt(squares);
}

}  // namespace asperity
