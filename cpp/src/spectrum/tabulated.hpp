// What is done to a spectrum row by row, its quality included.
#pragma once

#include "asperity/spectrum.hpp"

namespace asperity {

TabulatedSpectrum truncated_table(const TabulatedSpectrum& table, double q0, double q1);
TabulatedSpectrum scaled_table(const TabulatedSpectrum& table, double factor);

}  // namespace asperity
