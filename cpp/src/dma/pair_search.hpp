// The start of a shift fit: every pair of neighbours tried at all places, and the likeliest way through all pairs.
#pragma once

#include "dma/shift_likelihood.hpp"

namespace asperity {

/// Steps of log10 a_T [decades], positive: each isotherm lies that far below the colder one before it. `weight` is that
/// of ShiftLikelihood.
std::vector<double> search_steps(const SweepPoints& points, const Smoothness& smoothness, double weight);

}  // namespace asperity
