// Two levels of pieces solve a point (contact/grid/roughness_pieces.hpp) by the rule of
// contact/theory/partial_contact_rule.hpp.
#include "contact/solver/partial_ring_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conditions.hpp"
#include "contact/theory/partial_contact_rule.hpp"

namespace asperity {

namespace {

constexpr double for_tail = 0.02;  // of the tolerance
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
constexpr double passed_on = 2;  // |d ln R / d ln G| at most

}  // namespace

PartialRingSolver::PartialRingSolver(const TabulatedSpectrum& table, std::span<const Segment> surface,
                                     const Rubber& rubber, const ContactModel& model)
    : table_(table),
      surface_(surface),
      rubber_(rubber),
      model_(model),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      end_(roughness_pieces(table, 0).window(), stiffening_ * stiffening_ / 8),
      tail_of_(rubber, for_tail * model.rtol) {
  if (const auto* const series = std::get_if<PronySeries>(&rubber)) {
    known_in_part_ = series->fitted_range().has_value();
    analytic_.emplace(PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times()));
  }
}

/// I1 and I2 at the nodes: by polynomials where they are analytic, which takes far fewer values.
void PartialRingSolver::take_moduli(Level& level, double velocity) {
  const RoughnessPieces::Nodes& nodes = level.pieces->nodes();
  const std::size_t n = nodes.weight.size();
  if (!analytic_) {
    for (std::size_t i = 0; i < n; ++i) level.frequency[i] = velocity * nodes.wavenumber[i];
    const bool tell = &level == &levels_.front();
    if (tell) i1_outside_.resize(n);
    const bool any = angular_integrals(rubber_, level.frequency, level.i1, level.i2,
                                       tell ? std::span<double>(i1_outside_) : std::span<double>());
    if (tell) any_outside_ = any;
    return;
  }
  const auto take = [&](const RoughnessCells& cells, const Rubber& rubber, std::span<double> outside) {
    const std::size_t points = cells.wavenumber().size();
    for (auto* const row : {&frequency_, &i1_, &i2_}) row->resize(points);
    for (std::size_t i = 0; i < points; ++i) frequency_[i] = velocity * cells.wavenumber()[i];
    return angular_integrals(rubber, frequency_, i1_, i2_, outside);
  };
  if (&level == &levels_.front() && known_in_part_) {
    const RoughnessCells& cells = level.pieces->coarse_cells();
    i1_outside_.resize(n);
    outside_at_points_.resize(cells.wavenumber().size());
    any_outside_ = take(cells, rubber_, outside_at_points_);
    if (any_outside_) cells.at_nodes(outside_at_points_, i1_outside_);
  }
  const RoughnessCells& cells = level.pieces->cells();  // of the same points at each level
  if (&level == &levels_.front()) (void)take(cells, *analytic_, {});
  cells.at_nodes(i1_, level.i1);
  cells.at_nodes(i2_, level.i2);
}

PartialRingSolver::Level& PartialRingSolver::at_velocity(std::size_t number, double velocity) {
  Level& level = levels_[number];
  if (level.velocity == velocity) return level;
  if (!level.pieces) {
    level.pieces = &roughness_pieces(table_, number);
    const std::size_t n = level.pieces->nodes().weight.size();
    for (auto* const row : {&level.frequency, &level.i1, &level.i2, &level.g, &level.steepness, &level.weight,
                            &level.ratio, &level.stress})
      row->resize(n);
  }
  level.velocity = velocity;
  take_moduli(level, velocity);
  const RoughnessPieces::Nodes& nodes = level.pieces->nodes();
  const std::size_t n = nodes.weight.size();
  const double factor = stiffening_ * stiffening_ / 8;
  double g = 0;
  for (std::size_t i = 0; i < n; i += 2) {
    const double a = factor * level.i2[i], b = factor * level.i2[i + 1];
    level.g[i] = std::fmax(g + nodes.of_first[i] * a + nodes.of_second[i] * b, 1e-300);
    level.g[i + 1] = std::fmax(g + nodes.of_first[i + 1] * a + nodes.of_second[i + 1] * b, 1e-300);
    level.weight[i] = nodes.weight[i] * a;
    level.weight[i + 1] = nodes.weight[i + 1] * b;
    level.steepness[i] = nodes.window[i] * a;
    level.steepness[i + 1] = nodes.window[i + 1] * b;
    g += level.weight[i] + level.weight[i + 1];
  }
  for (std::size_t i = 0; i < n; ++i) level.ratio[i] = level.i1[i] / level.i2[i];
  level.end.g = g;
  level.end.window = end_.window;
  level.end.band = end_.band(g, tail_.i2_at_end);
  level.end.tail = tail_;
  return level;
}

PartialRoot PartialRingSolver::root(Level& level, double scale, double start) const {
  const PartialNodes nodes{level.g.data(), level.steepness.data(), level.weight.data(), level.ratio.data(),
                           level.g.size()};
  return partial_root(nodes, level.end, scale, model_.rtol, start, level.stress.data());
}

