// theta = F(theta) by Newton's method with the exact Jacobian. Plain iteration diverges where an eigenvalue of dF is
// below -1, and where one is above 0 there may be several solutions, which the march finds.
#include "heat/fixed_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The eigenvalue of the largest size, of a complex pair its real part. What squaring leaves of a matrix has the
/// columns of that eigenvalue alone, or of the two of one size, between which A is a matrix of 2 x 2.
double dominant_eigenvalue(const MatrixXd& a) {
  MatrixXd power = a;
  for (int i = 0; i < 16; ++i) {
    const double size = power.norm();
    if (!(size > 0)) return 0;
    power /= size;
    power *= power;
  }
  Index column = 0;
  const double longest = power.colwise().norm().maxCoeff(&column);
  if (!(longest > 0)) return 0;
  const VectorXd first = power.col(column) / longest;
  const double alone = first.dot(a * first);
  power -= first * (first.transpose() * power).eval();
  const double rest = power.colwise().norm().maxCoeff(&column);
  if (!is_above(rest, rounding_error * longest)) return alone;
  const VectorXd second = power.col(column) / rest;
  const double other = second.dot(a * second), mean = (alone + other) / 2,
               square = std::pow((alone - other) / 2, 2) + first.dot(a * second) * second.dot(a * first);
  return square > 0 ? mean + std::copysign(std::sqrt(square), mean) : mean;
}

double size_of(const VectorXd& residual, const VectorXd& theta) {
  return residual.lpNorm<Eigen::Infinity>() / std::fmax(theta.lpNorm<Eigen::Infinity>(), 1e-300);
}

/// Newton's steps, each of which must lower the residual, with the slopes of an earlier pass as long as they do, until
/// the next one is small: near runaway it is the residual magnified by 1 / (1 - gain). The map is left at the solution.
std::optional<VectorXd> newton(FlashMap& map, VectorXd theta, double tolerance, int passes, Tangent& tangent) {
  map(theta);
  tangent.take(map);
  bool fresh = true, stale = false;
  VectorXd residual = map.rise() - theta;
  double size = size_of(residual, theta);
  for (;;) {
    VectorXd step = tangent.lu.solve(residual);
    if (size_of(step, theta) <= tolerance) return theta;
    if (stale) {
      tangent.take(map);
      step = tangent.lu.solve(residual);
      fresh = true;
      stale = false;
    }
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
        stale = left_size > March::slopes_serve * size;
        fresh = false;
        size = left_size;
      }
    }
    if (lower) continue;
    if (fresh || --passes < 0) return {};
    map(theta);
    stale = true;
  }
}

/// What a step that is not taken any more would do to mu and its parts, at most: slopes of an earlier pass may cancel
/// where those of the solution do not.
void take_effects(const Tangent& tangent, const VectorXd& step, FixedPoint& found) {
  const VectorXd size = step.cwiseAbs();
  found.mu_error = tangent.slope_of_mu.cwiseAbs().dot(size);
  found.hysteresis_error = tangent.part_slopes.hysteresis.cwiseAbs().dot(size);
  found.area_error = tangent.part_slopes.area.cwiseAbs().dot(size);
}

/// Whether a solution is unstable, or the curve of the march may turn about near it, so that there are others: theta
/// grows much faster than eps, d ln theta / d ln eps = (1 - dF)^-1 theta / theta. By the slopes of the last passes.
bool has_others(const VectorXd& theta, const Tangent& tangent) {
  constexpr double fast = 1.5;
  if (!(tangent.lu.determinant() > 0)) return true;  // an odd number of eigenvalues of dF is above 1
  return !(tangent.lu.solve(theta).cwiseAbs().array() < fast * theta.array()).all();
}

FixedPoint finished(const FlashMap& map, const VectorXd& theta, const Tangent& tangent) {
  FixedPoint found;
  found.theta = theta;
  found.residual = map.rise() - theta;
  take_effects(tangent, tangent.lu.solve(found.residual), found);
  return found;
}

