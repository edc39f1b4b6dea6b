// Panels of ln q on which dG/ds = q^4 C I2(v q) / (8 (1 - nu^2)^2) and R = I1 / I2 are polynomials through
// Gauss-Legendre nodes: their ends, their numbers of nodes, and the derivatives that the hysteresis by parts takes.
// Eqs 7 and 22; B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/solver/panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/solver/panel_error.hpp"
#include "numerics/arguments.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

namespace {

constexpr std::size_t most = LegendreRule::most;
constexpr double longest = 4;  // in s: on longer panels the last coefficients understate the error
constexpr double beside_front = 2.5;
constexpr double most_change = 12;               // powers of e by which q^4 C changes along a panel
constexpr double most_rise = 10, most_fall = 5;  // the same along the panel beside the front
constexpr double rounding = 4e-16;
constexpr double front_share = 0.125;  // of a panel in t on a ramp from zero: most is to be resolved at its foot

double length_of(const Panel& panel) { return panel.s(panel.upper) - panel.s(panel.lower); }

/// Powers of e by which q^4 C changes along a unit of s at most.
double steepness(const Segment& segment) { return segment.straight ? 5 : std::fabs(4 + segment.slope); }

double change_of(const Panel& panel) { return steepness(*panel.segment) * length_of(panel); }

/// By how much coefficients fall from degree to degree: as the ellipse about the panel allows that reaches the nearest
/// singularity, which lies pi / 2 off the real axis of ln w for a Prony series and at the knot before for a table.
double decay_of(const Panel& panel) {
  const double decay = std::exp(-std::asinh(std::numbers::pi / length_of(panel)) * (panel.square > 0 ? 0.75 : 1));
  constexpr double with_knots = 0.35;
  return panel.tabulated ? std::fmax(decay, with_knots) : decay;
}

/// The same for a power law, which has no singularity, at degree n: coefficients are bounded by exp(change rho / 4)
/// rho^-n on every ellipse rho, in the root by exp(change (1 + rho / 2)^2 / 4) rho^-n, and this is the least of them.
/// dR/dG has a pole at a row of zero, on rho = 3.4 of a panel that ends half way to it.
double decay_of_power(const Panel& panel, double n) {
  const double change = change_of(panel), zero = panel.at_front && panel.segment->at_b == 0 ? 0.3 : 0;
  if (change == 0) return zero;
  return std::fmax(zero, panel.square > 0 ? 1 / (std::sqrt(1 + 8 * n / change) - 1) : change / (4 * n));
}

/// The length in s of the first panel. R is differentiated by G on it: dR/dG grows as q^4 C falls, and has a pole where
/// that comes to zero, so that the panel ends half way to a row of zero.
double front_reach(const Segment& segment) {
  const double power = 4 + segment.slope;
  const double reach = std::fmin(beside_front, power < 0 ? most_fall / -power : most_rise / power);
  return segment.at_b == 0 ? std::fmin(reach, segment.offset(segment.a + (segment.b - segment.a) / 2)) : reach;
}

/// Errors of the rule fall by the square of `decay` a node; a power law C q^4 needs nodes of its own. There is a least
/// number, as the last of few coefficients do not tell the error.
std::size_t nodes_for(const Panel& panel, double rtol) {
  const double digits = -std::log10(rtol);
  // at the front F is rougher, elsewhere the square root lies off the panel
  const double falling = -std::log(panel.decay) * (panel.at_front ? 0.77 : panel.tabulated ? 1 : 1.2);
  const double nodes = 4 + digits * std::numbers::ln10 / (2 * falling);
  return static_cast<std::size_t>(std::ceil(std::fmax(nodes, std::fmax(8 + change_of(panel), panel.grows ? 12 : 8))));
}

}  // namespace

double Panel::t(double at) const {
  const double from_start = at - start, half = linear / 2;
  return square > 0 ? from_start / (half + std::sqrt(half * half + from_start)) : from_start / linear;
}

Panels::Panels(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio, double rtol)
    : surface_(surface), waves_(waves), rtol_(rtol) {
  const double stiffening = 1 / (1 - poisson_ratio * poisson_ratio);
  g_factor_ = stiffening * stiffening / 8;
}

/// The nodes of the panel's rule from its lower end up to `upper`.
void Panels::roughness_at_nodes(const Panel& p, double upper, double* wavenumber, double* roughness) const {
  const double middle = (p.lower + upper) / 2, half = (upper - p.lower) / 2;
  for (std::size_t i = 0; i < p.rule->n; ++i) {
    const double t = middle + half * p.rule->node[i], s = p.s(t), q = p.segment->a * std::exp(s);
    wavenumber[i] = q;
    roughness[i] = g_factor_ * (q * q) * (q * q) * p.segment->density_at(s) * (half * (p.linear + 2 * p.square * t));
  }
}

