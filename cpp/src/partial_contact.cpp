#include "partial_contact.hpp"

#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "integrate.hpp"

namespace asperity {

using std::numbers::pi;

double contact_share(double g, Form form) {
  if (form == Form::exact) return std::erf(0.5 / std::sqrt(g));
  return 1 / std::cbrt(1 + std::pow(pi * g, 1.5));
}

double SFunction::operator()(double share) const {
  const double full = power == 2 ? share * share : std::pow(share, power);
  return gamma + (rise == 0 ? 0 : rise * std::sqrt(share)) + (1 - gamma - rise) * full;
}

// Phi(G) = int_0^G dg / S is close to a power of G between 1 and 2, so that Newton's steps in ln Phi over ln G
// converge from anywhere. Below `low` S is 1 to rounding.
double g_with_s_inside(double uncorrected, const SFunction& s, Form form, double rtol) {
  if (uncorrected == 0 || s.gamma == 1) return uncorrected;
  const double low = 1e-10 * std::fmin(1, uncorrected);
  const auto phi = [&](double g) {
    const auto rate = [&](double x) {
      const double at = std::exp(x);
      return at / s(contact_share(at, form));
    };
    return low + integrate(rate, std::log(low), std::log(g), rtol).value;
  };
  double g = uncorrected;
  for (int i = 0; i < 50; ++i) {
    const double value = phi(g);
    const double step = std::log(uncorrected / value) * s(contact_share(g, form)) * value / g;
    g = std::fmax(g * std::exp(step), low * 2);
    if (std::fabs(step) <= rtol) return g;
  }
  throw NotConverged("contact area with the S factor inside G: G = " + show(g) +
                     " after 50 steps at rtol = " + show(rtol));
}

namespace {

/// Fitted to the areas of 177 boundary-element contacts (tests/reference/make_nayak_s_factor.py).
SFunction nayak_s(double nayak_parameter) {
  return {.gamma = 0.63 * (1 - 0.50 / std::sqrt(std::sqrt(nayak_parameter))), .rise = 0.29, .power = 13};
}

}  // namespace

std::optional<SFunction> s_inside(const Correction& correction, std::span<const Segment> surface, double wavenumber) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::friction)
    return SFunction{.gamma = s->gamma};
  if (std::holds_alternative<NayakSFactor>(correction)) return nayak_s(nayak_parameter(surface, wavenumber));
  return {};
}

std::optional<SFunction> s_in_integrand(const Correction& correction) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::area)
    return SFunction{.gamma = s->gamma};
  if (const auto* s = std::get_if<NayakSFactor>(&correction)) return SFunction{.gamma = s->friction_gamma};
  return {};
}

// Of one modulus G = 1 / (8 p*^2), which is what a load means where the modulus is not one.
MeasuredWorth measured_worth(double g, double p, Form form, std::span<const Segment> surface, double wavenumber) {
  const double uncorrected = g * p * p;
  MeasuredWorth result;
  result.light = 8 * uncorrected * lowest_measured_load * lowest_measured_load > 1 + 1e-9;
  if (!(g > 0 && p > 1 && std::isfinite(uncorrected))) return result;
  constexpr double rtol = 1e-4;  // the truth itself is known to a few percent
  const SFunction s = nayak_s(nayak_parameter(surface, wavenumber));
  const double best = contact_share(g_with_s_inside(uncorrected, s, form, rtol), form);
  result.worse = std::fabs(contact_share(g, form) - best) > std::fabs(contact_share(uncorrected, form) - best);
  return result;
}

double area_g(double g, const ContactModel& model, std::span<const Segment> surface, double wavenumber) {
  if (!(g > 0)) return g;  // full contact, or none
  const std::optional<SFunction> s = s_inside(model.correction, surface, wavenumber);
  return s ? g_with_s_inside(g, *s, model.form, std::fmax(model.rtol / 100, 1e-13)) : g;
}

}  // namespace asperity