FixedPoint by_march(FlashMap& map, const HeatPoint& point, const VectorXd& cold_rise, Branch branch, double tolerance,
                    Tangent& tangent) {
  March march(map, point.temperature, cold_rise);
  const std::vector<std::pair<Place, Place>> crossings = march.crossings();
  if (crossings.empty())
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(point.temperature) +
                         ": the rubber heats itself above " + in_kelvin(highest_rubber_temperature) + unit("K") +
                         ", which it does not stand",
                     "too-hot");
  const auto& [low, high] = branch == Branch::coldest ? crossings.front() : crossings.back();
  for (const double near : {0.1, 0.01, 1e-3}) {
    const std::optional<VectorXd> theta = newton(map, march.between(low, high, near), tolerance, 30, tangent);
    if (!theta || !March::is_between(low, high, *theta)) continue;  // or another solution
    FixedPoint found = finished(map, *theta, tangent);
    found.solutions = static_cast<int>(crossings.size());
    return found;
  }
  // where eps is flat, Newton's steps in the profile do not end
  const VectorXd theta = march.between(low, high, 10 * March::exactly);
  map(theta);
  if (size_of(map.rise() - theta, theta) < 1e-9) {
    tangent.take(map);
    FixedPoint found = finished(map, theta, tangent);
    found.solutions = static_cast<int>(crossings.size());
    return found;
  }
  throw NotConverged("the flash temperature: Newton's steps do not end");
}

}  // namespace

void Tangent::take(FlashMap& map) {
  jacobian = map.jacobian();
  lu.compute(MatrixXd::Identity(jacobian.rows(), jacobian.cols()) - jacobian);
  slope_of_mu = map.slope_of_mu();
  part_slopes = map.part_slopes();
}

FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const VectorXd& guess,
                             std::optional<double> only_rise, Branch branch, double tolerance, Tangent& tangent) {
  if (only_rise) {
    std::optional<VectorXd> theta;
    if (guess.size() != 0) theta = newton(map, guess, tolerance, March::most_passes, tangent);
    if (!theta) {
      map(VectorXd::Constant(map.rise_size(), *only_rise));
      const VectorXd start = *only_rise / map.rise()[map.rise_size() - 1] * map.rise();
      theta = newton(map, start, tolerance, March::most_passes, tangent);
    }
    if (theta && !has_others(*theta, tangent)) return finished(map, *theta, tangent);
  }
  map(VectorXd::Zero(map.rise_size()));
  const VectorXd cold_rise = map.rise();
  if (cold_rise.lpNorm<Eigen::Infinity>() == 0) {
    tangent.take(map);
    return finished(map, cold_rise, tangent);
  }
  return by_march(map, point, cold_rise, branch, tolerance, tangent);
}

FixedPoint polish(FlashMap& map, const VectorXd& theta, const Tangent& tangent, const MatrixXd& up,
                  const MatrixXd& down, double tolerance) {
  FixedPoint found;
  found.theta = (up * theta).cwiseMax(0.0);
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < March::most_passes; ++pass) {
    map(found.theta);
    found.residual = map.rise() - found.theta;
    const VectorXd coarse = down * found.residual, step = tangent.lu.solve(coarse);
    take_effects(tangent, step, found);
    // what dF adds to a step is smooth, so that the coarser grid knows it
    const VectorXd whole = found.residual + up * (step - coarse);
    const double size = size_of(whole, found.theta);
    if (size <= tolerance || (size < 1e-12 && size >= before)) return found;
    if (size > 0.5 * before) break;
    before = size;
    found.theta = (found.theta + whole).cwiseMax(0.0);
  }
  Tangent own;
  const std::optional<VectorXd> again = newton(map, (up * theta).cwiseMax(0.0), tolerance, March::most_passes, own);
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
    if (i > 2 && std::fabs(value - before) <= rounding_error * std::fabs(value)) break;
    if (i == 39) return dominant_eigenvalue(map.jacobian());
  }
  for (int i = 0; i < 20; ++i) {
    const VectorXd next = map.along(right);
    const double before = value;
    value = left.dot(next) / left.dot(right);
    // between vectors of both sides it is good to a small part of what it changes
    if (std::fabs(value - before) <= (i == 0 ? 10 : 1) * tolerance * std::fabs(value)) return value;
    right = next / next.norm();
  }
  return dominant_eigenvalue(map.jacobian());
}

}  // namespace asperity
