// Notes on friction that a modulus beyond the measured frequencies makes, or that no rubber has.
#pragma once

#include "asperity/friction.hpp"

namespace asperity {

/// Adds a note where more than a part of the hysteresis comes from there, and before all others where most of it does.
void note_extrapolated_modulus(Friction& friction);

/// Adds a note, before all others, where mu is above what rubber reaches, with the part that makes it.
void note_large_friction(Friction& friction);

}  // namespace asperity
