// G (Eq. 7) and mu_H (Eq. 22) by GSL's adaptive rules on ln q, G integrated anew inside the integrand: slow, and
// independent of the panels that it checks. B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/solver/gsl_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using std::numbers::pi;

GslSolver::GslSolver(std::span<const Segment> surface, const Excitation& waves, const Point& point,
                     std::span<const double> stops, bool resolve_front, double rtol, Adaptive rule)
    : waves_(waves), point_(point), rule_(rule), rtol_(rtol), g_rtol_(std::fmax(rtol / 100, 1e-13)) {
  const double stiffening = 1 / (1 - point.poisson_ratio * point.poisson_ratio);
  const double ratio = stiffening / point.pressure / point.shift;
  g_factor_ = ratio * ratio / 8;
  mu_factor_ = stiffening / point.pressure / (2 * point.shift * point.shift);
  for (const Segment& segment : surface) {
    const double end = segment.length();
    std::vector<double> edges{0, end};
    const auto add = [&](double s) {
      if (s > 0 && s < end) edges.push_back(s);
    };
    for (int i = 1; i < end; ++i) add(i);
    for (const auto& wavenumbers : {stops, waves.kinks()})
      for (const double q : wavenumbers)
        if (q > segment.a && q < segment.b) add(segment.offset(q));
    if (const auto* curve = std::get_if<MasterCurve>(&waves.rubber())) add_knots(segment, curve->knots(), edges);
    if (resolve_front && g_end_ < 1) {  // later on it is behind us
      const double width = front(segment);
      if (!(width > 0))
        throw NotConverged("G grows faster than a double can tell from q = " + show(segment.a) + " 1/m on");
      for (double s = width; s < std::fmin(1, end); s *= 4) add(s);
    }
    add_segment(segment, std::move(edges));
  }
}

/// Where the frequency passes through a knot of a modulus that is measured.
void GslSolver::add_knots(const Segment& segment, std::span<const double> knots, std::vector<double>& edges) const {
  for (const double w : knots)
    if (const double s = std::log(w / (point_.velocity * segment.a)); s > 0 && s < segment.length()) edges.push_back(s);
}

/// Adds the panels between `edges` of a segment, with G at each of them.
void GslSolver::add_segment(const Segment& segment, std::vector<double> edges) {
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    panels_.push_back({&segment, edges[i], edges[i + 1], g_end_});
    const Integral step = integrate([&](double s) { return g_rate(segment, s); }, edges[i], edges[i + 1], g_rtol_,
                                    g_rtol_ * g_end_, rule_);
    g_end_ += step.value;
    g_error_ += step.error;
    if (g_end_ > 0) relative_error_ = std::fmax(relative_error_, g_error_ / g_end_);
  }
}

double GslSolver::front(const Segment& segment) const {
  if (!segment.straight || segment.at_a > 0) return 1 / g_rate(segment, 0);
  const double q = segment.a, ramp = segment.at_b * (q / (segment.b - q));  // dC / ds at the start
  const double curvature = g_factor_ * q * q * q * q * ramp * waves_(point_.velocity * q, q).i2;
  return std::sqrt(2 / curvature);
}

double front_width(std::span<const Segment> surface, const Excitation& waves, const GslSolver::Point& point) {
  return GslSolver(surface.first(1), waves, point, {}, false, 0.1, Adaptive::bisection).front(surface.front());
}

double GslSolver::g_rate(const Segment& segment, double s) const {
  const double c = segment.density_at(s);
  if (c == 0) return 0;
  const double q = segment.a * std::exp(s);
  return g_factor_ * q * q * q * q * c * waves_(point_.velocity * q, q).i2;
}

const GslSolver::Panel& GslSolver::panel_at(double wavenumber) const {
  const auto after = std::ranges::partition_point(
      panels_, [&](const Panel& p) { return p.segment->a <= wavenumber && p.lower <= p.segment->offset(wavenumber); });
  return after == panels_.begin() ? *after : *(after - 1);
}

