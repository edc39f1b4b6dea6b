// The refinement of a friction map: cells halved until every one keeps the tolerance.
#pragma once

#include <functional>
#include <vector>

#include "friction_map/cells.hpp"
#include "friction_map/sampling.hpp"

namespace asperity {

struct RefinedMap {
  MapTree tree;
  std::vector<double> heights;  // at which the tree has planes, of a value and a slope each; or one
  double max_error;             // twice the largest relative error on lattices and unseen points
};

/// NotConverged, with what was reached, where too many cells would be needed. `progress` hears of the share of the
/// points that are solved.
RefinedMap refine(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress);

}  // namespace asperity
