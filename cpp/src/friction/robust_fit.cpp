// Eq. 23 through points by M-estimates with Tukey's biweight, each a series of Levenberg-Marquardt steps, from starts
// of little scale (S-estimates). P. J. Huber, Robust Statistics (1981), Chapter 7; V. J. Yohai, Ann. Stat. 15, 642
// (1987).
#include "friction/robust_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/dense.hpp"

namespace asperity {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Cuts of the biweight in standard deviations: with the first half of the points may be outliers, with the second the
// efficiency is 95 % of that of least squares.
constexpr double robust_cut = 1.5476, efficient_cut = 4.685;
constexpr double run_away = 10;  // decades of v0 beyond the points
// Nodes that are tried, the steps that each takes, and how many of the best then go on.
constexpr std::size_t many_starts = 32, few_starts = 8;
constexpr int first_steps = 5, most_steps = 500;

/// Tukey's biweight: rho with its limit 1, psi(u) / u and psi'(u) up to the factor 6, of u = residual / cut.
double biweight_rest(double u) { return std::abs(u) < 1 ? 1 - u * u : 0; }
double biweight_rho(double u) {
  const double rest = biweight_rest(u);
  return 1 - rest * rest * rest;
}
double biweight_weight(double u) { return biweight_rest(u) * biweight_rest(u); }
double biweight_curvature(double u) { return biweight_rest(u) * (1 - 5 * u * u); }

/// The value at which half of the weight is reached; `entries` (value, weight) are sorted.
double weighted_median(std::vector<std::pair<double, double>>& entries) {
  std::ranges::sort(entries);
  double total = 0, below = 0;
  for (const auto& [value, weight] : entries) total += weight;
  for (const auto& [value, weight] : entries) {
    below += weight;
    if (below >= total / 2) return value;
  }
  return -infinity;
}

class Fit {
 public:
  Fit(const AdhesionPoints& points, const HeldParameters& held) : points_(points), held_(held), n_(points.size()) {
    for (const auto& value : held) free_ += value ? 0 : 1;
    // ln((mu - mu_H) / share): what ln tau_f0 would be of each point at its v0
    const ArrayXd left = 1 - (points.log_hysteresis - points.log_mu).exp();
    above_ = (left > 0).select(points.log_mu + left.max(1e-300).log() - points.log_share, -infinity);
  }

  [[nodiscard]] std::vector<Vector3d> starts() const;
  /// Towards the least scale: an S-estimate, as good as a start needs to be.
  [[nodiscard]] Vector3d less_scale(Vector3d at) const;
  /// The least sum of rho near `at`, at the scale that it has itself.
  [[nodiscard]] std::optional<AdhesionCurve> estimate(Vector3d at) const;
  [[nodiscard]] double scale_of(const Vector3d& at) const;

 private:
  /// ln mu_A of Eq. 23 at each point.
  [[nodiscard]] ArrayXd log_adhesion(const Vector3d& p) const {
    return p[0] + points_.log_share - p[2] * (points_.x - p[1]).square();
  }
  [[nodiscard]] ArrayXd residual(const Vector3d& p) const {
    heed();  // every step of the fit comes by here
    const ArrayXd a = log_adhesion(p);
    return points_.log_mu - a.max(points_.log_hysteresis) - (-(points_.log_hysteresis - a).abs()).exp().log1p();
  }
  /// The adhesion's part of mu.
  [[nodiscard]] ArrayXd part(const Vector3d& p) const {
    return 1 / (1 + (points_.log_hysteresis - log_adhesion(p)).exp());
  }
  [[nodiscard]] double total(const Vector3d& at, double cut) const {
    return (residual(at) / cut).unaryExpr(&biweight_rho).sum();
  }
  [[nodiscard]] Eigen::MatrixX3d jacobian(const Vector3d& p) const;
  [[nodiscard]] double log_shear_stress(double x0, double c) const;
  [[nodiscard]] double target() const { return static_cast<double>(n_ - free_) / 2; }
  [[nodiscard]] std::optional<Vector3d> minimum(Vector3d at, double cut) const;
  bool descend(Vector3d& at, double cut, double& damping) const;
  [[nodiscard]] AdhesionCurve result(const Vector3d& at, double scale) const;
  [[nodiscard]] bool ran_away(const Vector3d& p) const;

