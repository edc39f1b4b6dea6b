// The version of the library that is linked, as against that of its headers.
#include "asperity/version.hpp"

namespace asperity {
const char* version() { return ASPERITY_VERSION; }
}  // namespace asperity
