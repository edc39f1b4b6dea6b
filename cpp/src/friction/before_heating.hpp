// Friction as it would be without the heat that it makes, and what comes before this heat.
#pragma once

#include <span>
#include <vector>

#include "asperity/friction.hpp"
#include "contact/grid/cell_sums.hpp"

namespace asperity {

/// What is asked of friction and its slopes alike.
void check_points(const ContactModel& model, const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                  std::span<const double> velocity, unsigned threads);

/// As `friction` at temperatures; `heated`: the notes do not say that heat is left out.
Friction friction_before_heating(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                 const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                 std::span<const double> pressure, std::span<const double> velocity,
                                 std::span<const double> temperature, bool contributions, unsigned threads,
                                 bool heated);

/// Adds a note where more than a part of the hysteresis comes from frequencies that were not measured, and before all
/// others where most of it does.
void note_extrapolated_modulus(Friction& friction);
/// Adds a note, before all others, where mu is above what rubber reaches, with the part that makes it.
void note_large_friction(Friction& friction);

/// Adds the parts of mu_H, `whole`, to the decades of point i, from those of panels with their ends [1/m].
void add_decades(Contributions& c, std::size_t i, double velocity, double whole, std::span<const PanelSum> shares);

/// mu_A per contact share (Eq. 23).
double adhesion_per_share(const Adhesion& adhesion, double pressure, double velocity);

void check_heating(const Heating& heating, const TemperatureShift& shift, const std::optional<Adhesion>& adhesion);

/// The points of a curve side by side, from low to high velocity; whether a point begins a curve.
std::vector<std::size_t> by_curve(std::span<const double> pressure, std::span<const double> velocity,
                                  std::span<const double> temperature);
bool begins(std::span<const std::size_t> order, std::size_t k, std::span<const double> pressure,
            std::span<const double> temperature);

}  // namespace asperity