/// What the rule of two nodes misses beside knots of a measured modulus, of mu_H or the area, relative: fourth
/// differences of I1 and I2 at the nodes tell it, whether two levels miss a knot alike or not. An error of G passes on
/// to all behind it.
double PartialRingSolver::beside_knots(const Level& level, const PartialRoot& root) const {
  const auto& difference = level.pieces->nodes().difference;
  const double factor = of_difference * stiffening_ * stiffening_ / 8, by_kappa = 1 / root.slope;
  const double kappa_on_mu = std::fabs(root.friction_slope) * by_kappa,
               kappa_on_area = std::fabs(root.share_slope) * by_kappa;
  const double friction_share = root.friction > 0 ? 1 / root.friction : 0, variance_share = 1 / root.variance;
  double variance_behind = 1 / level.end.g, friction_behind = 0, of_mu = 0, of_area = 0;
  for (std::size_t i = level.g.size() - 2; i-- > 2;) {
    double of_i1 = 0, of_i2 = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      of_i1 += difference[k][i] * level.i1[i + k - 2];
      of_i2 += difference[k][i] * level.i2[i + k - 2];
    }
    of_i1 = std::fabs(factor * of_i1);
    of_i2 = std::fabs(factor * of_i2);
    const double r = level.stress[i], by_g = passed_on * level.weight[i] * r / level.g[i];
    variance_behind += by_g * variance_share;
    friction_behind += by_g * level.ratio[i] * friction_share;
    const double on_variance = of_i2 * (r * variance_share + variance_behind);
    const double on_mu = of_i1 * r * friction_share + of_i2 * friction_behind + kappa_on_mu * on_variance;
    const double on_area = kappa_on_area * on_variance + of_i2 / (2 * level.end.g);
    of_mu += on_mu * on_mu;
    of_area += on_area * on_area;
  }
  return std::sqrt(std::fmax(of_mu, of_area));
}

/// The share of friction from frequencies outside of the measured range.
double PartialRingSolver::outside_share(const Level& level, const PartialRoot& root) const {
  double sum = root.edges * level.end.window * tail_.i1_outside;
  if (any_outside_)
    for (std::size_t i = 0; i < level.g.size(); ++i)
      sum += level.weight[i] * level.stress[i] * i1_outside_[i] / level.i2[i];
  return root.friction > 0 ? sum / root.friction : 0;
}

void PartialRingSolver::by_panels(double pressure, double velocity) {
  if (!panels_) panels_.emplace(surface_, rubber_, model_, std::span<const double>{});
  panels_->solve(pressure, velocity);
  take(*panels_);
}

void PartialRingSolver::solve(double pressure, double velocity) {
  if (velocity != velocity_) {
    velocity_ = velocity;
    tail_ = tail_of_(velocity * end_.wavenumber, 1, partial_contact::tail_end);
  }
  const double scale = 1 / pressure / pressure, mu_factor = 4 / (stiffening_ * pressure);
  const auto difference = [](double a, double b) { return b == 0 ? 0 : std::fabs(a / b - 1); };
  Level* coarse = &at_velocity(0, velocity);
  g1_ = coarse->end.g * scale;
  if (g1_ == 0) return by_panels(pressure, velocity);
  check_g(g1_, pressure);
  PartialRoot before = root(*coarse, scale, usual_kappa);
  const double outside = outside_share(*coarse, before);
  const double of_tail = std::fmax(tail_.i2_error / tail_.i2, tail_.i1 > 0 ? tail_.i1_error / tail_.i1 : 0);
  const bool knots = std::holds_alternative<MasterCurve>(rubber_);
  for (std::size_t number = 1; number < RoughnessPieces::levels; ++number) {
    Level& level = at_velocity(number, velocity);
    root_ = root(level, scale, before.kappa);
    const double change =
        std::max({difference(root_.friction, before.friction), difference(root_.share, before.share),
                  difference(level.end.g, coarse->end.g), difference(root_.kappa, before.kappa),
                  std::fabs(root_.slope - before.slope), std::fabs(root_.friction_slope - before.friction_slope)});
    double error = of_change * change;
    if (knots && error <= model_.rtol) error = std::fmax(error, beside_knots(level, root_));
    error += of_rest * RoughnessPieces::roughest(number) + of_tail;
    before = root_;
    coarse = &level;
    if (!(error <= 0.85 * model_.rtol)) continue;
    g1_ = level.end.g * scale;
    area_error_ = std::fmax(error, least_error * model_.rtol);
    hysteresis_ = {mu_factor * root_.friction, mu_factor * root_.friction * area_error_,
                   mu_factor * root_.friction * outside};
    return;
  }
  by_panels(pressure, velocity);
}

}  // namespace asperity
