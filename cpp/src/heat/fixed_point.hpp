// The temperature profile that keeps itself up, and those that a part of the heat would keep up, from the coldest on.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "heat/flash_map.hpp"

namespace asperity {

/// A place on the curve theta = eps F(theta), at the length s of the way to it in x: ln theta at the temperature
/// points, and ln kappa behind them with PartialContact.
struct Place {
  double s, eps;
  Eigen::VectorXd x;
  Eigen::Index points;
  [[nodiscard]] Eigen::VectorXd theta() const { return x.head(points).array().exp(); }
  /// theta(q1) [K].
  [[nodiscard]] double tau() const { return std::exp(x[points - 1]); }
};

/// Goes along that curve, which begins at theta = 0 with eps = 0 and leaves all bounds with both. Its crossings of 1
/// are the solutions; one at which eps rises is stable.
class March {
 public:
  /// `cold_rise` is F(0).
  March(FlashMap& map, double background, const Eigen::VectorXd& cold_rise);
  /// Neighbouring places on both sides of eps = 1, in the order of the curve, up to twice the highest temperature.
  std::vector<std::pair<Place, Place>> crossings();
  /// The profile between two of them where ln eps is within `near` of 0, or as near as they come.
  Eigen::VectorXd between(Place low, Place high, double near);
  /// Whether a profile lies between two places, as far as these are known.
  [[nodiscard]] static bool is_between(const Place& low, const Place& high, const Eigen::VectorXd& theta);
  static constexpr double exactly = 1e-12;  // of the largest rise
  /// Slopes of another place serve while no step by them leaves more of the residual.
  static constexpr double slopes_serve = 0.15;
  static constexpr int most_passes = 12;  // of Newton's steps

 private:
  std::optional<Place> next();
  void turn();
  void pass(const Eigen::VectorXd& x);
  Eigen::MatrixXd slopes(const Eigen::VectorXd& x);
  [[nodiscard]] Eigen::MatrixXd bordered(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& direction) const;
  Eigen::VectorXd settled(const Place& place);
  void divide_flat(std::vector<Place>& places);
  std::optional<Place> beyond_turn(Place low, Place middle, Place high);
  std::optional<Place> solve_between(const Place& low, const Place& high, double share);
  std::optional<Place> solve(const Eigen::VectorXd& start, const Eigen::VectorXd& direction, double s, double tolerance,
                             const Eigen::MatrixXd* nearby);

  FlashMap& map_;
  double background_, highest_;
  Place at_;
  Eigen::MatrixXd slopes_;  // at that place, and the direction of the way there, of the length 1
  Eigen::VectorXd direction_;
  double stride_ = 0;             // the last one
  std::optional<bool> negative_;  // the determinant of the bordered slopes along the curve
};

/// Rubber does not stand more [K].
inline constexpr double highest_rubber_temperature = 700;
/// Of ln a_T, over which no term of a rubber comes and goes: a quarter of a decade.
inline constexpr double term_step = std::numbers::ln10 / 4;

struct FixedPoint {
  Eigen::VectorXd theta;                        // at the grid's temperature points [K]
  Eigen::VectorXd residual;                     // F(theta) - theta
  double gain = 0;                              // eigenvalue of dF/dtheta of the largest size
  double mu_error = 0;                          // what the residual does to mu, at most
  double hysteresis_error = 0, area_error = 0;  // and to mu_H and A / A0
  int solutions = 1;                            // stable and unstable ones
};

/// The slopes of a pass, with which further ones step towards the fixed point.
struct Tangent {
  Eigen::MatrixXd jacobian;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;  // of 1 - dF/dtheta
  Eigen::RowVectorXd slope_of_mu;
  FlashMap::PartSlopes part_slopes;
  void take(FlashMap& map);
};

/// A solution of theta = F(theta): where there is one only, whose rise is about `only_rise` [K], by Newton's method
/// from `guess`, or from the profile of that rise; otherwise, or where that does not end or ends near others, the march
/// finds all. Tolerance relative to the largest rise. Leaves the map at the solution. NotConverged, or OutOfRange where
/// there is none up to the temperature that rubber stands.
FixedPoint solve_fixed_point(FlashMap& map, const HeatPoint& point, const Eigen::VectorXd& guess,
                             std::optional<double> only_rise, Branch branch, double tolerance, Tangent& tangent);

/// The same on a finer grid from the solution of a coarser one, whose slopes do: `up` and `down` carry profiles from
/// the coarser grid to the finer one and back.
FixedPoint polish(FlashMap& map, const Eigen::VectorXd& theta, const Tangent& tangent, const Eigen::MatrixXd& up,
                  const Eigen::MatrixXd& down, double tolerance);

/// The eigenvalue of dF/dtheta of the largest size at the last pass, near which `tangent` was taken; to `tolerance`.
double gain_of(FlashMap& map, const Tangent& tangent, double tolerance);

}  // namespace asperity
