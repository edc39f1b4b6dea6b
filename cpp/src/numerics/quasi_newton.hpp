// The least value of a smooth function of a few variables.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "asperity/watch.hpp"

namespace asperity {

/// Where f is least near x, by quasi-Newton steps (BFGS; J. Nocedal and S. J. Wright, Numerical Optimization, Springer
/// 2006, Algorithm 6.1 with a line search that halves). f(x, gradient) gives the value. `inverse`, of the Hessian, is
/// improved on the way: one that is empty begins as the identity. Ends where a step would gain less than `gain`.
template <class F>
double minimize(F&& f, Eigen::VectorXd& x, Eigen::MatrixXd& inverse, double gain, int most_steps) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd gradient(n), next_gradient(n);
  double value = f(x, gradient);
  bool fresh = inverse.size() == 0;
  if (fresh) inverse = Eigen::MatrixXd::Identity(n, n);
  for (int step = 0; step < most_steps; ++step) {
    heed();
    Eigen::VectorXd way = -(inverse * gradient);
    double slope = way.dot(gradient);
    if (!(slope < 0)) {
      inverse.setIdentity();
      fresh = true;
      way = -gradient;
      slope = way.dot(gradient);
    }
    if (!(-slope / 2 > gain)) break;  // what a parabola would gain
    constexpr double longest = 0.5;   // of a step, in any of the unknowns
    double length = std::min(1.0, longest / way.cwiseAbs().maxCoeff());
    double next_value = value;
    Eigen::VectorXd next = x;
    bool lower = false;
    for (int halving = 0; halving < 30 && !lower; ++halving) {
      next = x + length * way;
      next_value = f(next, next_gradient);
      lower = next_value <= value + 1e-4 * length * slope;
      if (!lower) {  // the parabola through both values and the slope
        const double curved = next_value - value - length * slope;
        const double least = std::isfinite(curved) ? -slope * length * length / (2 * curved) : 0;
        length = std::clamp(least, 0.1 * length, 0.5 * length);
      }
    }
    if (!lower) break;
    const Eigen::VectorXd moved = next - x, turned = next_gradient - gradient;
    const double curvature = moved.dot(turned);
    if (curvature > 1e-12 * moved.norm() * turned.norm()) {
      if (fresh) inverse *= curvature / turned.squaredNorm();
      fresh = false;
      const Eigen::VectorXd image = inverse * turned;
      inverse += (1 + turned.dot(image) / curvature) / curvature * (moved * moved.transpose()) -
                 (image * moved.transpose() + moved * image.transpose()) / curvature;
    }
    x = next;
    value = next_value;
    gradient = next_gradient;
  }
  return value;
}

}  // namespace asperity
