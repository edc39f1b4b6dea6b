// The corrections for partial contact: their checks, and the affine shift p_T of those that have one, p_T1 of the local
// peaks (Eq. 13) and p_T2 of the improved Greenwood-Williamson model (Eqs 16-21).
#include "asperity/correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/visit.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

double highest_point(const LocalPeaks& peaks) { return peaks.z_max.value_or(std::ranges::max(peaks.heights)); }

void validate_heights(double z_max, double z_min) {
  require_finite("z_max", z_max);
  require_finite("z_min", z_min);
  if (!(z_max > 0)) refuse("z_max", z_max, "above the mean plane (positive)");
  if (!(z_min < 0)) refuse("z_min", z_min, "below the mean plane (negative)");
  require_span("z_max", z_max, z_min);
}

void require_share(const char* name, double value) {
  if (!(value >= 0 && value <= 1)) refuse(name, value, "in [0, 1]");
}

void validate_macro(const std::optional<double>& rms_height, const std::optional<double>& q0) {
  if (rms_height) require_positive("rms_height", *rms_height);
  if (q0) require_positive("q0", *q0);
}

void validate_peaks(const LocalPeaks& peaks) {
  require_size("heights", peaks.heights.size(), 3);
  require_each_finite("heights", peaks.heights);
  const double highest = std::ranges::max(peaks.heights), top = highest_point(peaks);
  require_finite("z_max", top);
  if (top < highest) refuse("z_max", top, "no lower than the highest peak, " + show(highest));
  const double lowest = std::ranges::min(peaks.heights);
  require_span("z_max", top, lowest);
  double mean = 0;
  for (const double z : peaks.heights) mean += z / static_cast<double>(peaks.heights.size());
  if (!(mean > 0)) refuse(argument("heights") + ": their mean", mean, "above the mean plane (positive)");
  // not by the rounded mean: peaks of one height are as high as their highest
  if (top == lowest) refuse(argument("heights") + ": their mean", mean, "below z_max = " + show(top));
}

/// The wavenumber of the macro-asperities: the caller's, else the roll-off, else the lowest of the spectrum.
template <class GreenwoodWilliamsonKind>
double macro_wavenumber(const GreenwoodWilliamsonKind& s, const Spectrum& spectrum) {
  if (s.q0) return *s.q0;
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  if (!table) return std::get<SelfAffineSpectrum>(spectrum).rolloff.value_or(band(spectrum)[0]);
  return table->surface().law ? table->surface().law->from : band(spectrum)[0];
}

/// E* of the macro-asperities.
template <class GreenwoodWilliamsonKind>
double modulus_at(const GreenwoodWilliamsonKind& s, const Spectrum& spectrum, const Rubber& rubber, double velocity,
                  double poisson_ratio) {
  const double q0 = macro_wavenumber(s, spectrum), w = q0 * velocity;
  if (const std::optional<FrequencyRange> known = known_range(rubber); known && s.q0) {
    const ShownRange range(known->lowest, known->highest);
    if (w < known->lowest || w > known->highest)
      throw OutOfRange(argument("velocity") + " = " +
                           ShownRange(known->lowest / q0, known->highest / q0).value(velocity) + ": " + argument("q0") +
                           " = " + value(q0, 6) + " 1/m of the correction asks for the modulus at " + range.value(w) +
                           " rad/s, known in " + range.text() + " rad/s" + way_beyond(rubber),
                       "unknown-modulus");
  }
  return effective_modulus(std::abs(asperity::modulus(rubber, w)), poisson_ratio);
}

/// p_T2 and its state for a profile between z_min and z_max.
Shift greenwood_williamson_shift(const MacroAsperities& asperities, double z_max, double z_min, Reading reading,
                                 double pressure, double effective_modulus) {
  const double d = separation(asperities, pressure, effective_modulus, reading).effective;
  Shift shift;
  shift.state = contact_state(d, z_max, z_min);
  shift.separation_over_rms = d / asperities.rms_height;
  if (shift.state == ContactState::full) return shift;
  if (shift.state == ContactState::no_contact) {
    shift.p = std::numeric_limits<double>::infinity();
    return shift;
  }
  shift.p = (z_max - z_min) / (z_max - d);
  constexpr double separation_error = 1e-12;  // of d~ in units of h_rms or d~; 2e-14 at most in tests/reference
  shift.relative_error = separation_error * std::fmax(asperities.rms_height, std::fabs(d)) / (z_max - d);
  return shift;
}

}  // namespace

