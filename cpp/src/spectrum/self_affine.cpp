// A self-affine spectrum, C = C_r (q / q_r)^(-2 (H + 1)) above the roll-off q_r and C_r below it, with C_r by the rms
// height, h_rms^2 = 2 pi int q C dq; and the changes of band and scale that every spectrum has in common.
// The article's Eq. 28; B. N. J. Persson et al., J. Phys.: Condens. Matter 17, R1 (2005).
#include <cmath>
#include <numbers>
#include <string>

#include "numerics/arguments.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// ln(to / from), good for neighbours too.
double log_ratio(double from, double to) { return std::log1p((to - from) / from); }

/// h_rms^2 / (2 pi C_r), C_r the density at the roll-off.
double height_per_density(const SelfAffineSpectrum& s) {
  if (bends_by_direction(s)) return plane_height(s);
  const double q_r = s.rolloff.value_or(s.q0);
  const double flat = s.q0 * s.q0 * exponential_integral(2, log_ratio(s.q0, q_r));
  return flat + q_r * q_r * exponential_integral(-2 * s.hurst, log_ratio(q_r, s.q1));
}

}  // namespace

double fall(const SelfAffineSpectrum& s) { return -2 * (s.hurst + 1); }

double density_at_rolloff(const SelfAffineSpectrum& s) {
  return s.rms_height * s.rms_height / (2 * pi) / height_per_density(s);
}

SelfAffineSpectrum SelfAffineSpectrum::from_article(double h0, double hurst, double q0, double q1) {
  require_positive("h0", h0);
  SelfAffineSpectrum s{.rms_height = h0, .hurst = hurst, .q0 = q0, .q1 = q1};
  validate(s);
  s.rms_height = h0 * std::sqrt(-std::expm1(-2 * hurst * log_ratio(q0, q1)) / 2);
  return s;
}

void validate(const Spectrum& spectrum) {
  // a table was checked when it was made, and cannot change
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) validate(*s);
}

void validate(const SelfAffineSpectrum& s) {
  require_positive("rms_height", s.rms_height);
  if (!(s.hurst > 0 && s.hurst <= 1)) refuse("hurst", s.hurst, "in (0, 1]");
  require_positive("q0", s.q0);
  require_finite("q1", s.q1);
  if (!(s.q1 > s.q0)) refuse("q1", s.q1, "above " + argument("q0") + " = " + value(s.q0));
  require_band("q1", s.q0, s.q1);
  if (!(s.axis_ratio >= 1 && s.axis_ratio <= 10)) refuse("axis_ratio", s.axis_ratio, "in [1, 10]");
  require_finite("lay", s.lay);
  if (s.rolloff && !(*s.rolloff > s.q0 && *s.rolloff < s.q1))
    refuse("rolloff", *s.rolloff,
           "between " + argument("q0") + " = " + value(s.q0) + " and " + argument("q1") + " = " + value(s.q1));
}

Spectrum truncated(const Spectrum& spectrum, std::optional<double> new_q0, std::optional<double> new_q1) {
  validate(spectrum);
  const auto [old_q0, old_q1] = band(spectrum);
  const double q0 = new_q0.value_or(old_q0), q1 = new_q1.value_or(old_q1);
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  const double last = table ? table->wavenumber().back() : old_q1;  // rows may go beyond the band
  const ShownRange known(old_q0, last);
  require_finite("q0", q0);
  require_finite("q1", q1);
  const auto outside = [&](std::string_view name, double q) {
    const Sentence problem = argument(name) + " = " + known.value(q) + must_be() + "in " + known.text() +
                             ", the spectrum's " + (table ? "rows" : "band") + " [1/m]";
    if (table) throw OutOfRange(problem);
    throw InvalidInput(problem, "invalid-value");
  };
  if (!(q0 >= old_q0 && q0 < last)) outside("q0", q0);
  if (!(q1 > old_q0 && q1 <= last)) outside("q1", q1);
  if (!(q1 > q0)) refuse("q1", q1, "above " + argument("q0") + " = " + value(q0));
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) {
    const double q_r = s->rolloff.value_or(s->q0);
    if (q1 <= q_r)
      refuse("q1", q1, "above the roll-off, " + show(q_r) + ": what is left would be flat, not self-affine");
    return extended(*s, q0, q1);
  }
  return truncated_table(*table, q0, new_q1);
}

SelfAffineSpectrum extended(const SelfAffineSpectrum& spectrum, std::optional<double> q0, std::optional<double> q1) {
  validate(spectrum);
  SelfAffineSpectrum result = spectrum;
  result.q0 = q0.value_or(spectrum.q0);
  result.q1 = q1.value_or(spectrum.q1);
  if (spectrum.rolloff && *spectrum.rolloff <= result.q0) {
    if (const double end = *spectrum.rolloff * std::sqrt(spectrum.axis_ratio); result.q0 < end)
      refuse("q0", result.q0,
             "below the roll-off, " + show(*spectrum.rolloff) + ", or " + show(end) +
                 " and more, where no direction is flat any more");
    result.rolloff.reset();
  }
  validate(result);
  // the density at the new roll-off (or q0) is that of the old law there
  const double from = spectrum.rolloff.value_or(spectrum.q0), to = result.rolloff.value_or(result.q0);
  double top = density_at_rolloff(spectrum) * std::pow(to / from, fall(spectrum));
  // with a roll-off C_r is that of the flat part, without one the mean at q0
  if (spectrum.rolloff && !result.rolloff) top *= mean_of_shape(spectrum);
  result.rms_height = std::sqrt(2 * pi * top * height_per_density(result));
  return result;
}

Spectrum scaled(const Spectrum& spectrum, double factor) {
  validate(spectrum);
  require_positive("factor", factor);
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) {
    SelfAffineSpectrum result = *s;
    result.rms_height *= std::sqrt(factor);
    validate(result);
    return result;
  }
  return scaled_table(std::get<TabulatedSpectrum>(spectrum), factor);
}

}  // namespace asperity
