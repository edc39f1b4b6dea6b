// p_T2 of Eqs 16 to 21 depends on the temperature by E* = |E(q0 v a_T(T))| / (1 - nu^2) alone.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/correction.hpp"
#include "heat/fixed_point.hpp"
#include "numerics/differences.hpp"

namespace asperity {

ShiftValue held_shift(const TemperatureShift& shift, double temperature) {
  double at = std::fmin(temperature, 2 * highest_rubber_temperature);  // no search goes further
  if (const auto* table = std::get_if<ShiftTable>(&shift))
    at = std::clamp(at, table->temperature().front(), table->temperature().back());
  ShiftValue value = shift_at(shift, at);
  if (at != temperature) value.slope = 0;
  return value;
}

HotShift hot_shift(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                   const ShiftValue& value, double poisson_ratio, double pressure, double velocity) {
  HotShift result;
  const auto at_velocity = [&](double v) {
    return affine_shift(correction, spectrum, rubber, pressure, v, poisson_ratio);
  };
  const std::optional<double> q0 = asperity_wavenumber(correction, spectrum);
  if (!q0) {
    result.shift = at_velocity(velocity);
    return result;
  }
  const double reduced = velocity * std::pow(10.0, value.log10_a_T);
  const std::optional<FrequencyRange> known = known_range(rubber);
  const auto inside = [&](double v) { return known ? std::clamp(v, known->lowest / *q0, known->highest / *q0) : v; };
  result.shift = at_velocity(inside(reduced));
  const double upper = inside(reduced * (1 + difference_step)), lower = inside(reduced * (1 - difference_step));
  if (!(upper > lower) || result.shift.state == ContactState::no_contact) return result;
  const Shift more = at_velocity(upper), less = at_velocity(lower);
  if (more.state != ContactState::no_contact && less.state != ContactState::no_contact)
    result.slope = std::log(more.p / less.p) / std::log(upper / lower) * std::numbers::ln10 * value.slope;
  return result;
}

}  // namespace asperity
