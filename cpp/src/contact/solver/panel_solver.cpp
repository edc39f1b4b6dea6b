// mu_H and G on panels at one pressure: mu_H = 4 (1 - nu^2) sigma0 int R dF (Eq. 22 in G of Eq. 7), by parts on each
// panel, and panels halved until the sum of their stated errors is below the tolerance.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/solver/panel_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "contact/conditions.hpp"
#include "contact/solver/panel_error.hpp"
#include "numerics/arguments.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

namespace {

constexpr double least_share = 8e-7;  // of the tolerance: an error of G below it would be chance

}  // namespace

PanelSolver::PanelSolver(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio, double rtol)
    : panels_(surface, waves, poisson_ratio, rtol), stiffening_(1 / (1 - poisson_ratio * poisson_ratio)), rtol_(rtol) {}

/// The value of a panel and its error.
void PanelSolver::add_hysteresis(std::size_t index, double scale, const ContactIntegral& contact) {
  ActivePanel& active = active_[index];
  const Panel& p = panels_[active.panel];
  OnPanel at;
  at.g_upper = ends_.g[index];
  if (at.g_upper < contact.whole) {  // F = G
    active.value = p.full * scale;
    active.error = p.full_error * scale;
    active.outside = p.any_outside ? p.full_outside * scale : 0;
    return;
  }
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  const Kernels& loops = kernels();
  const double* const slope = panels_.row(p, Panel::slope);
  const double f_lower = index == 0 ? 0 : ends_.f[index - 1];
  at.by_parts_twice = p.by_parts_twice && contact.has_second;
  at.g_lower = active.g_lower * scale;
  at.f_upper = ends_.f[index];
  at.f2_upper = ends_.f2[index];
  at.rise = at.f_upper - f_lower;
  loops.g_at_nodes(active.g_lower, panels_.row(p, Panel::cumulative), scale, n, at.g);
  loops.contact_integral(contact.table, at.g, n, at.f, at.by_parts_twice ? at.f2 : nullptr);
  loops.error_projection(rule, slope, at.g, f_lower, at.f, at.by_g, at.by_r);
  if (at.by_parts_twice) {
    // by parts once more: int F dR = F2 dR/dG at the upper end - int F2 d(dR/dG)
    const double* const curvature = panels_.row(p, Panel::curvature);
    loops.sum(rule, curvature, at.f2, at.sums);
    at.first_slope = curvature[0];
    active.value = p.r.upper * at.f_upper - (p.dr_dg.upper * at.f2_upper - at.sums.value) * (1 / scale);
  } else {
    loops.sum(rule, slope, at.f, at.sums);
    at.first_slope = slope[0];
    active.value = p.r.upper * at.rise - at.sums.value;
  }
  if (p.any_outside) {
    const double* outside = panels_.row(p, Panel::outside_slope);
    double part = 0;
    for (std::size_t i = 0; i < n; ++i) part += outside[i] * at.f[i];
    active.outside = p.outside_upper * at.rise - part;
  }
  active.error = hysteresis_error(p, at, scale, contact.gamma);
}

void PanelSolver::evaluate(double scale, const ContactIntegral* contact) {
  double g = 0, g_error = 0;
  g_relative_error_ = 0;
  hysteresis_ = {};
  const std::size_t n = active_.size(), room = (n + lanes - 1) / lanes * lanes;
  for (auto* const column : {&ends_.g, &ends_.f, &ends_.f2}) column->resize(room);
  for (std::size_t i = 0; i < n; ++i) {
    ActivePanel& active = active_[i];
    const Panel& p = panels_[active.panel];
    active.g_lower = g;
    g += p.g_total;
    g_error += p.g_error;
    active.g_part = p.g_error / g;
    g_relative_error_ = std::max(g_error / g, g_relative_error_);
    ends_.g[i] = g * scale;
  }
  if (!contact) return;
  std::fill(ends_.g.begin() + static_cast<std::ptrdiff_t>(n), ends_.g.end(), 1.0);
  kernels().contact_integral(contact->table, ends_.g.data(), room, ends_.f.data(), ends_.f2.data());
  for (std::size_t i = 0; i < n; ++i)
    if (ends_.g[i] < contact->whole) ends_.f[i] = ends_.g[i];
  for (std::size_t i = 0; i < n; ++i) {
    add_hysteresis(i, scale, *contact);
    hysteresis_.value += active_[i].value;
    hysteresis_.error += active_[i].error;
    hysteresis_.outside += active_[i].outside;
  }
}

