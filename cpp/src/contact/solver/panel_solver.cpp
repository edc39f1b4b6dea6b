#include "contact/solver/panel_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "contact/conditions.hpp"
#include "contact/solver/hysteresis_error.hpp"
#include "numerics/arguments.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

namespace {

constexpr double least_share = 8e-7;  // of the tolerance: an error of G below it would be chance

}  // namespace

GaussPath::GaussPath(std::span<const Segment> surface, const Rubber& rubber, double poisson_ratio, double rtol)
    : panels_(surface, rubber, poisson_ratio, rtol),
      stiffening_(1 / (1 - poisson_ratio * poisson_ratio)),
      rtol_(rtol) {}

/// Value of a panel and its error.
void GaussPath::add_hysteresis(std::size_t index, double scale, const FrontIntegral& front) {
  Visit& visit = visits_[index];
  const Panel& p = panels_[visit.panel];
  OnPanel at;
  at.g_upper = ends_.g[index];
  if (at.g_upper < front.whole) {  // F = G
    visit.value = p.full * scale;
    visit.error = p.full_error * scale;
    visit.outside = p.any_outside ? p.full_outside * scale : 0;
    return;
  }
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  const Kernels& loops = kernels();
  const double* const slope = panels_.row(p, Panel::slope);
  const double f_lower = index == 0 ? 0 : ends_.f[index - 1];
  at.twice = p.twice && front.has_second;
  at.g_lower = visit.g_lower * scale;
  at.f_upper = ends_.f[index];
  at.f2_upper = ends_.f2[index];
  at.rise = at.f_upper - f_lower;
  loops.place(visit.g_lower, panels_.row(p, Panel::cumulative), scale, n, at.g);
  loops.front(front.table, front.gamma, at.g, n, at.f, at.twice ? at.f2 : nullptr);
  loops.project(rule, slope, at.g, f_lower, at.f, at.by_g, at.by_r);
  if (at.twice) {
    // by parts once more: int F dR = F2 dR/dG at the upper end - int F2 d(dR/dG)
    const double* const curvature = panels_.row(p, Panel::curvature);
    loops.sum(rule, curvature, at.f2, at.sums);
    at.first_slope = curvature[0];
    visit.value = p.r.upper * at.f_upper - (p.dr_dg.upper * at.f2_upper - at.sums.value) * (1 / scale);
  } else {
    loops.sum(rule, slope, at.f, at.sums);
    at.first_slope = slope[0];
    visit.value = p.r.upper * at.rise - at.sums.value;
  }
  if (p.any_outside) {
    const double* outside = panels_.row(p, Panel::outside_slope);
    double part = 0;
    for (std::size_t i = 0; i < n; ++i) part += outside[i] * at.f[i];
    visit.outside = p.outside_upper * at.rise - part;
  }
  visit.error = hysteresis_error(p, at, scale, front.gamma);
}

void GaussPath::evaluate(double scale, const FrontIntegral* front) {
  double g = 0, g_error = 0;
  g_relative_error_ = 0;
  hysteresis_ = {};
  const std::size_t n = visits_.size(), room = (n + lanes - 1) / lanes * lanes;
  for (auto* const column : {&ends_.g, &ends_.f, &ends_.f2}) column->resize(room);
  for (std::size_t i = 0; i < n; ++i) {
    Visit& visit = visits_[i];
    const Panel& p = panels_[visit.panel];
    visit.g_lower = g;
    g += p.g_total;
    g_error += p.g_error;
    visit.g_part = p.g_error / g;
    g_relative_error_ = std::max(g_error / g, g_relative_error_);
    ends_.g[i] = g * scale;
  }
  if (!front) return;
  std::fill(ends_.g.begin() + static_cast<std::ptrdiff_t>(n), ends_.g.end(), 1.0);
  kernels().front(front->table, front->gamma, ends_.g.data(), room, ends_.f.data(), ends_.f2.data());
  for (std::size_t i = 0; i < n; ++i)
    if (ends_.g[i] < front->whole) ends_.f[i] = ends_.g[i];
  for (std::size_t i = 0; i < n; ++i) {
    add_hysteresis(i, scale, *front);
    hysteresis_.value += visits_[i].value;
    hysteresis_.error += visits_[i].error;
    hysteresis_.outside += visits_[i].outside;
  }
}

