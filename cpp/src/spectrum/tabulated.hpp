// Changes of a spectrum row by row, its quality included.
#pragma once

#include <optional>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Without q1 the rows beyond the band stay.
TabulatedSpectrum truncated_table(const TabulatedSpectrum& table, double q0, std::optional<double> q1);
TabulatedSpectrum scaled_table(const TabulatedSpectrum& table, double factor);

}  // namespace asperity
