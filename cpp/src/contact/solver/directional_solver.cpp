// The plane sums of a directional spectrum: Eqs 7 and 22 with the harmonics of rings and rubber in the place of I1 and
// I2. B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/solver/directional_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conditions.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "rubber/unlimited_rubber.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The error of the finer level, by what it changes: it should be a sixteenth where harmonics are smooth, and a half
/// where they scatter from ring to ring. What pieces leave out of rough rings differs from level to level.
constexpr double of_change = 1, of_rest = 2;
constexpr double least_error = 0.75;   // of the tolerance: two levels may agree by chance
constexpr double of_tolerance = 0.02;  // that harmonics which are left out may have

double difference(double a, double b) { return b == 0 ? 0 : std::fabs(a / b - 1); }

}  // namespace

DirectionalSolver::DirectionalSolver(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model)
    : spectrum_(spectrum),
      table_(std::get<TabulatedSpectrum>(spectrum)),
      rubber_(rubber),
      unlimited_(unlimited(rubber)),
      model_(model),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      with_edges_(std::holds_alternative<PartialContact>(model.correction)),
      directions_(table_.harmonics(), model.direction) {}

/// How many harmonics the velocity needs, by the points of cells, which are few.
void DirectionalSolver::begin(double velocity) {
  if (velocity == velocity_) return;
  velocity_ = velocity;
  const RoughnessPieces& pieces = roughness_pieces(table_, 0);
  points_.clear();
  for (const double q : pieces.cells().wavenumber()) points_.push_back(velocity * q);
  at_points_ = angular_harmonics(unlimited_ ? *unlimited_ : rubber_, points_, directions_.count());
  rest_ = 0;
  used_ = Directions::needed(directions_.at_nodes(pieces), directions_.count(), at_points_, of_tolerance * model_.rtol,
                             rest_);
  if (with_edges_) take_edges(pieces);
}

/// Beyond the end of the roughness, on Gauss rules of ln x that end at the rows of a measured modulus; above the last
/// of them the modulus is held. The ring is that of the last tenth.
void DirectionalSolver::take_edges(const RoughnessPieces& pieces) {
  const double q_e = pieces.window().end(), start = velocity_ * q_e;
  const Rubber& rubber = unlimited_ ? *unlimited_ : rubber_;
  double highest = start * partial_contact::tail_end, held_from = highest;
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber))
    held_from = std::fmin(highest, curve->highest_frequency());
  const double begin = std::fmin(start, held_from);
  std::vector<double> ends{0};
  const double length = std::log(std::fmax(held_from / start, 1));
  constexpr double longest = 0.5;
  for (double k = 1, n = std::ceil(length / longest); k <= n; ++k) ends.push_back(length * k / n);
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber))
    for (const double knot : curve->knots())
      if (const double at = std::log(knot / start); at > 0 && at < length) ends.push_back(at);
  std::ranges::sort(ends);
  const LegendreRule& rule = legendre_rule(12);
  std::vector<double> w{begin}, weight{0};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (std::size_t j = 0; j < rule.n; ++j) {
      const double half = (ends[i + 1] - ends[i]) / 2, at = ends[i] + half * (1 + rule.node[j]);
      w.push_back(std::fmin(start * std::exp(at), held_from));
      weight.push_back(half * rule.weight[j] * std::exp(-partial_contact::tail_power * at));
    }
  const double power = partial_contact::tail_power, last = std::fmax(held_from / start, 1);
  w.push_back(held_from);
  weight.push_back((std::pow(last, -power) - std::pow(partial_contact::tail_end, -power)) / power);
  std::vector<double> i1(w.size()), i2(w.size()), across(w.size()), i1_outside(w.size());
  (void)angular_integrals(rubber_, w, i1, i2, i1_outside);
  const std::vector<double> whole = i1;
  DirectedRubber(directions_.at_end(pieces), used_).add(rubber, w, i1, i2, across);
  edges_ = {};
  edges_.i2_at_end = i2.front();
  edges_across_ = 0;
  static_assert(partial_contact::tail_excess == 0.25);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double part = weight[i] * std::sqrt(std::sqrt(i2[i] / i2.front()));
    edges_.i1 += part * i1[i];
    edges_.i2 += part * i2[i];
    edges_across_ += part * across[i];
    const bool held = i + 1 == w.size() && held_from < highest;
    edges_.i1_outside += part * i1[i] * (held ? 1 : i1_outside[i] / whole[i]);
  }
}

