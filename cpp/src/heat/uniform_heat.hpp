// The steady state of heat by a model of two temperatures, where it seems to be the only one.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "heat/flash_map.hpp"

namespace asperity {

/// With one temperature T0 + tau for all roughness the contact depends on v a_T alone: what it is at a few values of
/// that serves all velocities of a curve. With F(tau) the rise at q1 that it makes, tau / F(tau) is the eps of the
/// march, but for the profile. Of that the macro-asperities count for most, as F goes as 1 / P_m: they have their own
/// temperature, T0 + tau theta(q_m) / theta(q1).
class UniformHeat {
 public:
  explicit UniformHeat(const HeatScene& scene) : scene_(scene) {}
  /// Another pressure or temperature, or another grid.
  void forget();
  /// The rise at which eps passes 1 [K]; none where it may do so more than once, by a margin for the profile, or not up
  /// to twice the highest rise. The map has to be at the point.
  std::optional<double> only_rise(FlashMap& map, const HeatPoint& point);

 private:
  struct Step {
    double rise, log_rise, log_a;  // tau, ln tau, ln a_T at T0 + tau
  };
  void take_steps(double background);

  const HeatScene& scene_;
  std::vector<Step> steps_;
  std::map<long, FlashMap::ContactHeat> contacts_;  // by ln(v a_T) in steps
};

}  // namespace asperity
