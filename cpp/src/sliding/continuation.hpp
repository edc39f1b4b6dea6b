// A map as one period of a surface.
#pragma once

#include <limits>
#include <vector>

#include "asperity/sliding.hpp"

namespace asperity {

struct Period {
  HeightMap::Shape shape;
  std::vector<double> heights;  // [m], of mean 0
  double rms_height;            // [m]
};

/// `shortest` [1/m]: waves beyond it do not count where the map is blended.
Period one_period(const HeightMap& map, Continuation continuation,
                  double shortest = std::numeric_limits<double>::infinity());

}  // namespace asperity
