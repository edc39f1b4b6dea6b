// A self-affine spectrum in the terms of its power law.
#pragma once

#include "asperity/spectrum.hpp"

namespace asperity {

/// int_0^L exp(e x) dx, for any e including 0.
double exponential_integral(double e, double length);

/// The slope of ln C in ln q above the roll-off.
double fall(const SelfAffineSpectrum& s);

/// C_r, the density at the roll-off (at q0 where there is none) [m^4].
double density_at_rolloff(const SelfAffineSpectrum& s);

}  // namespace asperity
