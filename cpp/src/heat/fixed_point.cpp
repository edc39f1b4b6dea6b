// theta = F(theta) by Newton's method with the exact Jacobian. Plain iteration diverges where an eigenvalue of dF is
// below -1, and where it is above 0 there may be several solutions: then theta = eps F(theta) with theta(q1) = tau
// given is solved for the profile and eps, by bordered Newton steps from tau to tau. eps(tau) has one value, is small
// for small tau and large for large tau, so that its crossings of 1 are all the solutions; a rising one is stable.
#include "heat/fixed_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The eigenvalue of the largest size: by powers of the matrix, or all of them where two are about as large.
double dominant_eigenvalue(const MatrixXd& matrix, const VectorXd& start) {
  VectorXd v = start;
  double before = 0;
  for (int i = 0; i < 60; ++i) {
    const double size = v.norm();
    if (!(size > 0)) return 0;
    v /= size;
    const VectorXd next = matrix * v;
    const double value = v.dot(next);
    if (i > 2 && std::fabs(value - before) <= 1e-9 * std::fabs(value)) return value;
    before = value;
    v = next;
  }
  double largest = 0;
  for (const auto& value : matrix.eigenvalues())
    if (std::abs(value) > std::fabs(largest)) largest = value.real();
  return largest;
}

double size_of(const VectorXd& residual, const VectorXd& theta) {
  return residual.lpNorm<Eigen::Infinity>() / std::fmax(theta.lpNorm<Eigen::Infinity>(), 1e-300);
}

MatrixXd identity_less(const MatrixXd& jacobian, double factor = 1) {
  MatrixXd matrix = -factor * jacobian;
  matrix.diagonal().array() += 1;
  return matrix;
}

/// Newton's steps, each of which must lower the residual; the map is left at the solution.
std::optional<VectorXd> newton(FlashMap& map, VectorXd theta, double tolerance, int passes) {
  map(theta);
  VectorXd residual = map.rise() - theta;
  double size = size_of(residual, theta);
  while (!(size <= tolerance)) {
    const VectorXd step = identity_less(map.jacobian()).partialPivLu().solve(residual);
    bool lower = false;
    for (double share = 1; share > 0.05 && !lower; share /= 2) {
      if (--passes < 0) return {};
      const VectorXd tried = (theta + share * step).cwiseMax(0.0);
      map(tried);
      const VectorXd left = map.rise() - tried;
      const double left_size = size_of(left, tried);
      // near rounding a residual need not fall any more
      if (left_size < 0.9 * size || left_size < 1e-12) {
        theta = tried;
        residual = left;
        lower = true;
        if (left_size >= size && left_size < 1e-12) return theta;
        size = left_size;
      }
    }
    if (!lower) return {};
  }
  return theta;
}

/// A place on the curve theta = eps F(theta).
struct Place {
  double tau, eps;
  VectorXd theta;
};

class March {
 public:
  March(FlashMap& map, double background, const VectorXd& cold_rise)
      : map_(map), highest_(std::fmax(highest_rubber_temperature - background, 1)) {
    const Index last = cold_rise.size() - 1;
    constexpr double first = 0.02;
    at_ = {first * cold_rise[last], first, first * cold_rise};
  }

  /// The next place, at up to twice the tau; nothing beyond the highest temperature.
  std::optional<Place> next() {
    for (double stride = std::numbers::ln2; stride > 1e-4; stride /= 2) {
      heed();
      const double tau = at_.tau * std::exp(stride);
      if (tau > 2 * highest_) return {};
      if (auto found = solve(tau)) {
        at_ = *found;
        return found;
      }
    }
    throw NotConverged("the flash temperature is not found beyond a rise of " + show(at_.tau, 6) + " K at q1");
  }
  [[nodiscard]] const Place& at() const { return at_; }

  /// The profile where eps is near 1, between two places.
  VectorXd between(Place low, Place high) {
    double from = std::log(low.eps), to = std::log(high.eps);
    for (int i = 0; i < 40; ++i) {
      const Place& nearer = std::fabs(from) < std::fabs(to) ? low : high;
      if (std::fabs(std::log(nearer.eps)) < 0.1) return nearer.theta;
      const double share = i % 3 == 2 ? 0.5 : std::clamp(from / (from - to), 0.05, 0.95);
      const double tau = low.tau * std::pow(high.tau / low.tau, share);
      at_ = nearer;
      const std::optional<Place> found = solve(tau);
      if (!found) break;
      if ((std::log(found->eps) < 0) == (from < 0)) {
        low = *found;
        from = std::log(low.eps);
      } else {
        high = *found;
        to = std::log(high.eps);
      }
    }
    return std::fabs(from) < std::fabs(to) ? low.theta : high.theta;
  }