/// Panels are short enough for one rule; where it says otherwise the adaptive one takes over.
double GslSolver::g_inside(const Panel& panel, double s) const {
  if (s <= panel.lower) return panel.g_lower;
  const auto rate = [&](double at) { return g_rate(*panel.segment, at); };
  Integral step = integrate_smooth(rate, panel.lower, s);
  if (step.error > g_rtol_ * (panel.g_lower + step.value))
    step = integrate(rate, panel.lower, s, g_rtol_, g_rtol_ * panel.g_lower, rule_);
  return panel.g_lower + step.value;
}

double GslSolver::g(double wavenumber) const {
  const Panel& panel = panel_at(wavenumber);
  if (&panel == &panels_.back() && wavenumber >= panel.segment->b) return g_end_;
  return g_inside(panel, panel.segment->offset(wavenumber));
}

double GslSolver::hysteresis_rate(const Panel& panel, double s, Form form, const std::optional<SFunction>& factor,
                                  double* outside) const {
  if (outside) *outside = 0;
  const double c = panel.segment->density_at(s);
  if (c == 0) return 0;
  const double q = panel.segment->a * std::exp(s);
  const AngularIntegrals angular = waves_(point_.velocity * q, q);
  if (angular.i1 == 0) return 0;
  const double share = contact_share(g_inside(panel, s), form);
  const double weight = mu_factor_ * q * q * q * q * c * share * (factor ? (*factor)(share) : 1);
  if (outside) *outside = weight * angular.i1_outside;
  return weight * angular.i1;
}

/// Whether more than 1e-7 of I1 comes from outside of the measured frequencies at either end of a panel.
bool GslSolver::reaches_outside(const Panel& panel) const {
  constexpr double least_share = 1e-7;
  return std::ranges::any_of(std::array{panel.lower, panel.upper}, [&](double s) {
    const double q = panel.segment->a * std::exp(s);
    const AngularIntegrals angular = waves_(point_.velocity * q, q);
    return angular.i1_outside > least_share * angular.i1;
  });
}

GslSolver::Hysteresis GslSolver::hysteresis(Form form, const std::optional<SFunction>& factor) const {
  Hysteresis result;
  const auto* series = std::get_if<PronySeries>(&waves_.rubber());
  const bool measured = series == nullptr || series->fitted_range();
  for (const Panel& panel : panels_) {
    const Integral part = integrate([&](double s) { return hysteresis_rate(panel, s, form, factor, nullptr); },
                                    panel.lower, panel.upper, rtol_ / 4, rtol_ / 100 * result.value, rule_);
    result.value += part.value;
    result.error += part.error;
    result.by_panel.push_back(part.value);
    if (!measured || !reaches_outside(panel)) continue;
    const auto outside = [&](double s) {
      double rate = 0;
      (void)hysteresis_rate(panel, s, form, factor, &rate);
      return rate;
    };
    constexpr double share_tolerance = 1e-4;  // a share is read to two or three digits
    result.outside +=
        integrate(outside, panel.lower, panel.upper, share_tolerance, share_tolerance * part.value, rule_).value;
  }
  return result;
}

Integral GslSolver::weighted_hysteresis(Form form, const std::optional<SFunction>& factor,
                                        const std::function<double(double)>& weight) const {
  Integral result{0, 0};
  for (const Panel& panel : panels_) {
    const auto rate = [&](double s) {
      return weight(panel.segment->a * std::exp(s)) * hysteresis_rate(panel, s, form, factor, nullptr);
    };
    const Integral part = integrate(rate, panel.lower, panel.upper, rtol_ / 4, rtol_ / 100 * result.value, rule_);
    result.value += part.value;
    result.error += part.error;
  }
  return result;
}

double GslSolver::hysteresis_density(double wavenumber, Form form, const std::optional<SFunction>& factor) const {
  const Panel& panel = panel_at(wavenumber);
  return hysteresis_rate(panel, std::fmin(panel.segment->offset(wavenumber), panel.upper), form, factor, nullptr);
}

std::vector<std::array<double, 2>> GslSolver::panels() const {
  std::vector<std::array<double, 2>> result;
  result.reserve(panels_.size());
  for (const Panel& p : panels_) result.push_back({p.segment->a * std::exp(p.lower), p.segment->a * std::exp(p.upper)});
  return result;
}

}  // namespace asperity
