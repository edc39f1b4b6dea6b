// The note on heights that are not Gaussian.
#pragma once

#include <optional>

#include "asperity/errors.hpp"
#include "asperity/spectrum.hpp"

namespace asperity {

/// That of the map that a spectrum was measured on; none where it is unknown.
std::optional<Diagnostic> note_on_heights(const Spectrum& spectrum);

}  // namespace asperity
