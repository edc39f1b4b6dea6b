// Two levels of pieces of rings (contact/grid/roughness_pieces.hpp) solve a point by one theory (contact/theory).
#include "contact/solver/level_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conditions.hpp"
#include "rubber/loss_part.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double for_edges = 0.02;  // of the tolerance
/// The error of the finer level, by what it changes: it should be a sixteenth. Other sums tell the error where mu and
/// the area agree by chance. What pieces leave out of rough rings differs from level to level without a rule.
constexpr double of_change = 0.75, of_rest = 2;
/// Of the tolerance: two levels may agree by chance, and one point in a hundred was off by half of the tolerance where
/// they did.
constexpr double least_error = 0.75;
/// What the rule of two nodes misses where a function begins to rise as some power of ln q, over the root of the sum of
/// squares of its fourth differences: at most this for powers from 1 on, wherever it begins and where pieces beside
/// each other differ in length by two. That of I1 and I2 at a knot of a measured modulus is 5/2, and less at knots that
/// nearly meet.
constexpr double of_difference = 0.16;
constexpr double passed_on = 2;  // |d ln R / d ln G| at most, R that of PartialContact or P S

double difference(double a, double b) { return b == 0 ? 0 : std::fabs(a / b - 1); }

}  // namespace

bool LevelSolver::serves(const Spectrum& spectrum, const ContactModel& model) {
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && table->wavenumber().size() >= least_rows && model.method == Method::gauss && model.rtol >= least_rtol;
}

LevelSolver::LevelSolver(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model)
    : spectrum_(spectrum),
      table_(std::get<TabulatedSpectrum>(spectrum)),
      rubber_(rubber),
      model_(model),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      with_edges_(std::holds_alternative<PartialContact>(model.correction)),
      waves_(rubber, model, table_.surface().segments(table_)),
      edges_of_(waves_, for_edges * model.rtol) {
  if (const auto* const series = std::get_if<PronySeries>(&rubber)) {
    known_in_part_ = series->fitted_range().has_value();
    analytic_.emplace(PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times()));
  }
}

/// I1 and I2 at the nodes: by polynomials where they are analytic, which takes far fewer values.
void LevelSolver::take_moduli(Level& level, double velocity) {
  const RoughnessPieces::Nodes& nodes = level.pieces->nodes();
  const std::size_t n = nodes.weight.size();
  const bool first = &level == &levels_.front();
  if (!analytic_) {
    for (std::size_t i = 0; i < n; ++i) level.frequency[i] = velocity * nodes.wavenumber[i];
    const bool asked = first || any_outside_;
    if (asked) level.i1_outside.resize(n);
    const bool any = waves_(level.frequency, level.factors, {level.i1.data(), n}, {level.i2.data(), n},
                            asked ? std::span<double>(level.i1_outside) : std::span<double>());
    if (first) any_outside_ = any;
    return;
  }
  const auto take = [&](const RoughnessCells& cells, const Rubber& rubber, std::span<double> outside) {
    const std::size_t points = cells.wavenumber().size();
    for (auto* const row : {&frequency_, &i1_, &i2_}) row->resize(points);
    for (std::size_t i = 0; i < points; ++i) frequency_[i] = velocity * cells.wavenumber()[i];
    return angular_integrals(rubber, frequency_, i1_, i2_, outside);
  };
  if (first && known_in_part_) {
    const RoughnessCells& cells = level.pieces->coarse_cells();
    outside_at_points_.resize(cells.wavenumber().size());
    any_outside_ = take(cells, rubber_, outside_at_points_);
    if (any_outside_) {
      level.i1_outside.resize(n + RoughnessCells::excess);
      cells.at_nodes(outside_at_points_.data(), i1_.data(), level.i1_outside.data(), level.i1.data());
    }
  }
  const RoughnessCells& cells = level.pieces->cells();  // of the same points at each level
  if (first) (void)take(cells, *analytic_, {});
  cells.at_nodes(i1_.data(), i2_.data(), level.i1.data(), level.i2.data());
  if (level.factors.empty()) return;
  if (first) {
    of_loss_.resize(frequency_.size());
    loss_part(*analytic_, frequency_, of_loss_);
  }
  at_nodes_.resize(level.i2.size());
  cells.at_nodes(of_loss_.data(), of_loss_.data(), at_nodes_.data(), at_nodes_.data());
  soften(level.factors, at_nodes_, level.i1, level.i2,
         first && any_outside_ ? std::span<double>(level.i1_outside) : std::span<double>());
}