void validate(const Correction& correction) {
  std::visit(Overloaded{
                 []<class S>(const S& s) {  // those by an S, and those without numbers
                   if constexpr (requires { s.gamma; }) require_share("gamma", s.gamma);
                   if constexpr (requires { s.friction_gamma; }) require_share("friction_gamma", s.friction_gamma);
                 },
                 [](const AffineShift& s) {
                   if (!(s.p >= 1) || !std::isfinite(s.p)) refuse("p", s.p, "1 or more, and finite");
                 },
                 [](const LocalPeaks& s) { validate_peaks(s); },
                 [](const GreenwoodWilliamson& s) {
                   validate_heights(s.z_max, s.z_min);
                   validate_macro(s.rms_height, s.q0);
                   if (!s.peaks.empty()) {
                     require_size("peaks", s.peaks.size(), 3);
                     require_each_finite("peaks", s.peaks);
                     const auto [lowest, highest] = std::ranges::minmax(s.peaks);
                     if (highest > s.z_max)
                       refuse("z_max", s.z_max, "no lower than the highest peak, " + show(highest));
                     require_span("z_max", s.z_max, lowest);
                   }
                 },
                 [](const PeaksThenGreenwoodWilliamson& s) {
                   validate_peaks(s.peaks);
                   validate_heights(s.z_max, s.z_min);
                   validate_macro(s.rms_height, s.q0);
                 },
             },
             correction);
}

double shift_factor(const LocalPeaks& peaks) {
  validate_peaks(peaks);
  const double top = highest_point(peaks);
  double below = 0;  // z_max - <h_peaks>
  for (const double z : peaks.heights) below += (top - z) / static_cast<double>(peaks.heights.size());
  return top / below;
}

Shift affine_shift(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber, double pressure,
                   double velocity, double poisson_ratio) {
  const auto gw = [&](const auto& s, double divisor, std::span<const double> peaks) {
    const double q0 = macro_wavenumber(s, spectrum), rms = s.rms_height ? *s.rms_height : rms_height(spectrum);
    const double modulus = modulus_at(s, spectrum, rubber, velocity, poisson_ratio);
    return greenwood_williamson_shift({rms / divisor, q0, peaks}, s.z_max / divisor, s.z_min / divisor, s.reading,
                                      pressure, modulus);
  };
  return std::visit(Overloaded{
                        [](const auto&) { return Shift{}; },
                        [](const AffineShift& s) { return Shift{.p = s.p}; },
                        [](const LocalPeaks& s) { return Shift{.p = shift_factor(s)}; },
                        [&](const GreenwoodWilliamson& s) { return gw(s, 1, s.peaks); },
                        [&](const PeaksThenGreenwoodWilliamson& s) {
                          const double first = shift_factor(s.peaks);
                          Shift shift = gw(s, first, {});
                          shift.p *= first;
                          return shift;
                        },
                    },
                    correction);
}

bool has_own_rule(const Correction& correction) { return std::holds_alternative<PartialContact>(correction); }

std::optional<double> asperity_wavenumber(const Correction& correction, const Spectrum& spectrum) {
  return std::visit(
      [&](const auto& s) -> std::optional<double> {
        if constexpr (requires { s.reading; }) return macro_wavenumber(s, spectrum);
        return std::nullopt;
      },
      correction);
}

std::optional<double> macro_modulus(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                                    double velocity, double poisson_ratio) {
  return std::visit(
      [&](const auto& s) -> std::optional<double> {
        if constexpr (requires { s.reading; }) return modulus_at(s, spectrum, rubber, velocity, poisson_ratio);
        return std::nullopt;
      },
      correction);
}

}  // namespace asperity