/// Replaces each panel that has more than its part of the error by its halves.
void PanelSolver::refine(bool hysteresis_good, bool g_good) {
  double worst = 0, g_worst = 0;
  for (const ActivePanel& active : active_) {
    worst = std::fmax(worst, active.error);
    g_worst = std::fmax(g_worst, active.g_part);
  }
  const double part = 1 / static_cast<double>(active_.size()), none = std::numeric_limits<double>::infinity();
  const double allowed = hysteresis_good ? none : std::fmin(worst / 2, 0.1 * part * rtol_ * hysteresis_.value);
  const double g_allowed = g_good ? none : std::fmin(g_worst / 2, 0.03 * part * rtol_);
  next_.clear();
  for (const ActivePanel& active : active_) {
    if (active.error <= std::fmax(allowed, 1e-3 * worst) && active.g_part <= g_allowed) {
      next_.push_back(active);
      continue;
    }
    const std::size_t child = panels_.children(active.panel);
    next_.push_back({child});
    next_.push_back({child + 1});
  }
  active_.swap(next_);
}

void PanelSolver::solve(double pressure, double shift, const ContactIntegral* contact) {
  scale_ = 1 / (pressure * shift) / (pressure * shift);
  mu_factor_ = 4 * pressure / stiffening_;
  density_factor_ = stiffening_ / (2 * pressure * shift * shift);
  active_.clear();
  for (const std::size_t root : panels_.roots()) active_.push_back({root});
  double g_end = 0;
  for (const std::size_t root : panels_.roots()) g_end += panels_[root].g_total;
  if (!active_.empty()) check_g(g_end * scale_, pressure);
  constexpr int most_rounds = 60;
  const std::size_t most_panels = 20000 + 4 * active_.size();
  for (int round = 0;; ++round) {
    evaluate(scale_, contact);
    const bool good = hysteresis_.error <= 0.85 * rtol_ * hysteresis_.value, g_good = g_relative_error_ <= rtol_ / 16;
    if (good && g_good) break;
    if (round == most_rounds || active_.size() > most_panels)
      throw NotConverged("mu_H = " + show(mu_factor_ * hysteresis_.value) + " with error " +
                         show(mu_factor_ * hysteresis_.error) + ", G with relative error " + show(g_relative_error_) +
                         " on " + std::to_string(active_.size()) + " panels where " + argument("rtol") + " = " +
                         show(rtol_) + " was asked for");
    refine(good, g_good);
  }
  hysteresis_.value *= mu_factor_;
  hysteresis_.error *= mu_factor_;
  hysteresis_.outside *= mu_factor_;
}

const PanelSolver::ActivePanel& PanelSolver::panel_at(double wavenumber) const {
  const auto after = std::ranges::partition_point(active_, [&](const ActivePanel& active) {
    const Panel& p = panels_[active.panel];
    return p.segment->a <= wavenumber && p.s(p.lower) <= p.segment->offset(wavenumber);
  });
  return after == active_.begin() ? *after : *(after - 1);
}

double PanelSolver::g(double wavenumber) const {
  if (active_.empty()) return 0;
  if (const ActivePanel& last = active_.back(); wavenumber >= panels_[last.panel].segment->b)
    return (last.g_lower + panels_[last.panel].g_total) * scale_;
  const ActivePanel& active = panel_at(wavenumber);
  const Panel& p = panels_[active.panel];
  const double s = p.segment->offset(wavenumber);
  const bool whole = wavenumber >= p.segment->b || s >= p.s(p.upper);
  return (active.g_lower + (whole ? p.g_total : panels_.g_to(p, s))) * scale_;
}

double PanelSolver::relative_error() const { return std::max(g_relative_error_, least_share * rtol_); }

double PanelSolver::full_density(double wavenumber) const {
  if (active_.empty()) return 0;
  const Segment& segment = *panels_[panel_at(wavenumber).panel].segment;
  if (wavenumber < segment.a || wavenumber > segment.b) return 0;  // in an empty bin
  const double square = wavenumber * wavenumber;
  return density_factor_ * square * square * segment.density(wavenumber) * panels_.angular(wavenumber).i1;
}

std::vector<ContactGrid::PanelSum> PanelSolver::shares() const {
  std::vector<ContactGrid::PanelSum> result;
  result.reserve(active_.size());
  for (const ActivePanel& active : active_) {
    const Panel& p = panels_[active.panel];
    const double a = p.segment->a;
    result.push_back({a * std::exp(p.s(p.lower)), a * std::exp(p.s(p.upper)), active.value * mu_factor_});
  }
  return result;
}

}  // namespace asperity
