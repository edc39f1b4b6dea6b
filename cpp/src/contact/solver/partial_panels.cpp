// Panels of ln q for the rule of PartialContact (contact/theory/partial_contact_rule.hpp): their ends, G at their
// nodes, and what the rubber has there.
#include "contact/solver/partial_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

namespace {

constexpr std::size_t most = LegendreRule::most;
constexpr double longest = 2;     // in y: I1 and I2 of a Prony series have singularities pi / 2 off the axis
constexpr double root_reach = 1;  // panels that begin before have t as their variable
constexpr double rounding = 4e-16;

bool rough(const Segment& segment) { return segment.at_a > 0 || segment.at_b > 0; }

}  // namespace

PartialPanels::PartialPanels(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio,
                             double rtol)
    : surface_(surface),
      waves_(waves),
      window_(surface),
      g_factor_(1 / (8 * (1 - poisson_ratio * poisson_ratio) * (1 - poisson_ratio * poisson_ratio))),
      end_(window_, g_factor_),
      nodes_(rtol < 1e-8 ? 16 : 12) {
  const auto first = std::ranges::find_if(surface, rough);
  foot_ = first == surface.end() ? surface.back().b : first->a;
  start_.reserve(surface.size());
  for (const Segment& segment : surface) start_.push_back(y_of(segment.a));
}

double PartialPanels::y_of(double wavenumber) const { return std::log1p((wavenumber - foot_) / foot_); }

double PartialPanels::wavenumber_at(double y) const { return foot_ * std::exp(y); }

/// The nodes of the panel's rule from its lower end up to `upper`.
void PartialPanels::nodes_of(const PartialPanel& p, double upper, double* wavenumber, double* roughness) const {
  const double lower = p.root ? std::sqrt(p.lower) : p.lower, end = p.root ? std::sqrt(upper) : upper;
  const double middle = (lower + end) / 2, half = (end - lower) / 2;
  const Segment& segment = surface_[p.segment];
  for (std::size_t i = 0; i < p.rule->n; ++i) {
    const double t = middle + half * p.rule->node[i], y = p.root ? t * t : t;
    const double q = foot_ * std::exp(y), square = q * q;
    wavenumber[i] = q;
    roughness[i] =
        g_factor_ * square * square * segment.density_at(y - start_[p.segment]) * half * (p.root ? 2 * t : 1);
  }
}

std::size_t PartialPanels::add(PartialPanel panel) {
  const std::size_t n = panel.rule->n;
  panel.data = data_.size();
  panel.child = panel.filled = 0;
  data_.resize(data_.size() + PartialPanel::rows * n);
  double* const rows = &data_[panel.data];
  nodes_of(panel, panel.upper, rows + PartialPanel::wavenumber * n, rows + PartialPanel::roughness * n);
  for (std::size_t i = 0; i < n; ++i)
    rows[PartialPanel::window * n + i] = g_factor_ * window_(rows[PartialPanel::wavenumber * n + i]);
  panels_.push_back(panel);
  return panels_.size() - 1;
}

void PartialPanels::fill(PartialPanel& p) {
  if (p.filled == starts_) return;
  p.filled = starts_;
  const std::size_t n = p.rule->n;
  double* const rows = &data_[p.data];
  double w[most], i1[most], i2[most], i1_outside[most], tail[LegendreRule::kept];
  for (std::size_t i = 0; i < n; ++i) w[i] = velocity_ * rows[PartialPanel::wavenumber * n + i];
  p.any_outside = waves_.of_waves({w, n}, {rows + PartialPanel::wavenumber * n, n}, {i1, n}, {i2, n}, {i1_outside, n});
  for (std::size_t i = 0; i < n; ++i) {
    rows[PartialPanel::rate * n + i] = rows[PartialPanel::roughness * n + i] * i2[i];
    rows[PartialPanel::steepness * n + i] = rows[PartialPanel::window * n + i] * i2[i];
    rows[PartialPanel::ratio * n + i] = i1[i] / i2[i];
    rows[PartialPanel::outside * n + i] = p.any_outside ? i1_outside[i] / i2[i] : 0;
  }
  // dG begins as t at the foot, and as t^3 on a ramp from zero
  const bool at_foot = p.root && p.lower == 0;
  const auto& columns = !at_foot                       ? p.rule->cumulative
                        : surface_[p.segment].at_a > 0 ? p.rule->cumulative_linear
                                                       : p.rule->cumulative_cubic;
  kernels().integrate(*p.rule, columns, rows + PartialPanel::rate * n, rows + PartialPanel::cumulative * n, &p.g_total,
                      tail);
  p.g_error = rule_error(tail) + rounding * p.g_total;
}

