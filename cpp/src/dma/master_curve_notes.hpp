// Notes of a build: whatever its reader must know beside the numbers.
#pragma once

#include <string>
#include <vector>

#include "dma/time_temperature_shift.hpp"

namespace asperity {

/// b_T = T / T_ref.
std::vector<double> temperature_ratios(const std::vector<Isotherm>& isotherms, double reference);

using Notes = std::vector<Diagnostic>;
/// Neighbours that share less than they should once shifted.
void note_overlaps(const std::vector<Isotherm>& isotherms, const std::vector<double>& log10_a_T, Notes& notes);
/// Shifts that the data do not fix.
void note_undetermined(const std::vector<Isotherm>& isotherms, const std::vector<double>& deviation, Notes& notes);
/// Where E' alone and E'' alone ask for other shifts.
void note_disagreement(const std::vector<Isotherm>& isotherms, const Disagreement& apart, std::size_t fixed,
                       Notes& notes);
/// Points that lie farther from the spline than chance would have it. `shift`: in the spline's own frequencies.
void note_outliers(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, const MasterSpline& spline,
                   const std::vector<double>& shift, Notes& notes);
/// Isotherms that lie off the curve as wholes, by level, slope or bend, more than their scatter has it.
void note_misfit(const SweepPoints& points, const Shifted& fit, const std::vector<double>& b_T, Notes& notes);
/// The difference that the vertical shift b_T = T / T_ref would have made, where it matters.
void note_vertical_shift(const std::vector<Isotherm>& isotherms, const Shifted& first, std::size_t fixed,
                         double reference, Notes& notes);

/// Of ln E' and ln E'' together.
double residual_of(const MasterSpline& spline);

}  // namespace asperity
