// The notes on heights that are not Gaussian, and on ridges that a spectrum does not know.
#pragma once

#include <optional>

#include "asperity/errors.hpp"
#include "asperity/spectrum.hpp"

namespace asperity {

/// That of the map that a spectrum was measured on; none where it is unknown.
std::optional<Diagnostic> note_on_heights(const Spectrum& spectrum);
/// On its lay, unless the spectrum has directions.
std::optional<Diagnostic> note_on_lay(const Spectrum& spectrum);

}  // namespace asperity
