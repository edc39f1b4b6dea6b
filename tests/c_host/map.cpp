#define ASPERITY_FRICTION_MAP_C
#include <asperity/friction_map.hpp>
