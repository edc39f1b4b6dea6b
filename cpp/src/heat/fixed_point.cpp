// theta = F(theta) by Newton's method with the exact Jacobian. Plain iteration diverges where an eigenvalue of dF is
// below -1, and where it is above 0 there may be several solutions: then theta = eps F(theta) with theta(q1) = tau
// given is solved for the profile and eps, by bordered Newton steps from tau to tau. eps(tau) has one value, is small
// for small tau and large for large tau, so that its crossings of 1 are all the solutions; a rising one is stable.
#include "heat/fixed_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
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

/// Newton's steps, each of which must lower the residual, with the slopes of an earlier pass as long as they do; the
/// map is left at the solution.
std::optional<VectorXd> newton(FlashMap& map, VectorXd theta, double tolerance, int passes, Tangent& tangent) {
  constexpr double enough = 0.15;  // of the residual, which slopes of an earlier pass leave at most
  map(theta);
  tangent.take(map);
  bool fresh = true;
  VectorXd residual = map.rise() - theta;
  double size = size_of(residual, theta);
  while (!(size <= tolerance)) {
    const VectorXd step = tangent.lu.solve(residual);
    bool lower = false;
    for (double share = 1; share > (fresh ? 0.05 : 0.9) && !lower; share /= 2) {
      if (--passes < 0) return {};
      const VectorXd tried = (theta + share * step).cwiseMax(0.0);
      map(tried);
      const VectorXd left = map.rise() - tried;
      const double left_size = size_of(left, tried);
      // near rounding a residual need not fall any more
      if (left_size < 0.9 * size || left_size < 1e-12) {
        lower = true;
        theta = tried;
        residual = left;
        if (left_size >= size && left_size < 1e-12) return theta;
        fresh = left_size > enough * size && left_size > tolerance;
        if (fresh) tangent.take(map);
        size = left_size;
      }
    }
    if (lower) continue;
    if (fresh || --passes < 0) return {};
    map(theta);
    tangent.take(map);
    fresh = true;
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

FixedPoint finished(const FlashMap& map, const VectorXd& theta, const Tangent& tangent) {
  FixedPoint found;
  found.theta = theta;
  found.residual = map.rise() - theta;
  found.mu_error = std::fabs(tangent.slope_of_mu * tangent.lu.solve(found.residual));
  return found;
}

/// Whether tau over the rise at the last point from tau times a shape, that of the rise before, grows all along tau,
/// and by how much it should: the march would have one crossing then.
bool one_crossing(FlashMap& map, const HeatPoint& point, const VectorXd& cold_rise) {
  constexpr double stride = 2, least = 0.1;  // of ln eps a stride, whose ln is 0.7
  const Index last = cold_rise.size() - 1;
  VectorXd shape = cold_rise / cold_rise[last];
  const double highest = 2 * std::fmax(highest_rubber_temperature - point.temperature, 1);
  double before = -std::numeric_limits<double>::infinity();
  for (double tau = 0.02 * cold_rise[last]; tau < stride * highest; tau *= stride) {
    map(tau * shape);
    const double rise = map.rise()[last], log_eps = std::log(tau / rise);
    if (!(log_eps > before + least)) return false;
    before = log_eps;
    shape = map.rise() / rise;
  }
  return true;
}

FixedPoint by_march(FlashMap& map, const HeatPoint& point, const VectorXd& cold_rise, Branch branch, double tolerance,
                    Tangent& tangent) {
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
  const std::optional<VectorXd> theta = newton(map, march.between(low, high), tolerance, 30, tangent);
  if (!theta) throw NotConverged("the flash temperature: Newton's steps do not end");
  FixedPoint found = finished(map, *theta, tangent);
  found.solutions = static_cast<int>(crossings.size());
  return found;
}

}  // namespace

void Tangent::take(FlashMap& map) {
  jacobian = map.jacobian();
  lu.compute(identity_less(jacobian));
  slope_of_mu = map.slope_of_mu();
}

FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const VectorXd& guess, Branch branch,
                             double tolerance, Tangent& tangent) {
  map(VectorXd::Zero(map.rise_size()));
  const VectorXd cold_rise = map.rise();
  if (cold_rise.lpNorm<Eigen::Infinity>() == 0) {
    tangent.take(map);
    return finished(map, cold_rise, tangent);
  }
  // one power tells the sign of the eigenvalue, as heat of any roughness warms all
  const double cold_gain = cold_rise.dot(map.along(cold_rise)) / cold_rise.squaredNorm();
  const bool alone = cold_gain <= 0 || one_crossing(map, point, cold_rise);
  if (alone) {
    constexpr int passes = 12;
    const VectorXd start = guess.size() != 0 ? guess : (cold_rise / (1 - std::fmin(cold_gain, 0.5))).eval();
    if (const auto theta = newton(map, start, tolerance, passes, tangent)) return finished(map, *theta, tangent);
  }
  return by_march(map, point, cold_rise, branch, tolerance, tangent);
}

FixedPoint polish(FlashMap& map, const VectorXd& theta, const Tangent& tangent, const MatrixXd& up,
                  const MatrixXd& down, double tolerance) {
  FixedPoint found;
  found.theta = (up * theta).cwiseMax(0.0);
  double before = std::numeric_limits<double>::infinity();
  constexpr int passes = 12;
  for (int pass = 0; pass < passes; ++pass) {
    map(found.theta);
    found.residual = map.rise() - found.theta;
    const VectorXd coarse = down * found.residual, step = tangent.lu.solve(coarse);
    found.mu_error = std::fabs(tangent.slope_of_mu * step);
    const double size = size_of(found.residual, found.theta);
    if (size <= tolerance || (size < 1e-12 && size >= before)) return found;
    if (size > 0.5 * before) break;
    before = size;
    // what dF adds to a step is smooth, so that the coarser grid knows it
    found.theta = (found.theta + found.residual + up * (step - coarse)).cwiseMax(0.0);
  }
  Tangent own;
  const std::optional<VectorXd> again = newton(map, (up * theta).cwiseMax(0.0), tolerance, passes, own);
  if (!again) throw NotConverged("the flash temperature: Newton's steps do not end");
  return finished(map, *again, own);
}

double gain_of(FlashMap& map, const Tangent& tangent, double tolerance) {
  const MatrixXd& j = tangent.jacobian;
  VectorXd right = map.rise(), left = VectorXd::Ones(right.size());
  double value = 0;
  for (int i = 0; i < 40; ++i) {
    right = j * right;
    left = j.transpose() * left;
    const double size = right.norm(), left_size = left.norm();
    if (!(size > 0 && left_size > 0)) return 0;
    right /= size;
    left /= left_size;
    const double before = value;
    value = left.dot(j * right) / left.dot(right);
    if (i > 2 && std::fabs(value - before) <= 1e-9 * std::fabs(value)) break;
    if (i == 39) return dominant_eigenvalue(map.jacobian(), map.rise());
  }
  for (int i = 0; i < 20; ++i) {
    const VectorXd next = map.along(right);
    const double before = value;
    value = left.dot(next) / left.dot(right);
    // between vectors of both sides it is good to a small part of what it changes
    if (std::fabs(value - before) <= (i == 0 ? 10 : 1) * tolerance * std::fabs(value)) return value;
    right = next / next.norm();
  }
  return dominant_eigenvalue(map.jacobian(), map.rise());
}

}  // namespace asperity
