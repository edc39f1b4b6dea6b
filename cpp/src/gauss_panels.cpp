#include "gauss_panels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks.hpp"

namespace asperity {

namespace {

constexpr std::size_t most = LegendreRule::most, tails = LegendreRule::tails;
constexpr double longest = 4;  // in s: on longer ones the last coefficients told errors too small by up to 2000
constexpr double rounding = 4e-16;
constexpr double front_share = 0.125;  // of a panel in t, for the panel within it that begins at the front
constexpr double one_panel = 3e-7;     // the tolerance below which a front has a panel of its own from the start

double dot(std::size_t n, const LegendreRule::Row& row, const double* values) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += row[i] * values[i];
  return sum;
}

void multiply(std::size_t n, const std::array<LegendreRule::Row, most>& columns, const double* values, double* result) {
  for (std::size_t i = 0; i < n; ++i) result[i] = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) result[i] += columns[j][i] * values[j];
}

}  // namespace

// The coefficients fall on from degree n - 1 to 2 n, at the rate of the last four or that from the first on, whichever
// is slower. Two at a time, as one of a pair may vanish by symmetry, and two that are small by chance are seen by the
// two before them.
double gauss_error(const double* tail, double size, std::size_t n) {
  const double end = std::fmax(std::fabs(tail[0]), std::fabs(tail[1]));
  const double before = std::fmax(std::fabs(tail[2]), std::fabs(tail[3]));
  if (end == 0) return 0;
  const auto nodes = static_cast<double>(n);
  const double falling = before > end ? std::pow(end / before, nodes / 2) : 1;
  const double expected = before * std::pow(before / (size + before), 2 / (nodes - 3));
  const double worst = std::fmax(end, expected);
  return std::fmax(2 * end * falling, 4 * worst * (worst / size));
}

double Panel::t(double at) const {
  const double from_start = at - start, half = linear / 2;
  return square > 0 ? from_start / (half + std::sqrt(half * half + from_start)) : from_start / linear;
}

GaussPanels::GaussPanels(std::span<const Segment> surface, const Rubber& rubber, double poisson_ratio, double rtol)
    : surface_(surface), rubber_(rubber), rtol_(rtol) {
  const double stiffening = 1 / (1 - poisson_ratio * poisson_ratio);
  g_factor_ = stiffening * stiffening / 8;
}

/// Nodes that carry the tolerance on most panels: I1 and I2 of a Prony series have their poles pi / 2 off the real
/// axis of ln w, and convergence goes with the ellipse about the panel that reaches them.
std::size_t GaussPanels::nodes_for(const Panel& panel) const {
  const double length = panel.s(panel.upper) - panel.s(panel.lower);
  const double convergence = std::asinh(std::numbers::pi / length) * (panel.square > 0 ? 0.75 : 1);
  const double digits = 1 - std::log10(rtol_), smooth = 4 + digits * std::numbers::ln10 / (2 * convergence);
  return static_cast<std::size_t>(panel.at_front ? std::fmax(smooth, 4 + 1.3 * digits) : smooth);
}

struct GaussPanels::Nodes {
  double ds[most];  // ds/du, u from -1 to 1
  double g[most];   // dG/du
  double i1[most], i2[most], i1_outside[most];
  bool outside;
};

/// The panel's rule from its lower end up to `upper`.
void GaussPanels::sample(const Panel& p, double upper, Nodes& nodes) const {
  const std::size_t n = p.rule->n;
  const double middle = (p.lower + upper) / 2, half = (upper - p.lower) / 2;
  double w[most];
  for (std::size_t i = 0; i < n; ++i) {
    const double t = middle + half * p.rule->node[i], s = p.s(t), q = p.segment->a * std::exp(s);
    w[i] = velocity_ * q;
    nodes.ds[i] = half * (p.linear + 2 * p.square * t);
    nodes.g[i] = g_factor_ * (q * q) * (q * q) * p.segment->density_at(s) * nodes.ds[i];
  }
  nodes.outside = angular_integrals(rubber_, {w, n}, nodes.i1, nodes.i2, nodes.i1_outside);
  for (std::size_t i = 0; i < n; ++i) nodes.g[i] *= nodes.i2[i];
}

