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
  const std::size_t n = level.grid->size();
  const auto take = [&](const RoughnessCells& cells, const Rubber& rubber, std::span<double> outside,
                        std::size_t harmonics) {
    const std::size_t points = cells.wavenumber().size();
    for (auto* const row : {&frequency_, &i1_, &i2_}) row->resize(points);
    for (auto* const row : {&loss_, &square_}) row->resize(harmonics * points);
    for (std::size_t i = 0; i < points; ++i) frequency_[i] = velocity_ * cells.wavenumber()[i];
    return angular_integrals(rubber, frequency_, i1_, i2_, outside, loss_, square_);
  };
  if (first && known_in_part_) {
    const RoughnessCells& cells = pieces.coarse_cells();
    outside_at_points_.resize(cells.wavenumber().size());
    level.i1_outside.clear();
    if (take(cells, waves_.rubber(), outside_at_points_, 0)) {
      level.i1_outside.resize(n + RoughnessCells::excess);
      cells.at_nodes(outside_at_points_.data(), i1_.data(), level.i1_outside.data(), level.i1.data());
    }
  }
  const RoughnessCells& cells = pieces.cells();  // of the same points at each level
  if (first) (void)take(cells, *analytic_, {}, needed_.count);
  cells.at_nodes(i1_.data(), i2_.data(), level.i1.data(), level.i2.data());
  const std::size_t rows = needed_.count, points = frequency_.size();
  if (first && !level.factors.empty()) {
    of_loss_.resize((rows + 1) * points);
    loss_part(*analytic_, frequency_, of_loss_);
  }
  at_nodes_.resize(level.i2.size());
  if (!level.factors.empty()) cells.at_nodes(of_loss_.data(), of_loss_.data(), at_nodes_.data(), at_nodes_.data());
  if (!level.mean_i1.empty()) {
    std::copy_n(level.i1.begin(), n, level.mean_i1.begin());
    std::copy_n(level.i2.begin(), n, level.mean_i2.begin());
    soften(level.factors, at_nodes_, level.mean_i1, level.mean_i2, {});
  }
  if (rows > 0) add_directions_of_pieces(level, level.factors.empty() ? std::span<double>() : at_nodes_);
  if (rows == 0) level.about.clear();
  if (level.factors.empty()) return;
  soften(level.factors, at_nodes_, level.i1, level.i2,
         first ? std::span<double>(level.i1_outside) : std::span<double>());
  for (std::size_t i = 0; rows > 0 && i < n; ++i) level.across[i] *= level.factors[i].loss;
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
