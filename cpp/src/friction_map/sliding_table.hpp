// The distance over which sliding rubber heats up, over velocity and temperature, as a map with heat holds it.
#pragma once

#include <functional>
#include <vector>

#include "friction_map/sampling.hpp"

namespace asperity {

struct SlidingTable {
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;  // row by row: ln s0 [m] and its slope over ln v at each column
  double error = 0;            // relative, of mu while the rubber heats up, on random points
};

/// At equal steps of ln v and of T0, at the middle of the box's pressures, on which s0 hardly depends. `progress` hears
/// of the share that is done.
SlidingTable sliding_table(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                           const MapHeat& heat, const MapRequest& request, unsigned threads,
                           const std::function<void(double)>& progress);

}  // namespace asperity
