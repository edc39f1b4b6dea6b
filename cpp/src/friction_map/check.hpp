// The last check of a friction map: random points that nothing was made from, against the solver itself.
#pragma once

#include <functional>

#include "friction_map/format.hpp"

namespace asperity {

/// Fills in the certificate; `progress` hears of the share of the points that are done. NotConverged where one is off
/// by more than rtol.
void check(const MapFrame& frame, const std::vector<unsigned char>& file, const MapRequest& request, unsigned threads,
           const std::function<void(double)>& progress, MapCertificate& certificate);

}  // namespace asperity
