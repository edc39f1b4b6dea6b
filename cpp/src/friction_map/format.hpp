// The file of a friction map, whose layout stands in asperity/friction_map.hpp.
#pragma once

#include <vector>

#include "asperity/build_friction_map.hpp"
#include "friction_map/cells.hpp"
#include "friction_map/sampling.hpp"

namespace asperity {

struct MapCertificate {
  double max_error = 0, largest_checked_error = 0;
  std::size_t checked = 0, exceeded = 0;
};

std::vector<unsigned char> map_file(const MapFrame& frame, const MapTree& tree, const std::optional<Adhesion>& adhesion,
                                    const MapRequest& request, const MapCertificate& certificate);

}  // namespace asperity
