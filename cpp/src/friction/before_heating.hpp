// Friction as it would be without the heat that it makes.
#pragma once

#include "asperity/friction.hpp"

namespace asperity {

/// As `friction` at temperatures; `heated`: the notes do not say that heat is left out.
Friction friction_before_heating(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                 const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                 std::span<const double> pressure, std::span<const double> velocity,
                                 std::span<const double> temperature, bool contributions, unsigned threads,
                                 bool heated);

/// mu_A per contact share (Eq. 23).
double adhesion_per_share(const Adhesion& adhesion, double pressure, double velocity);

}  // namespace asperity