void GaussPanels::fill(Panel& p) {
  const LegendreRule& rule = *p.rule;
  const std::size_t n = rule.n;
  Nodes nodes;
  sample(p, p.upper, nodes);
  double ratio[most] = {};
  const auto slopes = [&](const double* numerator, Panel::Row row, double& lower, double& upper) {
    for (std::size_t i = 0; i < n; ++i) ratio[i] = numerator[i] / nodes.i2[i];
    double* const result = &data_[p.data + row * n];
    multiply(n, rule.derivative, ratio, result);
    for (std::size_t i = 0; i < n; ++i) result[i] *= rule.weight[i];
    lower = dot(n, rule.at_lower, ratio);
    upper = dot(n, rule.at_upper, ratio);
  };
  p.any_outside = nodes.outside;
  if (p.any_outside) slopes(nodes.i1_outside, Panel::outside_slope, p.outside_lower, p.outside_upper);
  slopes(nodes.i1, Panel::slope, p.r_lower, p.r_upper);
  multiply(n, rule.cumulative, nodes.g, &data_[p.data + Panel::cumulative * n]);
  p.g_total = dot(n, rule.weight, nodes.g);
  for (std::size_t k = 0; k < tails; ++k) {
    p.g_tail[k] = dot(n, rule.tail[k], nodes.g);
    p.r_tail[k] = dot(n, rule.tail[k], ratio);
  }
  p.g_error = gauss_error(p.g_tail, *std::max_element(nodes.g, nodes.g + n), n) + rounding * p.g_total;
  p.g_slope = nodes.g[n - 1] / nodes.ds[n - 1];
}

std::size_t GaussPanels::add(Panel panel) {
  panel.rule = &legendre_rule(nodes_for(panel));
  panel.data = data_.size();
  panel.child = 0;
  data_.resize(data_.size() + Panel::rows * panel.rule->n);
  fill(panel);
  panels_.push_back(panel);
  return panels_.size() - 1;
}

std::size_t GaussPanels::children(std::size_t index) {
  if (panels_[index].child > 0) return panels_[index].child;
  Panel first = panels_[index], second = first;
  // at a front most of what is to be resolved is near the lower end
  const double share = first.at_front ? front_share : 0.5;
  first.upper = second.lower = first.lower + share * (first.upper - first.lower);
  second.at_front = false;
  const std::size_t child = add(first);
  (void)add(second);
  panels_[index].child = child;
  return child;
}

void GaussPanels::find_edges(const Segment& segment, std::span<const double> stops, std::span<const double> knots) {
  const double end = segment.length();
  edges_.assign({0, end});
  const auto cut = [&](double s) {
    if (s > 0 && s < end) edges_.push_back(s);
  };
  const double pieces = std::ceil(end / longest);
  for (double i = 1; i < pieces; ++i) cut(end * i / pieces);
  for (const double q : stops)
    if (q > segment.a && q < segment.b) cut(segment.offset(q));
  const auto first = std::ranges::upper_bound(knots, velocity_ * segment.a);
  for (auto knot = first; knot != knots.end() && *knot < velocity_ * segment.b; ++knot)
    cut(segment.offset(*knot / velocity_));
  std::ranges::sort(edges_);
  const auto repeated = std::ranges::unique(edges_);
  edges_.erase(repeated.begin(), repeated.end());
}

void GaussPanels::start(double velocity, std::span<const double> stops) {
  velocity_ = velocity;
  panels_.clear();
  data_.clear();
  roots_.clear();
  double g = 0, g_slope = 0;
  const auto* curve = std::get_if<MasterCurve>(&rubber_);
  const std::span<const double> knots = curve ? curve->knots() : std::span<const double>{};
  for (const Segment& segment : surface_) {
    if (segment.at_a == 0 && segment.at_b == 0) continue;
    find_edges(segment, stops, knots);
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
      const double length = edges_[i + 1] - edges_[i];
      const double behind = g == 0 ? 0 : g_slope > 0 ? g / g_slope : 1e300;  // how far back G would be 0
      Panel p{};
      p.segment = &segment;
      p.start = edges_[i];
      p.at_front = g == 0;
      if (g == 0 || (curve && behind > length / 4)) {
        p.square = 1;
        p.upper = std::sqrt(length);
      } else if (behind < 4 * length) {
        p.linear = 2 * std::sqrt(behind);
        p.square = 1;
        p.upper = length / (std::sqrt(behind) + std::sqrt(behind + length));
      } else {
        p.linear = 1;
        p.upper = length;
      }
      if (p.at_front && rtol_ < one_panel) {
        const double end = p.upper;
        p.upper *= front_share;
        roots_.push_back(add(p));
        g += panels_.back().g_total;
        p.lower = p.upper;
        p.upper = end;
        p.at_front = false;
      }
      roots_.push_back(add(p));
      g += panels_.back().g_total;
      g_slope = panels_.back().g_slope;
    }
  }
}

double GaussPanels::g_to(const Panel& panel, double s) const {
  const double t = panel.t(s);
  if (!(t > panel.lower)) return 0;
  Nodes nodes;
  sample(panel, t, nodes);
  return dot(panel.rule->n, panel.rule->weight, nodes.g);
}

}  // namespace asperity
