#include "asperity/version.hpp"

namespace asperity {
const char* version() { return ASPERITY_VERSION; }
}  // namespace asperity
