#include "persson.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "integrate.hpp"

namespace asperity {

using std::numbers::pi;

double contact_share(double g, Form form) {
  if (form == Form::exact) return std::erf(0.5 / std::sqrt(g));
  return 1 / std::cbrt(1 + std::pow(pi * g, 1.5));
}

// Phi(G) = int_0^G dg / S is close to a power of G between 1 and 2, so that Newton's steps in ln Phi over ln G
// converge from anywhere. Below `low` S is 1 to rounding.
double g_with_s_inside(double uncorrected, double gamma, Form form, double rtol) {
  if (uncorrected == 0 || gamma == 1) return uncorrected;
  const double low = 1e-10 * std::fmin(1, uncorrected);
  const auto phi = [&](double g) {
    const auto rate = [&](double x) {
      const double at = std::exp(x);
      return at / s_factor(contact_share(at, form), gamma);
    };
    return low + integrate(rate, std::log(low), std::log(g), rtol).value;
  };
  double g = uncorrected;
  for (int i = 0; i < 50; ++i) {
    const double value = phi(g), s = s_factor(contact_share(g, form), gamma);
    const double step = std::log(uncorrected / value) * s * value / g;
    g = std::fmax(g * std::exp(step), low * 2);
    if (std::fabs(step) <= rtol) return g;
  }
  throw NotConverged("contact area with the S factor inside G: G = " + show(g) +
                     " after 50 steps at rtol = " + show(rtol));
}

Path::Path(std::span<const Segment> surface, const Rubber& rubber, const Point& point, std::span<const double> stops,
           bool resolve_front, double rtol)
    : rubber_(rubber), point_(point), q0_(surface.front().a), rtol_(rtol) {
  const double stiffening = 1 / (1 - point.poisson_ratio * point.poisson_ratio);
  const double ratio = stiffening / point.pressure / point.shift;
  g_factor_ = ratio * ratio / 8;
  mu_factor_ = stiffening / point.pressure / (2 * point.shift * point.shift);

  const double end = std::log(surface.back().b / q0_);
  std::vector<double> edges{0, end};
  const auto add = [&](double s) {
    if (s > 0 && s < end) edges.push_back(s);
  };
  for (const Segment& segment : surface) add(std::log(segment.a / q0_));
  for (double s = 1; s < end; s += 1) add(s);
  for (const double q : stops) add(std::log(q / q0_));
  if (const auto* curve = std::get_if<MasterCurve>(&rubber))
    for (const double w : curve->knots()) add(std::log(w / (point.velocity * q0_)));
  if (resolve_front) {
    const double width = front_width(surface, rubber, point);
    if (!(width > 0))
      throw NotConverged("G grows by " + show(1 / width) + " at q0 for pressure = " + show(point.pressure) +
                         ", velocity = " + show(point.velocity) + ": beyond what a double holds");
    for (double s = width; s < std::fmin(1, end); s *= 4) add(s);
  }
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());

  const double g_rtol = std::fmax(rtol_ / 100, 1e-13);
  double error = 0;
  auto segment = surface.begin();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double middle = q0_ * std::exp((edges[i] + edges[i + 1]) / 2);
    while (segment + 1 != surface.end() && middle > segment->b) ++segment;
    const Panel panel{edges[i], edges[i + 1], &*segment, g_end_};
    const Integral step = integrate([&](double s) { return g_rate(panel, s); }, panel.lower, panel.upper, g_rtol);
    panels_.push_back(panel);
    g_end_ += step.value;
    error += step.error;
    if (g_end_ > 0) relative_error_ = std::fmax(relative_error_, error / g_end_);
  }
}

double front_width(std::span<const Segment> surface, const Rubber& rubber, const Path::Point& point) {
  const Segment& first = surface.front();
  const double stiffness = (1 - point.poisson_ratio * point.poisson_ratio) * point.pressure * point.shift;
  const double rate = std::pow(first.a, 4) * first.at_a * angular_integrals(rubber, point.velocity * first.a).i2 /
                      (8 * stiffness * stiffness);
  return 1 / rate;
}

