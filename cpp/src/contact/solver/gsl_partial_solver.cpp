// The integrals of PartialContact's rule (contact/theory/partial_contact_rule.hpp) by GSL's adaptive rules on ln q,
// with G integrated anew inside the integrand, and the root by the false position.
#include "contact/solver/gsl_partial_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conditions.hpp"
#include "contact/solver/solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/roots.hpp"

namespace asperity {

namespace {

const double reach = std::exp(RoughnessWindow::half_length);
constexpr std::size_t most_met = 40;

}  // namespace

GslPartialSolver::GslPartialSolver(std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model,
                                   std::span<const double> stops)
    : surface_(surface),
      rubber_(rubber),
      model_(model),
      stops_(stops),
      window_(surface),
      rule_(adaptive_rule(model.method)),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      end_(window_, stiffening_ * stiffening_ / 8) {}

Integral GslPartialSolver::over_band(const ContactSums& root, Of of, std::vector<double>* by_panel) const {
  Integral sum{};
  const auto ratio = [&](double q) {
    const AngularIntegrals at = angular_integrals(rubber_, velocity_ * q);
    return at.i1 / at.i2;
  };
  // of the whole integral, about: where hardly any stress is, digits may be lost
  const double size =
      root.variance * (of == Of::variance ? 1 : std::fmin(ratio(surface_.front().a), ratio(surface_.back().b)));
  for (const auto& [lower, upper] : g_->panels()) {
    const double length = std::log1p((upper - lower) / lower), q0 = lower;
    const auto f = [&](double s) {
      const double q = q0 * std::exp(s), square = q * q;
      const auto segment = std::ranges::lower_bound(surface_, std::fmin(q, surface_.back().b), {}, &Segment::b);
      const double c = segment->density(q);
      if (c == 0) return 0.0;
      const AngularIntegrals at = angular_integrals(rubber_, velocity_ * q);
      const double r = partial_stress(root, g_->g(q), g_factor_ * window_(q) * at.i2);
      const double integral = of == Of::variance ? at.i2 : of == Of::friction ? at.i1 : at.i1_outside;
      return g_factor_ * square * square * c * integral * r;
    };
    const double rtol = of == Of::outside ? 1e-4 : model_.rtol / 10;
    const Integral part = integrate(f, 0, length, rtol, rtol / 100 * std::fmax(sum.value, size), rule_);
    sum.value += part.value;
    sum.error += part.error;
    if (by_panel) by_panel->push_back(part.value);
  }
  return sum;
}

/// Of the edges, over the factor of T; from x = `lower` to `upper`.
Integral GslPartialSolver::beyond(double lower, double upper, Of of) const {
  const double frequency = velocity_ * end_.wavenumber;
  std::vector<double> edges{std::log(lower), std::log(upper)};
  const std::optional<FrequencyRange> known = known_range(rubber_);
  const double held = known ? known->highest : std::numeric_limits<double>::infinity();
  const AngularIntegrals at_end = angular_integrals(rubber_, std::fmin(frequency, held));
  const auto cut = [&](double z) {
    if (z > std::log(lower) && z < std::log(upper)) edges.push_back(z);
  };
  if (known) cut(std::log(held / frequency));
  if (const auto* curve = std::get_if<MasterCurve>(&rubber_))
    for (const double w : curve->knots()) cut(std::log(w / frequency));
  std::ranges::sort(edges);
  Integral sum{};
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const auto f = [&](double z) {
      const double w = frequency * std::exp(z);
      const AngularIntegrals at = angular_integrals(rubber_, std::fmin(w, held));
      const double excess = std::pow(at.i2 / at_end.i2, partial_contact::tail_excess);
      const double value = of == Of::variance ? at.i2 : of == Of::friction || w > held ? at.i1 : at.i1_outside;
      return value * excess * std::exp(-partial_contact::tail_power * z);
    };
    const double rtol = of == Of::outside ? 1e-4 : model_.rtol / 10;
    const Integral part = integrate(f, edges[i], edges[i + 1], rtol, rtol / 10 * sum.value, rule_);
    sum.value += part.value;
    sum.error += part.error;
  }
  return sum;
}

