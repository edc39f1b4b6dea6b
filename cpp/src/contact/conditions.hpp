// Checks of arguments that contact and friction share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "asperity/contact.hpp"
#include "contact/correction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/libraries.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/harmonics.hpp"

namespace asperity {

/// Refuses GSL's methods where only ours do; `where` goes on after "must be gauss".
inline void check_gauss(Method method, const std::string& where) {
  constexpr std::array<const char*, 4> names{"gauss", "qag", "qags", "cquad"};
  if (method != Method::gauss)
    throw InvalidInput(argument("method") + " = " + word(names[static_cast<std::size_t>(method)]) + must_be() +
                       "gauss " + where);
}

inline void check_contact(const ContactModel& model, std::span<const double> pressure,
                          std::span<const double> velocity) {
  require_poisson("poisson_ratio", model.poisson_ratio);
  require_rtol(model.rtol);
  if (!has_gsl_and_fftw) check_gauss(model.method, "in a build without GSL, as ASPERITY_PERMISSIVE makes it");
  validate(model.correction);
  require_finite("direction", model.direction);
  const bool by_rule = has_own_rule(model.correction) || std::holds_alternative<ScanContact>(model.correction);
  if (model.form != Form::exact && by_rule)
    throw InvalidInput(argument("form") + " = " + word("interpolated") + must_be() +
                       "exact with PartialContact and ScanContact, whose rule has the exact A / A0 in it");
  if (by_rule) check_gauss(model.method, "with PartialContact and ScanContact, whose rule GSL's methods do not know");
  require_same_size("velocity", velocity.size(), "pressure", pressure.size());
  if (velocity.empty())
    throw InvalidInput(argument("pressure") + ", " + argument("velocity") + ": have 0 entries" + must(", must have ") +
                       "1 or more");
  for (const double p : pressure) require_positive("pressure", p);
  for (const double v : velocity) require_positive("velocity", v);
}

/// A spectrum as it is solved: rows with harmonics where it knows directions. A scan's contact knows them by itself.
class AsSolved {
 public:
  AsSolved(const Spectrum& spectrum, const ContactModel& model) : spectrum_(spectrum) {
    if (!is_directional(spectrum) || std::holds_alternative<ScanContact>(model.correction)) return;
    constexpr double least_rtol = 1e-7;  // of the rows of a law
    check_gauss(model.method, "with a directional spectrum, whose force across GSL's methods do not know");
    if (model.rtol < least_rtol) refuse("rtol", model.rtol, "1e-7 or more with a directional spectrum");
    if (const auto* const law = std::get_if<SelfAffineSpectrum>(&spectrum)) rows_ = rows_of_law(*law);
  }
  [[nodiscard]] const Spectrum& get() const { return rows_ ? *rows_ : spectrum_; }

 private:
  const Spectrum& spectrum_;
  std::shared_ptr<const Spectrum> rows_;
};

inline void refuse_directions(const Spectrum& spectrum, const char* what) {
  if (is_directional(spectrum))
    throw InvalidInput(argument("spectrum") + ": knows directions, of which there is no " + what + must(", must be ") +
                       "a mean over them");
}

/// Refuses a G at the end of the spectrum that a double cannot hold, by the pressure it comes from.
inline void check_g(double g, double pressure) {
  if (!(g >= 1e-280 && g <= 1e180))  // its square and its root are doubles too
    throw InvalidInput(argument("pressure") + " = " + value(pressure) + ": leads to G = " + show(g) +
                       must(", must be ") + "such that G is in [1e-280, 1e180]");
}

/// work(), with the point added to the message of a NotConverged; its temperature where heat makes one of its own.
template <class Work>
void at_point(double pressure, double velocity, std::optional<double> temperature, Work work) {
  try {
    work();
  } catch (const NotConverged& error) {
    Sentence where =
        argument("pressure") + " = " + value(pressure) + ", " + argument("velocity") + " = " + value(velocity);
    if (temperature) where = where + ", " + argument("temperature") + " = " + value(*temperature, 12, "K");
    throw NotConverged(error.diagnostic().within(where + ": "));
  }
}

template <class Work>
void at_point(double pressure, double velocity, Work work) {
  at_point(pressure, velocity, {}, work);
}

/// work(), with the temperature added to the message of an OutOfRange.
template <class Work>
void at_temperature(double temperature, Work work) {
  try {
    work();
  } catch (const OutOfRange& error) {
    throw OutOfRange(error.diagnostic().within(argument("temperature") + " = " + in_kelvin(temperature) + ": "));
  }
}

/// What would let a rubber be asked beyond its measured frequencies, as a part of a message.
inline Sentence way_beyond(const Rubber& rubber) {
  if (const auto* curve = std::get_if<MasterCurve>(&rubber))
    return curve->extrapolation() ? Sentence{}
                                  : "; " + advice("extrapolate-curve", "extrapolation= of the master curve") +
                                        " adds a decade at each end";
  return "; " + advice("extrapolate-series", "extrapolation=\"prony\" of fit_prony") + " goes on beyond them";
}

/// OutOfRange where v q0 or v q1 of a velocity leaves the measured frequencies. It speaks of the fastest one, or of the
/// slowest where that one alone is out, so that what it offers serves all of them.
inline void check_frequencies(const Spectrum& spectrum, const Rubber& rubber, std::span<const double> velocity) {
  const std::optional<FrequencyRange> known = known_range(rubber);
  if (!known) return;
  const auto [q0, q1] = band(spectrum);
  const auto [lowest, highest] = *known;
  const auto [slowest, fastest] = std::ranges::minmax(velocity);
  const bool above = is_above(fastest * q1, highest), below = is_below(slowest * q0, lowest);
  if (!above && !below) return;
  const double worst = above ? fastest : slowest;
  const ShownRange range(lowest, highest);
  Phrase shown = value(worst, 6);
  Sentence where{"; no velocity asks for less than is known, with this q0 and this q1"};
  if (lowest / q0 <= highest / q1) {
    const ShownRange fit(lowest / q0, highest / q1);
    shown = fit.value(worst);
    where = "; velocities " +
            advice("allowed-velocities", "from " + fit.lowest().text + " to " + fit.highest().text + " m/s",
                   {fit.lowest().numbers[0], fit.highest().numbers[0]}) +
            " are allowed";
  }
  Sentence text = argument("velocity") + " = " + shown + ": " + argument("q0") + " = " + value(q0, 6) + " and " +
                  argument("q1") + " = " + value(q1, 6) + " 1/m ask for the modulus from " + range.value(worst * q0) +
                  " to " + range.value(worst * q1) + " rad/s, known in " + range.text() + " rad/s";
  const auto cut = [&](double end) {
    const Phrase last = ShownRange(q0, end / fastest).highest();
    return advice("end-spectrum", ".truncated(q1=" + last.text + ")", last.numbers);
  };
  const Sentence way = way_beyond(rubber);
  if (const double decade = 10 * highest; !std::holds_alternative<MasterCurve>(rubber))
    text = text + way;
  else if (!way.empty() && fastest * q0 < decade && slowest * q0 >= lowest / 10) {  // else a decade does not serve
    text = text + way;
    if (decade < fastest * q1) text = text + ", and " + cut(decade) + " ends the spectrum there";
  }
  if (!below && fastest * q0 < highest) text = text + "; " + cut(highest) + " ends the spectrum where it is known";
  throw OutOfRange(text + where, "unknown-modulus");
}

}  // namespace asperity