double Path::g_rate(const Panel& panel, double s) const {
  const double q = q0_ * std::exp(s);
  const double c = panel.segment->density(q);
  if (c == 0) return 0;
  return g_factor_ * q * q * q * q * c * angular_integrals(rubber_, point_.velocity * q).i2;
}

const Path::Panel& Path::panel_at(double s) const {
  const auto after = std::ranges::upper_bound(panels_, s, {}, &Panel::lower);
  return after == panels_.begin() ? *after : *(after - 1);
}

/// Panels are short enough for one rule; where it says otherwise the adaptive one takes over.
double Path::g_inside(const Panel& panel, double s) const {
  if (s <= panel.lower) return panel.g_lower;
  const auto rate = [&](double at) { return g_rate(panel, at); };
  const double g_rtol = std::fmax(rtol_ / 100, 1e-13);
  Integral step = integrate_smooth(rate, panel.lower, s);
  if (step.error > g_rtol * (panel.g_lower + step.value)) step = integrate(rate, panel.lower, s, g_rtol);
  return panel.g_lower + step.value;
}

double Path::g(double wavenumber) const {
  const double s = std::log(wavenumber / q0_);
  if (s >= panels_.back().upper) return g_end_;
  return g_inside(panel_at(s), s);
}

double Path::hysteresis_rate(const Panel& panel, double s, Form form, std::optional<double> gamma,
                             double* outside) const {
  const double q = q0_ * std::exp(s);
  const double c = panel.segment->density(q);
  if (outside) *outside = 0;
  if (c == 0) return 0;
  const AngularIntegrals angular = angular_integrals(rubber_, point_.velocity * q);
  if (angular.i1 == 0) return 0;
  const double share = contact_share(g_inside(panel, s), form);
  const double weight = mu_factor_ * q * q * q * q * c * share * (gamma ? s_factor(share, *gamma) : 1);
  if (outside) *outside = weight * angular.i1_outside;
  return weight * angular.i1;
}

/// Whether any of I1 worth telling comes from outside of the measured frequencies at either end of a panel.
bool Path::reaches_outside(const Panel& panel) const {
  constexpr double worth_telling = 1e-7;
  for (const double s : {panel.lower, panel.upper}) {
    const AngularIntegrals angular = angular_integrals(rubber_, point_.velocity * q0_ * std::exp(s));
    if (angular.i1_outside > worth_telling * angular.i1) return true;
  }
  return false;
}

Path::Hysteresis Path::hysteresis(Form form, std::optional<double> gamma) const {
  Hysteresis result;
  const bool measured = std::holds_alternative<MasterCurve>(rubber_);
  for (const Panel& panel : panels_) {
    const Integral part = integrate([&](double s) { return hysteresis_rate(panel, s, form, gamma, nullptr); },
                                    panel.lower, panel.upper, rtol_ / 4);
    result.value += part.value;
    result.error += part.error;
    result.by_panel.push_back(part.value);
    if (!measured || !reaches_outside(panel)) continue;
    const auto outside = [&](double s) {
      double rate = 0;
      (void)hysteresis_rate(panel, s, form, gamma, &rate);
      return rate;
    };
    constexpr double share_tolerance = 1e-4;  // a share is read to two or three digits
    result.outside += integrate(outside, panel.lower, panel.upper, share_tolerance, share_tolerance * part.value).value;
  }
  return result;
}

double Path::hysteresis_density(double wavenumber, Form form, std::optional<double> gamma) const {
  const double s = std::clamp(std::log(wavenumber / q0_), 0.0, panels_.back().upper);
  return hysteresis_rate(panel_at(s), s, form, gamma, nullptr);
}

std::vector<std::array<double, 2>> Path::panels() const {
  std::vector<std::array<double, 2>> result;
  for (const Panel& panel : panels_) result.push_back({q0_ * std::exp(panel.lower), q0_ * std::exp(panel.upper)});
  return result;
}

}  // namespace asperity
