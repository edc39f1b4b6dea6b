// Whether heat has one steady state, by what it would do at one temperature of all roughness.
#pragma once

#include <map>
#include <vector>

#include "heat/flash_map.hpp"

namespace asperity {

/// With one temperature T0 + tau for all roughness the contact depends on v a_T alone: what it is at a few values of
/// that serves all velocities of a curve. With F(tau) the rise at q1 that it makes, tau / F(tau) is the eps of the
/// march; where it rises over all tau, and that by a margin for the profile that it leaves out, there is one state.
class UniformHeat {
 public:
  explicit UniformHeat(const HeatScene& scene) : scene_(scene) {}
  /// Another pressure or temperature, or another grid.
  void forget();
  /// The map has to be at the point.
  bool one_state(FlashMap& map, const HeatPoint& point);

 private:
  struct Step {
    double log_a, growth;  // ln a_T at T0 + tau, its slope over ln tau
  };
  void take_steps(double background);

  const HeatScene& scene_;
  std::vector<Step> steps_;
  std::map<long, FlashMap::ContactHeat> contacts_;  // by ln(v a_T) in steps
};

}  // namespace asperity
