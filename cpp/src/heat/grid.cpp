// dG/du = q^4 C I2 / (8 (1 - nu^2)^2) dln q/du on panels of t = sqrt(ln(q / q0)), as many nodes on each as the distance
// of the nearest singularities asks for, pi / 2 off the real axis of ln q for a Prony series.
#include "heat/grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

using std::numbers::pi;

namespace {

constexpr double same = 1e-12;  // relative distance of two wavenumbers that are one

constexpr int first_digits = 4;

/// How many nodes a panel of this length in ln q takes: by its distance from the nearest singularities at the lowest
/// level, and four more from level to level, which are two digits and more. At the front F has an essential
/// singularity.
std::size_t nodes_for(double length, std::size_t level, bool front, bool tabulated) {
  const double falling = std::asinh(pi / length) * (front ? 0.6 : 1);
  const double nodes = (front ? 8 : tabulated ? 8 : 4) + first_digits * std::numbers::ln10 / (2 * falling);
  return 4 * static_cast<std::size_t>(std::ceil(nodes / 4)) + 4 * level;
}

/// Into how many pieces a length is to be cut so that a rule has the nodes for one.
double pieces_for(double length, double longest, std::size_t level, bool tabulated) {
  double pieces = std::ceil(length / longest);
  while (nodes_for(length / pieces, level, false, tabulated) > LegendreRule::most) ++pieces;
  return pieces;
}

}  // namespace

HeatGrid::HeatGrid(std::span<const Segment> surface, double poisson_ratio, std::span<const double> stops,
                   std::size_t level, bool tabulated)
    : lowest_(std::log(surface.front().a)), highest_(std::log(surface.back().b)) {
  const double stiffening = 1 / (1 - poisson_ratio * poisson_ratio);
  g_factor_ = stiffening * stiffening / 8;
  std::size_t first = 0;
  while (first + 1 < surface.size() && surface[first].at_a == 0 && surface[first].at_b == 0) ++first;
  start_ = std::log(surface[first].a);
  const double longest = tabulated ? 0.5 : 3;
  for (const Segment& segment : surface.subspan(first)) {
    std::vector<double> ends{segment.a};
    for (const double q : stops)
      if (q > segment.a * (1 + same) && q < segment.b * (1 - same)) ends.push_back(q);
    ends.push_back(segment.b);
    std::ranges::sort(ends);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double lower = std::fmax(std::log(ends[i]) - start_, 0), upper = std::log(ends[i + 1]) - start_;
      const double pieces = pieces_for(upper - lower, longest, level, tabulated);
      for (double k = 1; k <= pieces; ++k) {
        const double from = lower + (upper - lower) * (k - 1) / pieces, to = lower + (upper - lower) * k / pieces;
        const double end = k == pieces ? ends[i + 1] : std::exp(start_ + to);
        if (from == 0)
          add_front(segment, std::sqrt(to), end, level, tabulated);
        else
          add_panel(segment, std::sqrt(from), std::sqrt(to), end, nodes_for(to - from, level, false, tabulated));
      }
    }
  }

  const double length = highest_ - lowest_, off = 2 * pi / length;
  const double falling = std::log(off + std::sqrt(1 + off * off));
  const auto digits = static_cast<double>(first_digits + 2 * level);
  const auto n = static_cast<std::size_t>(std::ceil(digits * std::numbers::ln10 / falling)) + 4;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = pi * static_cast<double>(k) / static_cast<double>(n - 1);
    points_.push_back(std::exp(lowest_ + length * std::pow(std::sin(angle / 2), 2)));
  }
  points_.front() = surface.front().a;
  points_.back() = surface.back().b;
  for (const double q : points_) log_points_.push_back(std::log(q));
  to_nodes_.resize(static_cast<Eigen::Index>(size()), static_cast<Eigen::Index>(n));
  for (std::size_t j = 0; j < size(); ++j) to_nodes_.row(static_cast<Eigen::Index>(j)) = row_at(wavenumber_[j]);
}

