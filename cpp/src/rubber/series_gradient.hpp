// From slopes over I1 and I2 at some frequencies to those over the numbers of a Prony series.
#pragma once

#include <Eigen/Core>

#include "rubber/modulus_gradient.hpp"

namespace asperity {

/// Over ln E_inf, ln E_k and ln tau_k.
struct SeriesGradient {
  double equilibrium_modulus = 0;
  Eigen::VectorXd moduli, relaxation_times;
};

/// A number's slopes over integrals at any frequencies are first those at even steps of ln w, between which the
/// integrals are polynomials, so that a point takes products of matrices that are known once.
class SeriesSlopes {
 public:
  /// For integrals at frequencies in [lowest, highest] [rad/s].
  SeriesSlopes(const PronySeries& series, double lowest, double highest);
  [[nodiscard]] SeriesGradient operator()(const IntegralSlopes& of) const;

 private:
  const PronySeries& series_;
  double first_;  // ln w, a whole number of steps: what a point has does not depend on the others of a call
  // of each term at each step: s / t, s, ds / d ln t over t, ds / d ln t, u and 1 / r
  Eigen::MatrixXd share_over_t_, share_, slope_over_t_, slope_, u_, inverse_root_;
  Eigen::MatrixXd of_weights_, of_weights_by_time_;  // what w_k have of each E_l and tau_l beside those of their own
};

}  // namespace asperity
