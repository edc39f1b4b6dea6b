// Which corrections have a rule of their own, and the wavenumber and the modulus that decide the state of the
// Greenwood-Williamson ones.
#pragma once

#include <optional>

#include "asperity/correction.hpp"

namespace asperity {

/// Whether a theory of its own (contact/theory/theory.hpp) takes the place of Persson's P, over the roughness about
/// each wave.
bool has_own_rule(const Correction& correction);

/// q0 [1/m] of the macro-asperities, whose modulus decides. None for corrections that know no such model.
std::optional<double> asperity_wavenumber(const Correction& correction, const Spectrum& spectrum);

/// E* = |E(q0 v)| / (1 - nu^2) [Pa], q0 of the macro-asperities: p_T depends on sigma0 / E* alone. None for corrections
/// that know no such model.
std::optional<double> macro_modulus(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                                    double velocity, double poisson_ratio);

}  // namespace asperity
