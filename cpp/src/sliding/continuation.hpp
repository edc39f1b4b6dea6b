// A map as one period of a surface.
#pragma once

#include <vector>

#include "asperity/sliding.hpp"

namespace asperity {

struct Period {
  HeightMap::Shape shape;
  std::vector<double> heights;  // [m], of mean 0
  double rms_height;            // [m]
};

Period one_period(const HeightMap& map, Continuation continuation);

}  // namespace asperity