void GslPartialSolver::solve(double pressure, double velocity) {
  velocity_ = velocity;
  const double scale = 1 / pressure / pressure;
  g_factor_ = stiffening_ * stiffening_ / 8 * scale;
  mu_factor_ = 4 * pressure / stiffening_;
  stop_wavenumbers_.clear();
  for (const double w : stops_) stop_wavenumbers_.push_back(w / velocity);
  std::vector<double> stops = window_.ends();
  stops.insert(stops.end(), stop_wavenumbers_.begin(), stop_wavenumbers_.end());
  if (surface_.size() <= most_met)
    for (const Segment& segment : surface_) stops.insert(stops.end(), {segment.a / reach, segment.a * reach});
  g_.emplace(surface_, rubber_, GslSolver::Point{model_.poisson_ratio, pressure, velocity, 1}, stops, true,
             model_.rtol / 10, rule_);
  g1_ = g_->g(surface_.back().b);
  root_ = {};
  hysteresis_ = {};
  area_error_ = 0;
  if (g1_ == 0) return;
  check_g(g1_, pressure);

  window_at_end_ = end_.window * scale;
  const partial_contact::Band band = end_.band(g1_ / scale, angular_integrals(rubber_, velocity * end_.wavenumber).i2);
  const Integral tail = beyond(1, partial_contact::tail_end, Of::variance);
  Integral variance{};
  const auto at_root = [&](double x) {
    root_.kappa = std::exp(x);
    const partial_contact::AtEnd rule(root_.kappa * g1_, root_.kappa, band);
    root_.share = rule.share;
    root_.share_slope = rule.share_slope / rule.share;
    root_.edges = rule.edges.value;
    root_.obstacle = rule.obstacle.value;
    root_.variance = rule.integral * rule.spread.value;  // as it will be at the root
    variance = over_band(root_, Of::variance, nullptr);
    root_.variance = variance.value + root_.edges * window_at_end_ * tail.value;
    return std::log(rule.integral * rule.spread.value / root_.variance);
  };
  double lower = -0.3, upper = -0.3, step = 0.1;
  if (at_root(lower) < 0) {
    while (at_root(upper += step) < 0) step *= 2;
  } else {
    while (at_root(lower -= step) > 0) step *= 2;
  }
  const double x = bracketed_root(at_root, lower, upper, model_.rtol / 20);
  constexpr double apart = 1e-3;  // for slopes, of which a digit is enough
  const auto friction_at = [&](std::vector<double>* by_panel) {
    Integral f = over_band(root_, Of::friction, by_panel);
    const Integral in_tail = beyond(1, partial_contact::tail_end, Of::friction);
    f.value += root_.edges * window_at_end_ * in_tail.value;
    f.error += root_.edges * window_at_end_ * in_tail.error;
    return f;
  };
  const double rise = at_root(x + apart), f_beside = friction_at(nullptr).value;
  const double here = at_root(x);
  root_.slope = (rise - here) / apart;
  by_panel_.clear();
  const Integral friction = friction_at(&by_panel_);
  root_.friction = friction.value;
  const double of_kappa = ((variance.error + root_.edges * window_at_end_ * tail.error) / root_.variance +
                           std::fabs(here) + 2 * g_->relative_error()) /
                          root_.slope;
  const double friction_slope = friction.value > 0 ? std::fabs(std::log(f_beside / friction.value)) / apart : 0;
  double outside = 0;
  const auto* series = std::get_if<PronySeries>(&rubber_);
  if (series == nullptr || series->fitted_range())
    outside = over_band(root_, Of::outside, nullptr).value +
              root_.edges * window_at_end_ * beyond(1, partial_contact::tail_end, Of::outside).value;
  hysteresis_ = {
      mu_factor_ * friction.value,
      mu_factor_ * (friction.error + friction.value * (friction_slope * of_kappa + 2 * g_->relative_error())),
      mu_factor_ * outside};
  area_error_ = std::fabs(root_.share_slope) * of_kappa + g_->relative_error() / 2;
}

double GslPartialSolver::stress(double wavenumber) const {
  const double steepness = g_factor_ * window_(wavenumber) * angular_integrals(rubber_, velocity_ * wavenumber).i2;
  return g1_ == 0 ? 1 : partial_stress(root_, g_->g(wavenumber), steepness);
}

double GslPartialSolver::hysteresis_density(double wavenumber) const {
  if (g1_ == 0) return 0;
  const double q_e = end_.wavenumber;
  const double edges = mu_factor_ * window_at_end_ * partial_edges(root_, rubber_, velocity_ * q_e, wavenumber / q_e);
  if (wavenumber > surface_.back().b) return edges;
  const auto segment = std::ranges::lower_bound(surface_, wavenumber, {}, &Segment::b);
  const double square = wavenumber * wavenumber;
  return edges + mu_factor_ * g_factor_ * square * square * segment->density(wavenumber) *
                     angular_integrals(rubber_, velocity_ * wavenumber).i1 * stress(wavenumber);
}

std::vector<PanelSolver::PanelShare> GslPartialSolver::shares() const {
  std::vector<PanelSolver::PanelShare> result;
  const auto panels = g_->panels();
  for (std::size_t i = 0; i < by_panel_.size(); ++i)
    result.push_back({panels[i][0], panels[i][1], mu_factor_ * by_panel_[i]});
  if (g1_ == 0) return result;
  const double q_e = end_.wavenumber, in_tail = mu_factor_ * root_.edges * window_at_end_;
  for (const auto& [lower, upper] : tail_stretches(q_e, stop_wavenumbers_))
    result.push_back({lower, upper, in_tail * beyond(lower / q_e, upper / q_e, Of::friction).value});
  return result;
}

}  // namespace asperity
