// The file of a friction map, whose layout stands in asperity/friction_map.hpp.
#pragma once

#include <optional>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "friction_map/refine.hpp"
#include "friction_map/sampling.hpp"
#include "friction_map/sliding_table.hpp"

namespace asperity {

struct MapCertificate {
  double max_error = 0, largest_checked_error = 0;
  std::size_t checked = 0, exceeded = 0;
};

/// What the file of a map with heat, or of one that knows directions, has beside its cells.
struct MapHeatTables {
  std::vector<unsigned char> cold;  // the file of the map without heat, or of forces across
  std::vector<double>
      shift;  // ln a_T of that map and its slope, at each of several nodes of T0; or a and b of slant.hpp
  SlidingTable sliding;
};

std::vector<unsigned char> map_file(const MapFrame& frame, const RefinedMap& refined,
                                    const std::optional<Adhesion>& adhesion, const MapRequest& request,
                                    const MapCertificate& certificate, const MapHeatTables* heat = nullptr);

}  // namespace asperity