LevelSolver::Level& LevelSolver::at_velocity(std::size_t number, double velocity) {
  Level& level = levels_[number];
  if (level.velocity == velocity) return level;
  if (!level.pieces) {
    const std::span<const Segment> surface = table_.surface().segments(table_);
    if (!waves_.kinks().empty()) level.cut = std::make_unique<RoughnessPieces>(surface, number, waves_.kinks());
    level.pieces = level.cut ? level.cut.get() : &roughness_pieces(table_, number);
    level.grid = std::make_unique<ContactGrid>(surface, ContactGridOptions{.poisson_ratio = model_.poisson_ratio,
                                                                           .beyond_end = with_edges_,
                                                                           .edge_nodes = false,
                                                                           .pieces = level.pieces});
    if (number > 0) take_common_ends(level, levels_[number - 1]);
    level.theory = contact_theory(model_, spectrum_, surface, *level.grid);
    const std::size_t n = level.pieces->nodes().weight.size();
    level.factors = waves_.factors(*level.grid);
    if (!level.factors.empty()) level.factors.resize(n);
    level.frequency.resize(n);
    for (auto* const row : {&level.i1, &level.i2}) row->resize(n + RoughnessCells::excess);
  }
  level.velocity = velocity;
  take_moduli(level, velocity);
  const std::size_t n = level.frequency.size();
  level.theory->take({{level.i1.data(), n}, {level.i2.data(), n}});
  if (with_edges_) level.theory->take_edges(edges_);
  return level;
}

/// Some of the pieces up to whose ends m is the same on both levels.
void LevelSolver::take_common_ends(Level& fine, const Level& coarse) {
  constexpr double same = 1e-9;
  constexpr Index between = 16;  // nodes of the coarse one
  const VectorXd &weight = coarse.grid->weight(), &finer = fine.grid->weight();
  double place = 0, at = 0;
  Index k = 0;
  for (Index i = 0; i + 1 < weight.size(); i += 2) {
    place += weight[i] + weight[i + 1];
    for (; k + 1 < finer.size() && at < place * (1 - same); k += 2) at += finer[k] + finer[k + 1];
    const Index last = fine.common_ends.empty() ? 0 : fine.common_ends.back()[0];
    if (at <= place * (1 + same) && i + 2 - last >= between) fine.common_ends.push_back({i + 2, k});
  }
}

/// How far two levels are apart at most in the part of mu_H up to ends of pieces that both have, at the load: errors
/// that cancel in the whole do not all the way.
double LevelSolver::apart(const Level& coarse, const Level& fine) {
  const VectorXd &of_coarse = coarse.theory->part(), &of_fine = fine.theory->part();
  if (of_coarse.size() == 0 || of_fine.size() == 0) return 0;
  double most = 0, off = 0;
  Index i = 0, k = 0;
  for (const auto& [end, fine_end] : fine.common_ends) {
    off += of_fine.segment(k, fine_end - k).sum() - of_coarse.segment(i, end - i).sum();
    i = end;
    k = fine_end;
    most = std::fmax(most, std::fabs(off));
  }
  return most;
}

/// What the rule of two nodes misses beside knots of a measured modulus, of mu_H or the area, relative: fourth
/// differences of I1 and I2 at the nodes tell it, whether two levels miss a knot alike or not. An error of G passes on
/// to all behind it.
double LevelSolver::beside_knots(const Level& level, const ContactSums& sums) {
  const auto& difference = level.pieces->nodes().difference;
  const std::size_t n = level.frequency.size();
  const double factor = of_difference * stiffening_ * stiffening_ / 8, by_kappa = 1 / sums.slope;
  of_i1_.resize(n);
  of_i2_.resize(n);
  for (std::size_t i = 2; i + 2 < n; ++i) {
    double of_i1 = 0, of_i2 = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      of_i1 += difference[k][i] * level.i1[i + k - 2];
      of_i2 += difference[k][i] * level.i2[i + k - 2];
    }
    of_i1_[i] = std::fabs(factor * of_i1);
    of_i2_[i] = std::fabs(factor * of_i2);
  }
  const double kappa_on_mu = std::fabs(sums.friction_slope) * by_kappa,
               kappa_on_area = std::fabs(sums.share_slope) * by_kappa;
  const double friction_share = sums.friction > 0 ? 1 / sums.friction : 0, variance_share = 1 / sums.variance;
  const double g1 = level.theory->unit_g();
  const double *const stress = level.theory->stress().data(), *const g = level.theory->node_g().data(),
                      *const weight = level.grid->weight().data(), *const ratio = level.theory->ratio().data();
  double variance_behind = 1 / g1, friction_behind = 0, of_mu = 0, of_area = 0;
  for (std::size_t i = n - 2; i-- > 2;) {
    const double of_i1 = of_i1_[i], of_i2 = of_i2_[i], r = stress[i];
    const double by_g = passed_on * weight[i] * level.i2[i] * r / (g[i] > 1e-300 ? g[i] : 1e-300);
    variance_behind += by_g * variance_share;
    friction_behind += by_g * ratio[i] * friction_share;
    const double on_variance = of_i2 * (r * variance_share + variance_behind);
    const double on_mu = of_i1 * r * friction_share + of_i2 * friction_behind + kappa_on_mu * on_variance;
    const double on_area = kappa_on_area * on_variance + of_i2 / (2 * g1);
    of_mu += on_mu * on_mu;
    of_area += on_area * on_area;
  }
  return std::sqrt(std::fmax(of_mu, of_area));
}

