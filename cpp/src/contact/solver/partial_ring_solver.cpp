// Two levels of pieces solve a point (spectrum/roughness_pieces.hpp) by the rule of contact/partial_contact_rule.hpp.
#include "contact/solver/partial_ring_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conditions.hpp"
#include "contact/partial_contact_rule.hpp"

namespace asperity {

namespace {

constexpr double for_tail = 0.02;  // of the tolerance
/// The error of the finer level, by what it changes: it should be a sixteenth. Other sums tell the error where mu and
/// the area agree by chance.
constexpr double of_change = 0.75, of_change_with_knots = 1, of_others = 0.3;
/// Of the tolerance: two levels may agree by chance, and one point in a hundred was off by half of the tolerance where
/// they did.
constexpr double least_error = 0.75;

}  // namespace

PartialRingSolver::PartialRingSolver(const TabulatedSpectrum& table, std::span<const Segment> surface,
                                     const Rubber& rubber, const ContactModel& model)
    : table_(table),
      surface_(surface),
      rubber_(rubber),
      model_(model),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)) {}

PartialRingSolver::Level& PartialRingSolver::at_velocity(std::size_t number, double velocity) {
  Level& level = levels_[number];
  if (level.velocity == velocity) return level;
  if (!level.pieces) {
    level.pieces = &table_.surface().pieces(table_, number);
    const std::size_t n = level.pieces->nodes().weight.size();
    for (auto* const row : {&level.frequency, &level.i1, &level.i2, &level.i1_outside, &level.g, &level.steepness,
                            &level.weight, &level.ratio, &level.outside, &level.stress})
      row->resize(n);
  }
  level.velocity = velocity;
  const RoughnessPieces::Nodes& nodes = level.pieces->nodes();
  const std::size_t n = nodes.weight.size();
  for (std::size_t i = 0; i < n; ++i) level.frequency[i] = velocity * nodes.wavenumber[i];
  level.any_outside = angular_integrals(rubber_, level.frequency, level.i1, level.i2, level.i1_outside);
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
  if (level.any_outside)
    for (std::size_t i = 0; i < n; ++i) level.outside[i] = level.i1_outside[i] / level.i2[i];
  const double i2_at_end = angular_integrals(rubber_, velocity * surface_.back().b).i2;
  level.end.g = g;
  level.end.window = factor * level.pieces->window()(surface_.back().b);
  level.end.band = {partial_contact::end_factor(level.pieces->window().share_of_end()),
                    1 - g / (factor * level.pieces->window().total() * i2_at_end)};
  level.end.tail = tail_;
  return level;
}

PartialRoot PartialRingSolver::root(Level& level, double scale, double start) const {
  const PartialNodes nodes{level.g.data(), level.steepness.data(), level.weight.data(), level.ratio.data(),
                           level.g.size()};
  return partial_root(nodes, level.end, scale, model_.rtol, start, level.stress.data());
}

void PartialRingSolver::by_panels(double pressure, double velocity) {
  if (!panels_) panels_.emplace(surface_, rubber_, model_, std::span<const double>{});
  panels_->solve(pressure, velocity);
  take(*panels_);
}

void PartialRingSolver::solve(double pressure, double velocity) {
  if (velocity != tail_velocity_) {
    tail_velocity_ = velocity;
    tail_ = tail_integrals(rubber_, velocity * surface_.back().b, 1, partial_contact::tail_end, for_tail * model_.rtol);
  }
  const double scale = 1 / pressure / pressure, mu_factor = 4 / (stiffening_ * pressure);
  const auto difference = [](double a, double b) { return b == 0 ? 0 : std::fabs(a / b - 1); };
  Level* coarse = &at_velocity(0, velocity);
  g1_ = coarse->end.g * scale;
  if (g1_ == 0) return by_panels(pressure, velocity);
  check_g(g1_, pressure);
  PartialRoot before = root(*coarse, scale, usual_kappa);
  for (std::size_t number = 1; number < RoughnessPieces::levels; ++number) {
    Level& level = at_velocity(number, velocity);
    root_ = root(level, scale, before.kappa);
    const double change =
        std::max({difference(root_.friction, before.friction), difference(root_.share, before.share),
                  difference(level.end.g, coarse->end.g),
                  of_others * std::max({difference(root_.kappa, before.kappa), std::fabs(root_.slope - before.slope),
                                        std::fabs(root_.friction_slope - before.friction_slope)})});
    const double error = (std::holds_alternative<MasterCurve>(rubber_) ? of_change_with_knots : of_change) * change +
                         for_tail * model_.rtol;
    before = root_;
    coarse = &level;
    if (!(error <= 0.85 * model_.rtol)) continue;
    g1_ = level.end.g * scale;
    double outside = root_.edges * level.end.window * tail_.i1_outside;
    if (level.any_outside)
      for (std::size_t i = 0; i < level.g.size(); ++i) outside += level.weight[i] * level.stress[i] * level.outside[i];
    area_error_ = std::fmax(error, least_error * model_.rtol);
    hysteresis_ = {mu_factor * root_.friction, mu_factor * root_.friction * area_error_, mu_factor * outside};
    return;
  }
  by_panels(pressure, velocity);
}

}  // namespace asperity