void DirectionalSolver::take_moduli(Level& level, bool first) {
  const RoughnessPieces& pieces = *level.grid->pieces();
  const RoughnessPieces::Nodes& nodes = pieces.nodes();
  const RoughnessCells& cells = pieces.cells();  // of the same points at each level
  const std::size_t n = nodes.weight.size(), stride = n + RoughnessCells::excess, count = points_.size();
  for (std::size_t i = 0; i < n; ++i) level.frequency[i] = velocity_ * nodes.wavenumber[i];
  loss_.resize(std::max<std::size_t>(used_, 1) * stride);
  square_.resize(loss_.size());
  std::size_t row = stride;
  if (const auto* const series = std::get_if<PronySeries>(&rubber_)) {
    cells.at_nodes(at_points_.loss.data(), at_points_.square.data(), level.i1.data(), level.i2.data());
    for (std::size_t m = 0; m < used_; ++m)
      cells.at_nodes(at_points_.loss.data() + (m + 1) * count, at_points_.square.data() + (m + 1) * count,
                     loss_.data() + m * stride, square_.data() + m * stride);
    if (first && series->fitted_range()) {
      std::vector<double> i1(n), i2(n);
      (void)angular_integrals(rubber_, level.frequency, i1, i2, level.i1_outside);
    }
  } else {
    (void)angular_integrals(rubber_, level.frequency, {level.i1.data(), n}, {level.i2.data(), n}, level.i1_outside);
    row = n;
    std::get<MasterCurve>(rubber_).angular_harmonics(level.frequency, used_, std::span(loss_).first(used_ * n),
                                                     std::span(square_).first(used_ * n));
  }
  const std::vector<double> whole(level.i1.begin(), level.i1.begin() + static_cast<std::ptrdiff_t>(n));
  Directions::add(level.rings, directions_.count(), used_, loss_, square_, row, {level.i1.data(), n},
                  {level.i2.data(), n}, level.across);
  for (std::size_t i = 0; i < n; ++i) {
    level.i1_outside[i] *= level.i1[i] / whole[i];  // as if it had the directions of all
    if (nodes.weight[i] > 0 && !(level.i2[i] > 0))
      throw InvalidInput(argument("spectrum") + ": its harmonics at wavenumber = " + show(nodes.wavenumber[i], 6) +
                         " 1/m are those of no density that is positive in all directions" + must(", must have ") +
                         "fewer of them, or wider rings");
  }
}

DirectionalSolver::Level& DirectionalSolver::at_velocity(std::size_t number) {
  Level& level = levels_[number];
  if (level.velocity == velocity_) return level;
  if (!level.grid) {
    const RoughnessPieces& pieces = roughness_pieces(table_, number);
    const std::span<const Segment> surface = table_.surface().segments(table_);
    level.grid =
        std::make_unique<ContactGrid>(surface, ContactGridOptions{.poisson_ratio = model_.poisson_ratio,
                                                                  .window = with_edges_ ? &pieces.window() : nullptr,
                                                                  .edge_nodes = false,
                                                                  .pieces = &pieces});
    level.theory = contact_theory(model_, spectrum_, surface, *level.grid);
    level.rings = directions_.at_nodes(pieces);
    const std::size_t n = pieces.nodes().weight.size();
    for (auto* const row : {&level.frequency, &level.across, &level.i1_outside}) row->resize(n);
    for (auto* const row : {&level.i1, &level.i2}) row->resize(n + RoughnessCells::excess);
  }
  level.velocity = velocity_;
  take_moduli(level, number == 0);
  const std::size_t n = level.frequency.size();
  level.theory->take({{level.i1.data(), n}, {level.i2.data(), n}});
  if (with_edges_) level.theory->take_edges(edges_);
  return level;
}

/// Of the force across, as the sum of friction.
double DirectionalSolver::lateral(const Level& level, const ContactSums& sums, double scale) const {
  const VectorXd &part = level.theory->part(), &stress = level.theory->stress(), &weight = level.grid->weight();
  double sum = with_edges_ ? sums.edges * level.grid->beyond().end->window * edges_across_ : 0;
  for (Index i = 0; i < weight.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (with_edges_)
      sum += weight[i] * stress[i] * level.across[at];
    else if (level.i1[at] != 0)
      sum += part[i] / scale * (level.across[at] / level.i1[at]);
  }
  return sum;
}

/// The part of friction from frequencies outside of the measured range.
double DirectionalSolver::outside(const Level& level, const ContactSums& sums) const {
  double sum = with_edges_ ? sums.edges * level.grid->beyond().end->window * edges_.i1_outside : 0;
  const VectorXd &stress = level.theory->stress(), &weight = level.grid->weight();
  for (Index i = 0; i < weight.size(); ++i)
    sum += weight[i] * stress[i] * level.i1_outside[static_cast<std::size_t>(i)];
  return sum;
}

void DirectionalSolver::solve(double pressure, double velocity, double shift) {
  const double root = 1 / (pressure * shift), scale = root * root, mu_factor = 4 * pressure / stiffening_ * scale;
  begin(velocity);
  const Level* coarse = &at_velocity(0);
  g_ = coarse->theory->unit_g() * scale;
  check_g(g_, pressure);
  ContactSums before = coarse->theory->solve(scale, model_.rtol, usual_kappa);
  const double of_outside = outside(*coarse, before);
  double across_before = lateral(*coarse, before, scale), error = 0;
  for (std::size_t number = 1; number < levels_.size(); ++number) {
    const Level& level = at_velocity(number);
    const ContactSums& now = level.theory->solve(scale, model_.rtol, before.kappa);
    const double across = lateral(level, now, scale);
    const double change =
        std::max({difference(now.friction, before.friction), difference(now.share, before.share),
                  difference(level.theory->unit_g(), coarse->theory->unit_g()), difference(now.kappa, before.kappa),
                  now.friction > 0 ? std::fabs(across - across_before) / now.friction : 0});
    error = of_change * change + of_rest * RoughnessPieces::roughest(number) + rest_;
    before = now;
    across_before = across;
    coarse = &level;
    if (!(error <= 0.85 * model_.rtol)) continue;
    sums_ = now;
    g_ = level.theory->unit_g() * scale;
    error_ = std::fmax(error, least_error * model_.rtol);
    hysteresis_ = {mu_factor * now.friction, mu_factor * now.friction * error_, mu_factor * of_outside,
                   mu_factor * across};
    return;
  }
  throw NotConverged("the plane sums of a directional spectrum reached an error of " + show(error, 2) + " where " +
                     argument("rtol") + " = " + show(model_.rtol) + " was asked for");
}

}  // namespace asperity