 private:
  std::optional<Place> solve(double tau) {
    const double grown = tau / at_.tau;
    VectorXd theta = at_.theta * grown;
    const Index n = theta.size();
    double eps = at_.eps;
    double before = HUGE_VAL;
    for (int pass = 0; pass < 8; ++pass) {
      map_(theta);
      if (pass == 0) eps = theta[n - 1] / map_.rise()[n - 1];
      const VectorXd residual = eps * map_.rise() - theta;
      const double size = residual.lpNorm<Eigen::Infinity>() / tau;
      if (size < 1e-3) return Place{tau, eps, theta};
      if (!(size < 2 * before)) return {};
      before = size;
      MatrixXd bordered(n + 1, n + 1);
      bordered.topLeftCorner(n, n) = identity_less(map_.jacobian(), eps);
      bordered.topRightCorner(n, 1) = -map_.rise();
      bordered.bottomRows(1).setZero();
      bordered(n, n - 1) = 1;
      VectorXd right(n + 1);
      right.head(n) = residual;
      right[n] = tau - theta[n - 1];
      const VectorXd step = bordered.partialPivLu().solve(right);
      if (!step.allFinite()) return {};
      theta = (theta + step.head(n)).cwiseMax(0.0);
      eps += step[n];
      if (!(eps > 0)) return {};
    }
    return {};
  }

  FlashMap& map_;
  double highest_;
  Place at_;
};

FixedPoint finished(FlashMap& map, const VectorXd& theta) {
  FixedPoint found;
  found.theta = theta;
  found.residual = map.rise() - theta;
  const VectorXd off = identity_less(map.jacobian()).partialPivLu().solve(found.residual);
  found.mu_error = std::fabs(map.slope_of_mu() * off);
  found.gain = dominant_eigenvalue(map.jacobian(), map.rise());
  return found;
}

FixedPoint by_march(FlashMap& map, const HeatPoint& point, const VectorXd& cold_rise, Branch branch, double tolerance) {
  March march(map, point.temperature, cold_rise);
  std::vector<std::pair<Place, Place>> crossings;
  Place before = march.at();
  if (before.eps >= 1) throw NotConverged("the flash temperature: no start of the search");
  while (const std::optional<Place> here = march.next()) {
    if ((here->eps < 1) != (before.eps < 1)) crossings.emplace_back(before, *here);
    before = *here;
  }
  if (crossings.empty())
    throw OutOfRange("temperature = " + show(point.temperature, 6) + ": the rubber heats itself above " +
                     show(highest_rubber_temperature) + " K, which it does not stand");
  const auto& [low, high] = branch == Branch::coldest ? crossings.front() : crossings.back();
  const std::optional<VectorXd> theta = newton(map, march.between(low, high), tolerance, 30);
  if (!theta) throw NotConverged("the flash temperature: Newton's steps do not end");
  FixedPoint found = finished(map, *theta);
  found.solutions = static_cast<int>(crossings.size());
  return found;
}

}  // namespace

FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const VectorXd& guess, Branch branch,
                             double tolerance) {
  map(VectorXd::Zero(guess.size()));
  const VectorXd cold_rise = map.rise();
  if (cold_rise.lpNorm<Eigen::Infinity>() == 0) return finished(map, cold_rise);
  if (dominant_eigenvalue(map.jacobian(), cold_rise) <= 0) {
    constexpr int passes = 8;
    if (const auto theta = newton(map, guess, tolerance, passes)) return finished(map, *theta);
  }
  return by_march(map, point, cold_rise, branch, tolerance);
}

FixedPoint polish(FlashMap& map, const VectorXd& theta, double tolerance) {
  const std::optional<VectorXd> found = newton(map, theta, tolerance, 12);
  if (!found) throw NotConverged("the flash temperature: Newton's steps do not end");
  return finished(map, *found);
}

}  // namespace asperity
