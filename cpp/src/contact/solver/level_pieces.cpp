// Levels of pieces of rings (contact/grid/roughness_pieces.hpp): their I1 and I2, and what their rule misses at knots.
#include <algorithm>
#include <cmath>

#include "contact/solver/level_solver.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

namespace {

/// What the rule of two nodes misses where a function begins to rise as some power of ln q, over the root of the sum of
/// squares of its fourth differences: at most this for powers from 1 on, wherever it begins and where pieces beside
/// each other differ in length by two. That of I1 and I2 at a knot of a measured modulus is 5/2, and less at knots that
/// nearly meet.
constexpr double of_difference = 0.16;
constexpr double passed_on = 2;  // |d ln R / d ln G| at most, R that of PartialContact or P S

}  // namespace

/// By polynomials, which takes far fewer values where I1 and I2 are analytic.
void LevelSolver::take_moduli_of_pieces(Level& level, bool first) {
  const RoughnessPieces& pieces = *level.grid->pieces();
  const std::size_t n = level.grid->size(), stride = n + RoughnessCells::excess;
  const bool parted = !level.factors.empty();
  const auto take = [&](const RoughnessCells& cells, const Rubber& rubber, std::span<double> outside,
                        std::size_t harmonics) {
    const std::size_t points = cells.wavenumber().size();
    at_points_.resize(harmonics, points, parted);
    frequency_.resize(points);
    for (std::size_t i = 0; i < points; ++i) frequency_[i] = velocity_ * cells.wavenumber()[i];
    const std::span loss(at_points_.loss), square(at_points_.square);
    return angular_integrals(rubber, frequency_, loss.first(points), square.first(points), outside,
                             loss.subspan(points), square.subspan(points));
  };
  if (first && known_in_part_) {
    const RoughnessCells& cells = pieces.coarse_cells();
    outside_at_points_.resize(cells.wavenumber().size());
    level.i1_outside.clear();
    if (take(cells, waves_.rubber(), outside_at_points_, 0)) {
      level.i1_outside.resize(stride);
      cells.at_nodes(outside_at_points_.data(), at_points_.loss.data(), level.i1_outside.data(), level.i1.data());
    }
  }
  const RoughnessCells& cells = pieces.cells();  // of the same points at each level
  if (first) {
    (void)take(cells, *analytic_, {}, needed_.count);
    if (parted) loss_part(*analytic_, frequency_, at_points_.of_loss);
  }
  if (!rings_of_ && !parted) {
    cells.at_nodes(at_points_.loss.data(), at_points_.square.data(), level.i1.data(), level.i2.data());
    return;
  }
  level.rows.resize(needed_.count, stride, parted);
  for (std::size_t m = 0; m <= needed_.count; ++m) {
    const std::size_t from = m * at_points_.stride, to = m * stride;
    cells.at_nodes(&at_points_.loss[from], &at_points_.square[from], &level.rows.loss[to], &level.rows.square[to]);
    if (!parted) continue;
    const double* const of_loss = &at_points_.of_loss[from];
    cells.at_nodes(of_loss, of_loss, &level.rows.of_loss[to], &level.rows.of_loss[to]);
  }
  waves_.take(level.rows, level.factors, {level.i1.data(), n}, {level.i2.data(), n},
              std::span(level.i1_outside).first(std::min(n, level.i1_outside.size())), directed(level));
}

/// What the rule of two nodes misses beside knots of a measured modulus, of mu_H or the area, relative: fourth
/// differences of I1 and I2 at the nodes tell it, whether two levels miss a knot alike or not. An error of G passes on
/// to all behind it. A knot is felt from waves along the velocity on, so that a ring has as much of it as C there is
/// above its mean.
double LevelSolver::beside_knots(const Level& level, const ContactSums& sums) {
  const auto& difference = level.grid->pieces()->nodes().difference;
  const std::size_t n = level.grid->size();
  const double factor = of_difference * stiffening_ * stiffening_ / 8, by_kappa = 1 / sums.slope;
  for (auto* const row : {&of_i1_, &of_i2_, &at_nodes_}) row->resize(n);
  const auto differences = [&](const std::vector<double>& of, std::vector<double>& result) {
    const double *const a = difference[0].data(), *const b = difference[1].data(), *const c = difference[2].data(),
                        *const d = difference[3].data(), *const e = difference[4].data(), *const f = of.data();
    double* const to = result.data();
    for (std::size_t i = 2; i + 2 < n; ++i)
      to[i] =
          factor * std::fabs((a[i] * f[i - 2] + b[i] * f[i - 1]) + c[i] * f[i] + (d[i] * f[i + 1] + e[i] * f[i + 2]));
    for (std::size_t i = 2; rings_of_ && i + 2 < n; ++i) to[i] *= at_nodes_[i];
  };
  if (rings_of_) level.rings.most(needed_.count, at_nodes_);
  differences(rings_of_ ? level.mean_i1 : level.i1, of_i1_);
  differences(rings_of_ ? level.mean_i2 : level.i2, of_i2_);
  const double kappa_on_mu = std::fabs(sums.friction_slope) * by_kappa,
               kappa_on_area = std::fabs(sums.share_slope) * by_kappa;
  const double friction_share = sums.friction > 0 ? 1 / sums.friction : 0, variance_share = 1 / sums.variance;
  const double g1 = level.theory->unit_g(), per_area = 1 / (2 * g1);
  const double *const stress = level.theory->stress().data(), *const g = level.theory->node_g().data(),
                      *const weight = level.grid->weight().data(), *const ratio = level.theory->ratio().data();
  // what an error of G at a node does to the variance and to friction there
  double *const by_i1 = of_i1_.data(), *const by_i2 = of_i2_.data(), *const by_g = at_nodes_.data();
  for (std::size_t i = 2; i + 2 < n; ++i)
    by_g[i] = passed_on * weight[i] * level.i2[i] * stress[i] / std::max(g[i], 1e-300);
  double variance_behind = 1 / g1, friction_behind = 0, of_mu = 0, of_area = 0;
  for (std::size_t i = n - 2; i-- > 2;) {
    variance_behind += by_g[i] * variance_share;
    friction_behind += by_g[i] * ratio[i] * friction_share;
    const double on_variance = by_i2[i] * (stress[i] * variance_share + variance_behind);
    const double on_mu = by_i1[i] * stress[i] * friction_share + by_i2[i] * friction_behind + kappa_on_mu * on_variance;
    const double on_area = kappa_on_area * on_variance + by_i2[i] * per_area;
    of_mu += on_mu * on_mu;
    of_area += on_area * on_area;
  }
  return std::sqrt(std::fmax(of_mu, of_area));
}

}  // namespace asperity
