// A word on friction that rests on a modulus beyond the measured frequencies.
#pragma once

#include "asperity/friction.hpp"

namespace asperity {

/// Adds a note where more than a part of the hysteresis comes from there, and before all others where most of it does.
void note_extrapolated_modulus(Friction& friction);

}  // namespace asperity
