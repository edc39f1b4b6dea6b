// How far a rubber slides until its friction is that of the heated one.
#pragma once

#include "heat/flash_map.hpp"

namespace asperity {

/// The distance [m] from rest, at the point's velocity throughout, at which mu has come from that without heat to
/// within 1 / e of that in the end; of the rise at q1 where mu does not change. To about 1 % of the contact's diameter.
double sliding_length(const HeatScene& scene, const HeatPoint& point);

}  // namespace asperity
