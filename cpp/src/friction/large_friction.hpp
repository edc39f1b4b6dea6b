// A word on friction that no rubber has.
#pragma once

#include "asperity/friction.hpp"

namespace asperity {

/// Adds a note, before all others, where mu is above what rubber reaches, with the part that makes it.
void note_large_friction(Friction& friction);

}  // namespace asperity