/// The panel that begins where G is 0, cut in t at a quarter once more from level to level, so that two levels tell a
/// front that is thinner than their nodes apart.
void HeatGrid::add_front(const Segment& segment, double upper, double end, std::size_t level, bool tabulated) {
  const std::size_t cuts = level > 1 ? level - 1 : 0;
  const std::size_t n = std::min(nodes_for(upper * upper, level, true, tabulated), LegendreRule::most);
  double lower = 0;
  for (std::size_t k = cuts; k > 0; --k) {
    const double to = upper * std::pow(0.25, static_cast<double>(k));
    add_panel(segment, lower, to, std::exp(start_ + to * to), n);
    lower = to;
  }
  add_panel(segment, lower, upper, end, n);
}

void HeatGrid::add_panel(const Segment& segment, double lower, double upper, double end, std::size_t nodes) {
  const Panel panel{&legendre_rule(nodes), size(), lower, upper, end, &segment};
  panels_.push_back(panel);
  const double half = (upper - lower) / 2, from = start_ - std::log(segment.a);
  for (std::size_t i = 0; i < panel.rule->n; ++i) {
    const double t = lower + half * (1 + panel.rule->node[i]), q = std::exp(start_ + t * t);
    const double s = std::clamp(from + t * t, 0.0, segment.length());
    wavenumber_.push_back(q);
    roughness_.push_back(g_factor_ * (q * q) * (q * q) * segment.density_at(s) * (half * 2 * t));
  }
}

// The barycentric form at Chebyshev's points: weights 1 with alternating signs, 1/2 at the ends.
Eigen::RowVectorXd HeatGrid::row_at(double wavenumber) const {
  const auto n = static_cast<Eigen::Index>(points_.size());
  Eigen::RowVectorXd row(n);
  const double at = std::log(wavenumber);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double apart = at - log_points_[static_cast<std::size_t>(k)];
    if (std::fabs(apart) < 1e-15 * std::fmax(1, std::fabs(at))) return Eigen::RowVectorXd::Unit(n, k);
    row[k] = (k % 2 == 0 ? 1.0 : -1.0) * (k == 0 || k == n - 1 ? 0.5 : 1.0) / apart;
  }
  return row / row.sum();
}

std::size_t HeatGrid::panels_below(double wavenumber) const {
  std::size_t below = 0;
  while (below < panels_.size() && panels_[below].end <= wavenumber * (1 + same)) ++below;
  return below;
}

double HeatGrid::wavenumber_at(double t) const { return std::exp(start_ + t * t); }

double HeatGrid::t_at(double wavenumber) const { return std::sqrt(std::fmax(std::log(wavenumber) - start_, 0)); }

// With f = sum_k a_k P_k, a_k = (2 k + 1) / 2 sum_j weight_j P_k(u_j) f_j, int_-1^u P_k = (P_k+1 - P_k-1) / (2 k + 1).
void integrals_to(const LegendreRule& rule, double u, double* weights) {
  double to[LegendreRule::most + 1];
  double before = 1, now = u;
  to[0] = 1 + u;
  for (std::size_t k = 1; k < rule.n; ++k) {
    const auto degree = static_cast<double>(k);
    const double next = ((2 * degree + 1) * u * now - degree * before) / (degree + 1);
    to[k] = (next - before) / (2 * degree + 1);
    before = now;
    now = next;
  }
  for (std::size_t j = 0; j < rule.n; ++j) {
    double sum = 0, p_before = 1, p = rule.node[j];
    sum += 0.5 * to[0];
    for (std::size_t k = 1; k < rule.n; ++k) {
      const auto degree = static_cast<double>(k);
      sum += (2 * degree + 1) / 2 * p * to[k];
      const double next = ((2 * degree + 1) * rule.node[j] * p - degree * p_before) / (degree + 1);
      p_before = p;
      p = next;
    }
    weights[j] = rule.weight[j] * sum;
  }
}

}  // namespace asperity
