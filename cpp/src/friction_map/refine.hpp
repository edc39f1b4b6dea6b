// The refinement of a friction map: cells halved until every one keeps the tolerance.
#pragma once

#include <cstdint>
#include <random>

#include "friction_map/cells.hpp"
#include "friction_map/sampling.hpp"

namespace asperity {

/// Evenly in [0, 1), the same on every machine.
class Random {
 public:
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_{20261121};
};

struct RefinedMap {
  MapTree tree;
  double max_error;  // twice the largest relative error on lattices and unseen points
};

/// NotConverged, with what was reached, where too many cells would be needed.
RefinedMap refine(const MapFrame& frame, double rtol, unsigned threads);

}  // namespace asperity
