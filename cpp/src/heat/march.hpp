// The temperatures that a part of the heat would keep up, from the coldest on.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "heat/flash_map.hpp"

namespace asperity {

/// A place on the curve theta = eps F(theta), at which theta(q1) = tau.
struct Place {
  double tau, eps;
  Eigen::VectorXd theta;
};

/// Goes along that curve. eps(tau) has one value, is small for small tau and large for large tau, so that its crossings
/// of 1 are all the solutions; a rising one is stable.
class March {
 public:
  /// `cold_rise` is F(0).
  March(FlashMap& map, double background, const Eigen::VectorXd& cold_rise);
  /// Neighbouring places on both sides of eps = 1, from the coldest on, up to twice the highest temperature.
  std::vector<std::pair<Place, Place>> crossings();
  /// The profile between two of them where ln eps is within `near` of 0.
  Eigen::VectorXd between(Place low, Place high, double near);

  /// The profile at eps = 1 between them, also where eps is flat, so that Newton's steps in the profile do not end.
  std::optional<Eigen::VectorXd> root(Place low, Place high);

 private:
  std::optional<Place> next();
  void divide_flat(std::vector<Place>& places);
  std::optional<Place> beyond_turn(Place low, Place middle, Place high);
  std::optional<Place> solve(double tau);

  FlashMap& map_;
  double background_, highest_;
  Place at_;
};

/// 1 - factor dF/dtheta.
Eigen::MatrixXd identity_less(const Eigen::MatrixXd& jacobian, double factor = 1);

/// Rubber does not stand more [K].
inline constexpr double highest_rubber_temperature = 700;

}  // namespace asperity
