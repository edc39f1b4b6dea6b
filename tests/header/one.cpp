// One of two files of a host that include the map: the one that defines its C interface.
#include "rules.hpp"

#define ASPERITY_FRICTION_MAP_C
#include <asperity/friction_map.hpp>

double elsewhere(const asperity::FrictionMap& map, double p, double v);
double elsewhere(const asperity::FrictionMap& map, double p, double v) { return map.mu(p, v); }
