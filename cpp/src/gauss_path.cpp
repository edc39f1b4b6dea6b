#include "gauss_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "checks.hpp"

namespace asperity {

namespace {

constexpr std::size_t most = LegendreRule::most, tails = LegendreRule::tails;
constexpr double rounding = 2e-15;

/// Between the sum of the errors and the tolerance: the further below the tolerance the sum is, the more of that may be
/// chance. Measured: with 4 and 0.75 one of 30,000 random scenes (tests/stability) had an error above it.
double cautious(double error, double tolerance) {
  return tolerance > 0 ? 8 * tolerance * std::pow(error / tolerance, 0.8) : error;
}

}  // namespace

GaussPath::GaussPath(std::span<const Segment> surface, const Rubber& rubber, double poisson_ratio, double rtol)
    : panels_(surface, rubber, poisson_ratio, rtol),
      stiffening_(1 / (1 - poisson_ratio * poisson_ratio)),
      rtol_(rtol) {}

/// Value and error of one panel; gives F at its upper end. Three errors add up: what the last Legendre coefficients of
/// dG and R do to the value, and with them the next ones; that of the rule on F dR, as F may be rougher than either;
/// and a front that is narrower than the distance of the nodes.
double GaussPath::add_hysteresis(Visit& visit, double scale, const FrontIntegral& front, double f_lower) const {
  const Panel& p = panels_[visit.panel];
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  const double *cumulative = panels_.row(p, Panel::cumulative), *slope = panels_.row(p, Panel::slope);
  double f[most], passed[most];  // F, and weight R' dF/dG
  double sum = 0, change = 0, seen = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double g = std::fmax(0, (visit.g_lower + cumulative[i]) * scale);
    f[i] = front(g);
    passed[i] = slope[i] * (g > 0 ? f[i] / g : 1);  // F / G bounds dF/dG from above
    sum += slope[i] * f[i];
    change += std::fabs(slope[i]);
    if (g < 2) ++seen;
  }
  const double f_upper = front((visit.g_lower + p.g_total) * scale);
  visit.value = p.r_upper * f_upper - p.r_lower * f_lower - sum;

  double series[tails], f_tail[tails];
  for (std::size_t k = 0; k < tails; ++k) {
    const double *integral = rule.tail_integral[k].data(), *derivative = rule.tail_derivative[k].data(),
                 *coefficient = rule.tail[k].data();
    double by_g = 0, by_r = 0, of_f = 0;
#pragma omp simd reduction(+ : by_g, by_r, of_f)
    for (std::size_t i = 0; i < n; ++i) {
      by_g += passed[i] * integral[i];
      by_r += f[i] * derivative[i];
      of_f += f[i] * coefficient[i];
    }
    f_tail[k] = of_f;
    const double at_lower = (n - 1 - k) % 2 ? -f_lower : f_lower;
    series[k] = std::fabs(p.g_tail[k] * scale * by_g) + std::fabs(p.r_tail[k] * (f_upper - at_lower - by_r));
  }
  // two terms that are small by chance are seen by the two before them, which fall to the next like a geometric series
  const double end = series[0] + series[1], before = series[2] + series[3], size = std::fabs(visit.value) + before;
  const double falling = before > 0 ? std::pow(before / size, 2 / (static_cast<double>(n) - 3)) : 0;
  const double next = 5 * end + before * falling;
  const double f_end = std::fmax(std::fabs(f_tail[0]), std::fabs(f_tail[1]));
  const double r_end = std::fmax(std::fabs(p.r_tail[0]), std::fabs(p.r_tail[1]));
  const double of_rule = f_upper > 0 ? 2 * f_end * (8 * r_end + 4 * f_end / f_upper * change) : 0;
  double hidden = 0;
  // below G = 1 F leaves the straight line in sqrt(G) that it follows above; 0.3 is the integral of what it misses
  if (visit.g_lower * scale < 1 && (visit.g_lower + p.g_total) * scale > 4 && p.g_total > 4 * visit.g_lower)
    hidden =
        0.3 * std::fabs(slope[0]) / rule.weight[0] * (1 + rule.node[0]) / (cumulative[0] * scale) * std::pow(0.1, seen);
  visit.error = next + of_rule + hidden + rounding * std::fabs(p.r_upper) * f_upper;
  if (p.any_outside) {
    const double* outside = panels_.row(p, Panel::outside_slope);
    double part = 0;
    for (std::size_t i = 0; i < n; ++i) part += outside[i] * f[i];
    visit.outside = p.outside_upper * f_upper - p.outside_lower * f_lower - part;
  }
  return f_upper;
}

void GaussPath::evaluate(double scale, const FrontIntegral* front) {
  double g = 0, g_error = 0, f = 0;
  g_relative_error_ = 0;
  hysteresis_ = {};
  for (Visit& visit : visits_) {
    const Panel& p = panels_[visit.panel];
    visit.g_lower = g;
    if (front) {
      f = add_hysteresis(visit, scale, *front, f);
      hysteresis_.value += visit.value;
      hysteresis_.error += visit.error;
      hysteresis_.outside += visit.outside;
    }
    g += p.g_total;
    g_error += p.g_error;
    visit.g_part = p.g_error / g;
    g_relative_error_ = std::fmax(g_relative_error_, g_error / g);
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
  constexpr int most_rounds = 60;
  constexpr std::size_t most_panels = 20000;
  for (int round = 0;; ++round) {
    evaluate(scale_, front);
    hysteresis_.error = cautious(hysteresis_.error, rtol_ * hysteresis_.value);
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
  const Visit& visit = visit_at(wavenumber);
  const Panel& p = panels_[visit.panel];
  const double s = p.segment->offset(wavenumber);
  const bool whole = wavenumber >= p.segment->b || s >= p.s(p.upper);
  return (visit.g_lower + (whole ? p.g_total : panels_.g_to(p, s))) * scale_;
}

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
