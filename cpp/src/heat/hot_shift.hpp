// The affine shift p_T of a rubber at a temperature of its own.
#pragma once

#include <optional>

#include "asperity/contact.hpp"
#include "asperity/dma.hpp"

namespace asperity {

/// a_T and its slope at a temperature [K], held where what is known of it ends: while a temperature is searched for, it
/// may go beyond. Whether the result lies inside is for the caller to check.
ShiftValue held_shift(const TemperatureShift& shift, double temperature);

/// p_T with the slope of its logarithm over the temperature [1/K].
struct HotShift {
  Shift shift;
  double slope = 0;
};

/// That of corrections by Greenwood-Williamson's model follows |E(q0 v a_T)| with the a_T of what q0 feels; those of
/// the others stay.
HotShift hot_shift(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                   const ShiftValue& value, double poisson_ratio, double pressure, double velocity);

}  // namespace asperity