std::size_t PartialPanels::children(std::size_t index) {
  if (panels_[index].child == 0) {
    PartialPanel first = panels_[index], second = first;
    // half way in the variable, nearer to the foot beside it
    const double a = std::sqrt(first.lower), b = std::sqrt(first.upper);
    const double middle = first.lower == 0 ? b / 4 : (a + b) / 2;
    first.upper = second.lower = first.root ? middle * middle : (first.lower + first.upper) / 2;
    const std::size_t child = add(first);
    (void)add(second);
    panels_[index].child = child;
  }
  const std::size_t child = panels_[index].child;
  fill(panels_[child]);
  fill(panels_[child + 1]);
  return child;
}

void PartialPanels::lay_out(std::span<const double> stops) {
  panels_.clear();
  data_.clear();
  roots_.clear();
  std::vector<double> also = window_.ends();
  also.insert(also.end(), stops.begin(), stops.end());
  for (const Segment& segment : surface_)
    for (const double side : {-RoughnessWindow::half_length, RoughnessWindow::half_length})
      also.push_back(segment.a * std::exp(side));
  std::ranges::sort(also);
  std::vector<double> edges;
  auto next = also.begin();
  for (std::size_t i = 0; i < surface_.size(); ++i) {
    const Segment& segment = surface_[i];
    if (!rough(segment)) continue;
    edges.assign({start_[i], y_of(segment.b)});
    next = std::upper_bound(next, also.end(), segment.a);
    for (; next != also.end() && *next < segment.b; ++next) edges.push_back(y_of(*next));
    std::ranges::sort(edges);
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      const double length = edges[k + 1] - edges[k];
      if (!(length > 0)) continue;
      const double pieces = std::ceil(length / (edges[k] < root_reach ? root_reach : longest));
      for (double j = 0; j < pieces; ++j) {
        PartialPanel panel{};
        panel.segment = i;
        panel.lower = j == 0 ? edges[k] : edges[k] + length * (j / pieces);
        panel.upper = j + 1 == pieces ? edges[k + 1] : edges[k] + length * ((j + 1) / pieces);
        panel.root = panel.lower < root_reach;
        panel.rule =
            &legendre_rule(panel.upper - panel.lower < 0.05 && panel.lower > panel.upper - panel.lower ? 8 : nodes_);
        roots_.push_back(add(panel));
      }
    }
  }
  laid_out_ = stops.empty();
}

void PartialPanels::start(double velocity, std::span<const double> stops) {
  velocity_ = velocity;
  ++starts_;
  if (!laid_out_ || !stops.empty()) lay_out(stops);
  for (const std::size_t root : roots_) fill(panels_[root]);
}

PartialPanels::Place PartialPanels::at(double wavenumber) const {
  const auto above = std::ranges::lower_bound(surface_, wavenumber, {}, &Segment::b);
  const Segment& segment = above == surface_.end() ? surface_.back() : *above;
  const AngularIntegrals angular = waves_(velocity_ * wavenumber, wavenumber);
  const double square = wavenumber * wavenumber;
  return {g_factor_ * square * square * segment.density(wavenumber) * angular.i2,
          g_factor_ * window_(wavenumber) * angular.i2, angular.i1 / angular.i2};
}

double PartialPanels::g_to(const PartialPanel& panel, double wavenumber) const {
  const double y = y_of(wavenumber);
  if (!(y > panel.lower)) return 0;
  const std::size_t n = panel.rule->n;
  double q[most], w[most], roughness[most], i1[most], i2[most], i1_outside[most];
  nodes_of(panel, y, q, roughness);
  for (std::size_t i = 0; i < n; ++i) w[i] = velocity_ * q[i];
  (void)waves_.of_waves({w, n}, {q, n}, {i1, n}, {i2, n}, {i1_outside, n});
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += panel.rule->weight[i] * roughness[i] * i2[i];
  return sum;
}

}  // namespace asperity