  const AdhesionPoints& points_;
  const HeldParameters& held_;
  Index n_, free_ = 0;
  ArrayXd above_;
};

/// d ln mu / dp, with columns of zeros for parameters that are held.
Eigen::MatrixX3d Fit::jacobian(const Vector3d& p) const {
  const ArrayXd share = part(p), distance = points_.x - p[1];
  Eigen::MatrixX3d j(n_, 3);
  j.col(0) = share;
  j.col(1) = share * 2 * p[2] * distance;
  j.col(2) = -share * distance.square();
  for (Index k = 0; k < 3; ++k)
    if (held_[static_cast<std::size_t>(k)]) j.col(k).setZero();
  return j;
}

/// M-scale: the scale at which the mean rho is half of its limit; mean over n - p, as p points may lie on any curve.
double Fit::scale_of(const Vector3d& at) const {
  const ArrayXd left = residual(at).abs();
  // rho is 0 to 1: where all are 1 the mean is too large, and as large as they are it is too small
  const double least = points_.tolerance;
  double low = std::log(least), high = std::log(std::max(left.maxCoeff(), 2 * least)) + 5;
  while (high - low > 1e-11) {
    const double middle = (low + high) / 2;
    const double sum = (left / (robust_cut * std::exp(middle))).unaryExpr(&biweight_rho).sum();
    (sum > target() ? low : high) = middle;
  }
  return std::exp(high);
}

/// The one with the least sum of absolute residuals: a weighted median, as each residual has its zero at one value and
/// changes in proportion to the adhesion's part.
double Fit::log_shear_stress(double x0, double c) const {
  const ArrayXd zeros = above_ + c * (points_.x - x0).square();
  std::vector<std::pair<double, double>> entries;
  for (const double zero : zeros)
    if (zero > -infinity) entries.emplace_back(zero, 1);
  double found = weighted_median(entries);
  for (int pass = 0; pass < 2 && found > -infinity; ++pass) {
    const ArrayXd weights = part({found, x0, c});
    entries.clear();
    for (Index i = 0; i < n_; ++i) entries.emplace_back(zeros[i], weights[i]);
    found = weighted_median(entries);
  }
  return found;
}

/// The best nodes of a grid over v0 and c, by the median of their absolute residuals.
std::vector<Vector3d> Fit::starts() const {
  std::vector<double> x0s, cs;
  if (held_[1]) {
    x0s = {*held_[1]};
  } else {
    const double first = points_.x.minCoeff() - 3, last = points_.x.maxCoeff() + 3;
    const int steps = static_cast<int>(std::ceil((last - first) / 0.3));
    for (int i = 0; i <= steps; ++i) x0s.push_back(first + (last - first) * i / steps);
  }
  if (held_[2])
    cs = {*held_[2]};
  else
    for (double c = 0.003; c < 20; c *= 1.6) cs.push_back(c);

  struct Node {
    double median;
    Vector3d at;
  };
  std::vector<Node> nodes;
  for (const double x0 : x0s)
    for (const double c : cs) {
      const double log_tau = held_[0] ? *held_[0] : log_shear_stress(x0, c);
      if (!(log_tau > -infinity)) continue;
      const Vector3d at{log_tau, x0, c};
      ArrayXd left = residual(at).abs();
      const Index middle = (n_ + free_) / 2;
      std::ranges::nth_element(left, left.begin() + middle);
      nodes.push_back({left[middle], at});
    }
  std::ranges::sort(nodes, {}, &Node::median);
  nodes.resize(std::min(nodes.size(), many_starts));
  std::vector<Vector3d> result;
  result.reserve(nodes.size());
  for (const Node& node : nodes) result.push_back(node.at);
  return result;
}

bool Fit::ran_away(const Vector3d& p) const {
  const bool far = p[1] < points_.x.minCoeff() - run_away || p[1] > points_.x.maxCoeff() + run_away;
  return (!held_[1] && (far || (!held_[2] && !(p[2] > 0)))) || part(p).maxCoeff() < 1e-6;
}

/// A step of Levenberg's and Marquardt's on least squares with the weights that the residuals have now. False where no
/// step leads down or this one was too small to matter.
bool Fit::descend(Vector3d& at, double cut, double& damping) const {
  const Eigen::MatrixX3d j = jacobian(at);
  const ArrayXd left = residual(at), u = left / cut, weight = u.unaryExpr(&biweight_weight);
  const Matrix3d normal = j.transpose() * weight.matrix().asDiagonal() * j;
  const Vector3d gradient = j.transpose() * (weight * left).matrix();
  const double value = u.unaryExpr(&biweight_rho).sum();
  for (; damping < 1e12; damping *= 10) {
    Matrix3d damped = normal;
    for (Index k = 0; k < 3; ++k)
      damped(k, k) = held_[static_cast<std::size_t>(k)] ? 1 : normal(k, k) * (1 + damping) + 1e-300;
    const Vector3d step = inverse(damped) * gradient;
    if (!(total(at + step, cut) < value)) continue;
    at += step;
    damping = std::max(1e-12, damping / 10);
    return (j * step).cwiseAbs().maxCoeff() > 1e-10 * cut;
  }
  return false;
}

std::optional<Vector3d> Fit::minimum(Vector3d at, double cut) const {
  double damping = 1e-3;
  for (int i = 0; i < most_steps; ++i) {
    if (ran_away(at)) return std::nullopt;
    if (!descend(at, cut, damping)) return at;
  }
  return std::nullopt;
}

/// Steps at a scale that follows them (M. Salibian-Barrera and V. J. Yohai, J. Comput. Graph. Stat. 15, 414 (2006)).
Vector3d Fit::less_scale(Vector3d at) const {
  double scale = scale_of(at), damping = 1e-3;
  for (int i = 0; i < first_steps; ++i) {
    Vector3d next = at;
    if (!descend(next, robust_cut * scale, damping) || ran_away(next)) break;
    at = next;
    scale = std::max(points_.tolerance, scale * std::sqrt(total(at, robust_cut * scale) / target()));
  }
  return at;
}

std::optional<AdhesionCurve> Fit::estimate(Vector3d at) const {
  double scale = scale_of(at);
  for (int i = 0; i < 50; ++i) {
    const std::optional<Vector3d> next = minimum(at, efficient_cut * scale);
    if (!next) return std::nullopt;
    at = *next;
    const double last = std::exchange(scale, scale_of(at));
    if (std::abs(scale - last) <= 1e-10 * last) break;
  }
  return result(at, scale);
}

/// The covariance of an M-estimate of the points that were not put aside: P. J. Huber, Robust Statistics (1981),
/// Chapter 7, with its correction for few points.
AdhesionCurve Fit::result(const Vector3d& at, double scale) const {
  const double cut = efficient_cut * scale, p = static_cast<double>(free_);
  const ArrayXd left = residual(at), u = left / cut;
  AdhesionCurve curve{at, Matrix3d::Zero(), scale, left, u.unaryExpr(&biweight_weight)};
  const ArrayXd kept = (curve.weight > 0).cast<double>(), curvature = u.unaryExpr(&biweight_curvature);
  const double n = kept.sum(), mean = curvature.sum() / n;
  const double variance = (kept * (curvature - mean).square()).sum() / n;
  const double correction = 1 + p / n * variance / (mean * mean);
  const double square = (curve.weight * u).square().sum() / std::max(1.0, n - p);
  Eigen::MatrixX3d j = jacobian(at);
  j.array().colwise() *= kept;
  Matrix3d normal = j.transpose() * j;
  for (Index k = 0; k < 3; ++k)
    if (held_[static_cast<std::size_t>(k)]) normal(k, k) = 1;
  const Matrix3d inverted = inverse(normal);
  curve.covariance = (inverted + inverted.transpose()) / 2 * std::pow(cut * correction / mean, 2) * square;
  for (Index k = 0; k < 3; ++k)
    if (held_[static_cast<std::size_t>(k)]) curve.covariance(k, k) = 0;
  return curve;
}

}  // namespace

std::optional<AdhesionCurve> fit_adhesion_curve(const AdhesionPoints& points, const HeldParameters& held) {
  const Fit fit(points, held);
  std::vector<std::pair<double, Vector3d>> found;
  for (const Vector3d& start : fit.starts()) {
    const Vector3d at = fit.less_scale(start);
    found.emplace_back(fit.scale_of(at), at);
  }
  std::ranges::sort(found, {}, [](const auto& entry) { return entry.first; });
  found.resize(std::min(found.size(), few_starts));
  std::optional<AdhesionCurve> best;
  for (const auto& [scale, start] : found)
    if (auto curve = fit.estimate(start); curve && !(best && best->scale <= curve->scale)) best = std::move(curve);
  return best;
}

}  // namespace asperity
