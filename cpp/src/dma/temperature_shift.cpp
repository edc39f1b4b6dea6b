// The time-temperature shift a_T and its slope over temperature, by the law of Williams, Landel and Ferry,
// log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) (J. Am. Chem. Soc. 77, 3701 (1955)), that of Arrhenius,
// ln a_T = (E_a / R) (1 / T - 1 / T_ref), or measured shift factors.
#include <cmath>
#include <numbers>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/visit.hpp"

namespace asperity {

namespace {

constexpr double lowest_temperature = 150;  // [K]: rubber is glass far above it, and a temperature in Celsius below

ShiftValue wlf(double c1, double c2, double reference, double temperature) {
  const double distance = c2 + (temperature - reference);
  if (!(distance > 0))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) +
                         ": the WLF law has no a_T at or below reference_temperature - c2 = " +
                         in_kelvin(reference - c2) + unit("K"),
                     "unknown-shift");
  return {-c1 * (temperature - reference) / distance, -c1 * (c2 / distance / distance)};
}

void require_kelvin(std::string_view name, double temperature) {
  if (!(temperature >= lowest_temperature) || !std::isfinite(temperature))
    throw InvalidInput(argument(name) + " = " + value(temperature, 12, "K") + must_be() + "finite and at least " +
                           value(lowest_temperature, 12, "K") +
                           Phrase(Phrase::Kind::unit, "; its unit is kelvin", {}, "K"),
                       "invalid-value");
}

}  // namespace

void validate(const WLF& law) {
  require_positive("c1", law.c1);
  require_positive("c2", law.c2);
  require_kelvin("reference_temperature", law.reference);
}

void require_temperature(double temperature) { require_kelvin("temperature", temperature); }

ShiftValue shift_at(const TemperatureShift& shift, double temperature) {
  require_temperature(temperature);
  const ShiftValue value = std::visit(
      Overloaded{[&](const WLF& law) { return wlf(law.c1, law.c2, law.reference, temperature); },
                 [&](const WlfFit& fit) { return wlf(fit.c1, fit.c2, fit.reference, temperature); },
                 [&](const ArrheniusFit& fit) {
                   const double scale = fit.activation_energy / (gas_constant * std::numbers::ln10);
                   return ShiftValue{scale * (1 / temperature - 1 / fit.reference), -scale / temperature / temperature};
                 },
                 [&](const ShiftTable& table) { return table.shift_at(temperature); }},
      shift);
  if (!(std::fabs(value.log10_a_T) <= 200))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) +
                     ": log10 a_T = " + show(value.log10_a_T, 6) + must(", must be ") + "in [-200, 200]");
  if (!(std::fabs(value.slope) <= 1e6))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) + ": log10 a_T changes by " +
                     show(value.slope, 6) + " per kelvin" + must(", must be ") + "at most 1e6");
  return value;
}

Rubber shifted(const Rubber& rubber, const TemperatureShift& shift, double temperature) {
  const double a_T = std::pow(10.0, shift_at(shift, temperature).log10_a_T);
  return std::visit([&](const auto& one) { return Rubber(one.shifted(a_T)); }, rubber);
}

}  // namespace asperity