/// Puts two in the place of each panel that has more than its part of the error.
void GaussPath::refine(bool hysteresis_good, bool g_good) {
  double worst = 0, g_worst = 0;
  for (const Visit& visit : visits_) {
    worst = std::fmax(worst, visit.error);
    g_worst = std::fmax(g_worst, visit.g_part);
  }
  const double part = 1 / static_cast<double>(visits_.size()), none = std::numeric_limits<double>::infinity();
  const double allowed = hysteresis_good ? none : std::fmin(worst / 2, 0.1 * part * rtol_ * hysteresis_.value);
  const double g_allowed = g_good ? none : std::fmin(g_worst / 2, 0.03 * part * rtol_);
  next_.clear();
  for (const Visit& visit : visits_) {
    if (visit.error <= std::fmax(allowed, 1e-3 * worst) && visit.g_part <= g_allowed) {
      next_.push_back(visit);
      continue;
    }
    const std::size_t child = panels_.children(visit.panel);
    next_.push_back({child});
    next_.push_back({child + 1});
  }
  visits_.swap(next_);
}

void GaussPath::solve(double pressure, double shift, const FrontIntegral* front) {
  scale_ = 1 / (pressure * shift) / (pressure * shift);
  mu_factor_ = 4 * pressure / stiffening_;
  density_factor_ = stiffening_ / (2 * pressure * shift * shift);
  visits_.clear();
  for (const std::size_t root : panels_.roots()) visits_.push_back({root});
  double g_end = 0;
  for (const std::size_t root : panels_.roots()) g_end += panels_[root].g_total;
  if (!visits_.empty()) check_g(g_end * scale_, pressure);
  constexpr int most_rounds = 60;
  const std::size_t most_panels = 20000 + 4 * visits_.size();
  for (int round = 0;; ++round) {
    evaluate(scale_, front);
    const bool good = hysteresis_.error <= 0.85 * rtol_ * hysteresis_.value, g_good = g_relative_error_ <= rtol_ / 16;
    if (good && g_good) break;
    if (round == most_rounds || visits_.size() > most_panels)
      throw NotConverged("mu_H = " + show(mu_factor_ * hysteresis_.value) + " with error " +
                         show(mu_factor_ * hysteresis_.error) + ", G with relative error " + show(g_relative_error_) +
                         " on " + std::to_string(visits_.size()) + " panels where rtol = " + show(rtol_) +
                         " was asked for");
    refine(good, g_good);
  }
  hysteresis_.value *= mu_factor_;
  hysteresis_.error *= mu_factor_;
  hysteresis_.outside *= mu_factor_;
}

const GaussPath::Visit& GaussPath::visit_at(double wavenumber) const {
  const auto after = std::ranges::partition_point(visits_, [&](const Visit& visit) {
    const Panel& p = panels_[visit.panel];
    return p.segment->a <= wavenumber && p.s(p.lower) <= p.segment->offset(wavenumber);
  });
  return after == visits_.begin() ? *after : *(after - 1);
}

double GaussPath::g(double wavenumber) const {
  if (visits_.empty()) return 0;
  if (const Visit& last = visits_.back(); wavenumber >= panels_[last.panel].segment->b)
    return (last.g_lower + panels_[last.panel].g_total) * scale_;
  const Visit& visit = visit_at(wavenumber);
  const Panel& p = panels_[visit.panel];
  const double s = p.segment->offset(wavenumber);
  const bool whole = wavenumber >= p.segment->b || s >= p.s(p.upper);
  return (visit.g_lower + (whole ? p.g_total : panels_.g_to(p, s))) * scale_;
}

double GaussPath::relative_error() const { return std::max(g_relative_error_, least_share * rtol_); }

double GaussPath::full_density(double wavenumber) const {
  if (visits_.empty()) return 0;
  const Segment& segment = *panels_[visit_at(wavenumber).panel].segment;
  if (wavenumber < segment.a || wavenumber > segment.b) return 0;  // in an empty bin
  const double square = wavenumber * wavenumber;
  return density_factor_ * square * square * segment.density(wavenumber) * panels_.angular(wavenumber).i1;
}

std::vector<GaussPath::Part> GaussPath::parts() const {
  std::vector<Part> result;
  result.reserve(visits_.size());
  for (const Visit& visit : visits_) {
    const Panel& p = panels_[visit.panel];
    const double a = p.segment->a;
    result.push_back({a * std::exp(p.s(p.lower)), a * std::exp(p.s(p.upper)), visit.value * mu_factor_});
  }
  return result;
}

}  // namespace asperity