std::size_t Panels::add(Panel panel) {
  panel.tabulated = std::holds_alternative<MasterCurve>(waves_.rubber());
  panel.decay = decay_of(panel);
  panel.rule = &legendre_rule(nodes_for(panel, rtol_));
  panel.decay = std::fmin(0.95, std::fmax(panel.decay, decay_of_power(panel, static_cast<double>(panel.rule->n))));
  panel.decay_to_n = std::pow(panel.decay, static_cast<double>(panel.rule->n));
  panel.data = data_.size();
  panel.child = panel.filled = 0;
  data_.resize(data_.size() + Panel::rows * panel.rule->n);
  roughness_at_nodes(panel, panel.upper, &data_[panel.data + Panel::wavenumber * panel.rule->n],
                     &data_[panel.data + Panel::roughness * panel.rule->n]);
  panels_.push_back(panel);
  return panels_.size() - 1;
}

void Panels::differentiate(const Panel& panel, const double* f, double* slope, Panel::Smooth& of) {
  const std::size_t n = panel.rule->n;
  kernels().differentiate(*panel.rule, f, slope, &of.lower, &of.upper, of.tail);
  of.change = 0;
  for (std::size_t i = 0; i < n; ++i) of.change += std::fabs(slope[i]);
  const double last = std::fmax(larger(of.tail, 0), larger(of.tail, 1) * panel.decay);
  of.far = last * panel.decay_to_n;
}

void Panels::fill(Panel& p) {
  if (p.filled == starts_) return;
  p.filled = starts_;
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  const Kernels& loops = kernels();
  double* const rows = &data_[p.data];
  double w[most], i1[most], i2[most], i1_outside[most], dg[most], ratio[most], tail[LegendreRule::kept];
  for (std::size_t i = 0; i < n; ++i) w[i] = velocity_ * rows[Panel::wavenumber * n + i];
  p.any_outside = waves_.of_waves({w, n}, {rows + Panel::wavenumber * n, n}, {i1, n}, {i2, n}, {i1_outside, n});
  for (std::size_t i = 0; i < n; ++i) {
    dg[i] = rows[Panel::roughness * n + i] * i2[i];
    ratio[i] = i1[i] / i2[i];
  }
  // dG begins as t beside a front, and as t^3 on a ramp from zero
  const auto& columns = !p.at_front       ? rule.cumulative
                        : p.sqrt_endpoint ? rule.cumulative_linear
                                          : rule.cumulative_cubic;
  loops.integrate(rule, columns, dg, rows + Panel::cumulative * n, &p.g_total, p.g_tail);
  double* const slope = rows + Panel::slope * n;
  differentiate(p, ratio, slope, p.r);
  for (std::size_t i = 0; i < n; ++i) ratio[i] *= dg[i];
  loops.add_up(rule, ratio, &p.full, tail);
  p.full_error = 10 * beyond_rule(*std::max_element(ratio, ratio + n), tail, p.decay, analytic) + rounding * p.full;
  if (p.by_parts_twice) {
    for (std::size_t i = 0; i < n; ++i) ratio[i] = slope[i] / (rule.weight[i] * dg[i]);
    differentiate(p, ratio, rows + Panel::curvature * n, p.dr_dg);
  }
  if (p.any_outside) {
    p.full_outside = 0;
    for (std::size_t i = 0; i < n; ++i) {
      ratio[i] = i1_outside[i] / i2[i];
      p.full_outside += rule.weight[i] * ratio[i] * dg[i];
    }
    loops.differentiate(rule, ratio, rows + Panel::outside_slope * n, &p.outside_lower, &p.outside_upper, tail);
  }
  p.g_error = 4 * beyond_rule(*std::max_element(dg, dg + n), p.g_tail, p.decay, analytic) + rounding * p.g_total;
}

std::size_t Panels::children(std::size_t index) {
  if (panels_[index].child == 0) {
    Panel first = panels_[index], second = first;
    const double share = first.at_front && !first.by_parts_twice ? front_share : 0.5;
    first.upper = second.lower = first.lower + share * (first.upper - first.lower);
    second.at_front = second.by_parts_twice = second.sqrt_endpoint = false;
    const std::size_t child = add(first);
    (void)add(second);
    panels_[index].child = child;
  }
  const std::size_t child = panels_[index].child;
  fill(panels_[child]);
  fill(panels_[child + 1]);
  return child;
}

