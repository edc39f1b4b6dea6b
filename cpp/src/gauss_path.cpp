#include "gauss_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "checks.hpp"
#include "contact_checks.hpp"
#include "kernels.hpp"
#include "panel_error.hpp"

namespace asperity {

namespace {

constexpr std::size_t most = LegendreRule::most, tails = LegendreRule::tails;
constexpr double rounding = 1e-15;

/// The further below the tolerance a sum of errors is, the more of that may be chance. With a power of 0.06 and less of
/// the rule's, 16 of 40,000 random scenes (tests/stability) had an error above it, by 5 times at most.
double cautious(double error, double tolerance) {
  if (!(error > 0 && error < tolerance)) return error;
  return std::fmax(1.25 * error * std::pow(tolerance / error, 0.15), 1e-7 * tolerance);
}

double larger_of(double a, double b) { return std::fmax(std::fabs(a), std::fabs(b)); }

}  // namespace

GaussPath::GaussPath(std::span<const Segment> surface, const Rubber& rubber, double poisson_ratio, double rtol)
    : panels_(surface, rubber, poisson_ratio, rtol),
      stiffening_(1 / (1 - poisson_ratio * poisson_ratio)),
      rtol_(rtol) {}

/// F at the nodes of a panel; what follows of it for the value and its error.
struct GaussPath::Sample {
  double g[most], f[most], f2[most];       // F less that at the lower end
  double g_lower, g_upper, f_upper, rise;  // `rise` of F over the panel
  double f2_upper;
  double change;   // int |dR|
  PanelSums sums;  // of F dR, or of F2 d(dR/dG)
};

/// Value of one panel and its error.
void GaussPath::add_hysteresis(std::size_t index, double scale, const FrontIntegral& front) {
  Visit& visit = visits_[index];
  const Panel& p = panels_[visit.panel];
  Sample at;
  at.g_upper = ends_.g[index];
  if (at.g_upper < front.whole) {  // F = G
    visit.value = p.full * scale;
    visit.error = p.full_error * scale;
    visit.outside = p.any_outside ? p.full_outside * scale : 0;
    return;
  }
  const double f_lower = index == 0 ? 0 : ends_.f[index - 1];
  at.g_lower = visit.g_lower * scale;
  at.f_upper = ends_.f[index];
  at.f2_upper = ends_.f2[index];
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  const Kernels& loops = kernels();
  const double *cumulative = panels_.row(p, Panel::cumulative), *slope = panels_.row(p, Panel::slope);
  const bool twice = p.twice && front.has_second;
  for (std::size_t i = 0; i < n; ++i) {
    const double here = (visit.g_lower + cumulative[i]) * scale;
    at.g[i] = here > 0 ? here : 0;  // an interpolated G may be below at the first nodes
  }
  loops.front(front.table, front.gamma, at.g, n, at.f, twice ? at.f2 : nullptr);
  at.rise = at.f_upper - f_lower;
  double passed[most], by_g[tails], by_r[tails];
  for (std::size_t i = 0; i < n; ++i) passed[i] = slope[i] * (at.g[i] > 0 ? at.f[i] / at.g[i] : 1);  // F / G bounds P S
  for (std::size_t i = 0; i < n; ++i) at.f[i] -= f_lower;  // a constant falls out, and takes its rounding along
  loops.project(rule, at.f, passed, by_g, by_r);
  loops.sum(rule, slope, at.f, at.sums);
  at.change = at.sums.change;
  if (p.any_outside) {
    const double* outside = panels_.row(p, Panel::outside_slope);
    double part = 0;
    for (std::size_t i = 0; i < n; ++i) part += outside[i] * at.f[i];
    visit.outside = p.outside_upper * at.rise - part;
  }
  double effect[tails];
  for (std::size_t k = 0; k < tails; ++k)
    effect[k] = std::fabs(p.g_tail[k] * scale * by_g[k]) + std::fabs(p.r_tail[k] * (at.rise - by_r[k]));
  // F may fall slower than dG and R do
  const double earlier = larger(at.sums.f_tail, 4), falling = earlier > 0 ? larger(at.sums.f_tail, 0) / earlier : 0;
  const double decay = std::clamp(std::sqrt(std::sqrt(falling)), p.decay, 0.9);
  if (twice) {
    // by parts once more: int F dR = F2 dR/dG at the upper end - int F2 d(dR/dG)
    loops.sum(rule, panels_.row(p, Panel::curvature), at.f2, at.sums);
    visit.value = p.r_upper * at.f_upper - (p.curvature_upper * at.f2_upper - at.sums.value) * (1 / scale);
  } else {
    visit.value = p.r_upper * at.rise - at.sums.value;
  }
  visit.error = 3 * following(effect, p.decay * decay) + error_of_rule(p, at, scale, front.gamma, decay, twice);
}

/// Of the rule on F dR (or F2 d(dR/dG)), as F may be rougher than either, and on the foot of a front; of rounding.
double GaussPath::error_of_rule(const Panel& p, const Sample& at, double scale, double gamma, double decay,
                                bool twice) const {
  const LegendreRule& rule = *p.rule;
  double digits =
      rounding * (static_cast<double>(rule.n) * larger_of(p.r_lower, p.r_upper) * at.rise + 4 * at.change * at.f_upper);
  double f_size = at.rise, r_change = at.sums.change, missed = 0;
  double r_end = larger(p.r_tail, 0), r_middle = larger(p.r_tail, tails);
  const auto foot = [&](const Foot& error, double first_slope) {
    return error(at.g[0], gamma) * std::fabs(first_slope) / rule.weight[0] * (1 + rule.node[0]) / at.g[0];
  };
  if (twice) {
    const double per_g = 1 / scale;
    f_size = at.f2_upper;
    if (at.g[0] > 0) missed = foot(foot_of_f2, panels_.row(p, Panel::curvature)[0]) * per_g;
    r_end = larger(p.curvature_tail, 0) * per_g;
    r_middle = larger(p.curvature_tail, tails) * per_g;
    r_change *= per_g;
    digits += rounding * larger_of(p.curvature_lower, p.curvature_upper) * f_size * per_g;
  } else {
    const bool from_front = at.g_lower < 1 && at.g[0] > 4 * at.g_lower;  // where a spectrum jumps, G as good as begins
    // sqrt(G) is as the square root of s beside a front, and as s where the rate is 0 or the panel's variable is s
    const double broader = p.rooted ? 1 : 7 * std::fmax(1, std::sqrt(at.g[0]));
    if (from_front) missed = broader * foot(foot_of_f, panels_.row(p, Panel::slope)[0]);
  }
  const bool breaks_up = at.g_upper > 0.03 && (p.at_front ? at.g[0] < 2e-4 : at.g_lower < 1);
  const BreakUp rough = breaks_up ? break_up(rule, at.g) : BreakUp{};
  const double f_end = larger(at.sums.f_tail, 0);
  const double beyond = std::fmax(beyond_rule(f_size, at.sums.f_tail, decay, rough.growth), f_end * rough.least);
  // pairs of a coefficient of F from n on and one of dR before n: the last, the middle, the first
  const double of_rule = f_end * r_end + 2 * std::sqrt(f_end) * std::sqrt(beyond) * r_middle + beyond * r_change;
  return of_rule + 5 * (missed + digits);
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
    g_relative_error_ = std::fmax(g_relative_error_, g_error / g);
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