/// The share of friction from frequencies outside of the measured range.
double LevelSolver::outside_share(const Level& level, const ContactSums& sums) const {
  double sum = with_edges_ ? sums.edges * level.grid->beyond().end->window * edges_.i1_outside : 0;
  if (any_outside_) {
    const VectorXd& stress = level.theory->stress();
    for (Index i = 0; i < stress.size(); ++i)
      sum += level.grid->weight()[i] * stress[i] * level.i1_outside[static_cast<std::size_t>(i)];
  }
  return sums.friction > 0 ? sum / sums.friction : 0;
}

double LevelSolver::share_beyond(double wavenumber) const {
  if (!(sums_.friction > 0)) return 0;
  const ContactGrid& grid = *solved_->grid;
  const VectorXd& stress = solved_->theory->stress();
  double sum = 0;
  if (with_edges_ && grid.beyond().end->wavenumber > wavenumber)
    sum = sums_.edges * grid.beyond().end->window * edges_.i1;
  for (Index i = 0; i < stress.size(); ++i)
    if (const auto at = static_cast<std::size_t>(i); grid.wavenumber()[at] > wavenumber)
      sum += grid.weight()[i] * stress[i] * solved_->i1[at];
  return std::fmin(1, sum / sums_.friction);
}

bool LevelSolver::solve(double pressure, double velocity, double shift) {
  const double root = 1 / (pressure * shift), scale = root * root, mu_factor = 4 * pressure / stiffening_ * scale;
  if (with_edges_ && velocity != velocity_) {
    const double q_e = roughness_pieces(table_, 0).window().end();
    edges_ = edges_of_(velocity, q_e, 1, partial_contact::tail_end);
  }
  velocity_ = velocity;
  const Level* coarse = &at_velocity(0, velocity);
  g_ = coarse->theory->unit_g() * scale;
  if (g_ == 0) return false;
  check_g(g_, pressure);
  ContactSums before = coarse->theory->solve(scale, model_.rtol, usual_kappa);
  const double outside = outside_share(*coarse, before);
  const double of_edges =
      with_edges_ ? std::fmax(edges_.i2_error / edges_.i2, edges_.i1 > 0 ? edges_.i1_error / edges_.i1 : 0) : 0;
  const bool knots = std::holds_alternative<MasterCurve>(rubber_) || waves_.softening();
  for (std::size_t number = 1; number < RoughnessPieces::levels; ++number) {
    const Level& level = at_velocity(number, velocity);
    const ContactSums& now = level.theory->solve(scale, model_.rtol, before.kappa);
    const double running = apart(*coarse, level), whole = now.friction * scale;
    const double change =
        std::max({difference(now.friction, before.friction), difference(now.share, before.share),
                  difference(level.theory->unit_g(), coarse->theory->unit_g()), difference(now.kappa, before.kappa),
                  std::fabs(now.slope - before.slope), std::fabs(now.friction_slope - before.friction_slope),
                  whole > 0 ? running / whole : 0});
    double error = of_change * change;
    if (knots && error <= model_.rtol) error = std::fmax(error, beside_knots(level, now));
    error += of_rest * RoughnessPieces::roughest(number) + of_edges;
    before = now;
    coarse = &level;
    if (!(error <= 0.85 * model_.rtol)) continue;
    sums_ = now;
    solved_ = &level;
    g_ = level.theory->unit_g() * scale;
    error_ = std::fmax(error, least_error * model_.rtol);
    const double share = analytic_ ? outside : outside_share(level, now);
    hysteresis_ = {mu_factor * now.friction, mu_factor * now.friction * error_, mu_factor * now.friction * share};
    return true;
  }
  return false;
}

}  // namespace asperity