void Panels::find_edges(const Segment& segment, bool front, std::span<const double> stops,
                        std::span<const double> knots) {
  const double end = segment.length();
  edges_.assign({0, end});
  const auto cut = [&](double s) {
    if (s > 0 && s < end) edges_.push_back(s);
  };
  const double start = front ? front_reach(segment) : 0, steep = steepness(segment);
  const double pieces = std::ceil((end - start) * std::fmax(1 / longest, steep / most_change));
  cut(start);
  for (double i = 1; i < pieces; ++i) cut(start + (end - start) * i / pieces);
  for (const double q : stops)
    if (q > segment.a && q < segment.b) cut(segment.offset(q));
  const auto first = std::ranges::upper_bound(knots, velocity_ * segment.a);
  for (auto knot = first; knot != knots.end() && *knot < velocity_ * segment.b; ++knot)
    cut(segment.offset(*knot / velocity_));
  std::ranges::sort(edges_);
  const auto repeated = std::ranges::unique(edges_);
  edges_.erase(repeated.begin(), repeated.end());
}

/// The roughness alone tells where the front lies, as I2 changes slowly beside it.
void Panels::lay_out(std::span<const double> stops) {
  panels_.clear();
  data_.clear();
  roots_.clear();
  const auto* curve = std::get_if<MasterCurve>(&waves_.rubber());
  const std::span<const double> knots = curve ? curve->knots() : std::span<const double>{};
  double before = 0;  // int q^4 C ds
  for (const Segment& segment : surface_) {
    if (segment.at_a == 0 && segment.at_b == 0) continue;
    find_edges(segment, before == 0, stops, knots);
    double here = before;
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) here = lay_out(segment, edges_[i], edges_[i + 1], before, here);
    before = here;
  }
  laid_out_ = !curve && stops.empty();
}

/// Panels from a knot to the next edge; `before` and `here` are int q^4 C ds up to the segment and to the knot, and
/// what is returned is that up to the edge.
double Panels::lay_out(const Segment& segment, double knot, double end, double before, double here) {
  const bool table = std::holds_alternative<MasterCurve>(waves_.rubber());
  bool on_ramp = false;
  double from = knot;
  while (from < end) {
    const double length = end - from, q = segment.a * std::exp(from);
    const double rate = (q * q) * (q * q) * segment.density_at(from);
    const double behind = here == 0 ? 0 : rate > 0 ? here / rate : 1e300;  // how far back G would be 0
    Panel p{};
    p.segment = &segment;
    p.start = from;
    p.at_front = here == 0;
    p.by_parts_twice = p.at_front && rate > 0 && !table && !waves_.softening();
    double to = end;
    // R of a table has a root in it at the knot, sqrt(G) one before, or one on either side of it where a ramp from
    // zero begins: panels that grow away from both
    const double ramp =
        from == 0 && rate == 0 && here > 0 ? length * std::sqrt(here / segment.moment(3, segment.b)) : 0;
    if (ramp > 0 && ramp < length / 2) on_ramp = true;
    if (on_ramp || (table && here > 0 && behind <= length / 4))
      to = std::fmin(end, from > knot ? from + 3 * (from - knot) : from + (on_ramp ? ramp : 2 * behind));
    const double part = to - from;
    if (here == 0 || (table && from == knot)) {
      p.square = 1;
      p.upper = std::sqrt(part);
    } else if (behind < 4 * part) {
      p.linear = 2 * std::sqrt(behind);
      p.square = 1;
      p.upper = part / (std::sqrt(behind) + std::sqrt(behind + part));
    } else {
      p.linear = 1;
      p.upper = part;
    }
    const double there = before + segment.moment(3, to < segment.length() ? segment.a * std::exp(to) : segment.b);
    p.grows = there > 4 * here;
    p.sqrt_endpoint = p.square > 0 && p.linear == 0 && rate > 0;
    roots_.push_back(add(p));
    from = to;
    here = there;
  }
  return here;
}

void Panels::start(double velocity, std::span<const double> stops) {
  velocity_ = velocity;
  ++starts_;
  if (!laid_out_ || !stops.empty()) lay_out(stops);
  for (const std::size_t root : roots_) fill(panels_[root]);
}

double Panels::g_to(const Panel& panel, double s) const {
  const double t = panel.t(s);
  if (!(t > panel.lower)) return 0;
  const std::size_t n = panel.rule->n;
  double q[most], w[most], roughness[most], i1[most], i2[most], i1_outside[most];
  roughness_at_nodes(panel, t, q, roughness);
  for (std::size_t i = 0; i < n; ++i) w[i] = velocity_ * q[i];
  (void)waves_.of_waves({w, n}, {q, n}, {i1, n}, {i2, n}, {i1_outside, n});
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += panel.rule->weight[i] * roughness[i] * i2[i];
  return sum;
}

}  // namespace asperity
