// P(G), exact, erf(1 / (2 sqrt G)), or interpolated (Eq. 7), and the S factor S = gamma + (1 - gamma) P^2 (Eq. 8)
// inside G, where dG = S dG(uncorrected), or on the integrand of Eq. 22. NayakSFactor has an S of its own, fitted to
// boundary elements, ImplicitSFactor one of the area that results (Y. Xu and others, J. Mech. Phys. Solids, 2024). B.
// N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/theory/s_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"

namespace asperity {

using std::numbers::pi;

double contact_share(double g, Form form) {
  if (form == Form::exact) return std::erf(0.5 / std::sqrt(g));
  return 1 / std::cbrt(1 + std::pow(pi * g, 1.5));
}

double contact_slope(double g, Form form) {
  if (g <= 0) return 0;
  if (form == Form::exact) return -std::exp(-0.25 / g) * std::numbers::inv_sqrtpi / (2 * g * std::sqrt(g));
  const double x = pi * g, root = std::sqrt(x);
  return -0.5 * pi * root * std::pow(1 + x * root, -4.0 / 3);
}

double full_contact_g(Form form) { return form == Form::exact ? 0.007 : 1e-11; }

double SFunction::operator()(double share) const {
  double full = share;
  for (int i = 1; i < power; ++i) full *= share;
  return gamma + (rise == 0 ? 0 : rise * std::sqrt(share)) + (1 - gamma - rise) * full;
}

namespace {

constexpr double step = 1;  // in ln G

}  // namespace

SInside::SInside(const SFunction& s, Form form)
    : s_(s), form_(form), start_(std::log(full_contact_g(form))), end_(full_contact_g(form)) {}

// Over ln G the integrand G / S is analytic in a strip wide enough for 20 points to leave 1e-15, whatever S and P are.
void SInside::add_step() {
  static const ChebyshevZeros<nodes> zeros;
  const double middle = start_ + step * (static_cast<double>(steps_.size()) + 0.5);
  std::array<double, nodes> value;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double g = std::exp(middle + step / 2 * zeros.point[k]);
    value[k] = step / 2 * g / s_(contact_share(g, form_));
  }
  steps_.push_back({end_, powers_of(integral_of(zeros.series(value)))});
  for (const double one : steps_.back().power) end_ += one;
}

// Phi(G) = int_0^G dg / S is close to a power of G between 1 and 2, so that Newton's steps in ln Phi over ln G
// converge from anywhere. Up to the first edge S is 1 to rounding.
double SInside::operator()(double uncorrected) {
  if (uncorrected <= full_contact_g(form_) || s_.gamma == 1) return uncorrected;
  while (end_ < uncorrected) add_step();
  const auto above = std::ranges::lower_bound(steps_, uncorrected, {}, &Step::before);
  const Step& in = *(above - 1);
  const double upper = above == steps_.end() ? end_ : above->before;
  double t = 2 * std::log(uncorrected / in.before) / std::log(upper / in.before) - 1;
  for (int i = 0; i < 20; ++i) {
    double phi = 0, slope = 0;
    for (std::size_t m = in.power.size(); m-- > 0;) {
      slope = slope * t + phi;
      phi = phi * t + in.power[m];
    }
    phi += in.before;
    const double change = std::log(uncorrected / phi) * phi / slope;
    t += change;
    // the next would be its square
    if (std::fabs(change) <= 1e-8)
      return std::exp(start_ + step * (static_cast<double>(above - steps_.begin() - 1) + (t + 1) / 2));
  }
  throw NotConverged("contact area with the S factor inside G: G without = " + show(uncorrected) + " after 20 steps");
}

// Fitted to the areas of 177 boundary-element contacts (tests/reference/make_nayak_s_factor.py).
SFunction nayak_s(double nayak_parameter) {
  return {.gamma = 0.63 * (1 - 0.50 / std::sqrt(std::sqrt(nayak_parameter))), .rise = 0.29, .power = 13};
}

namespace {

/// The S that the correction puts inside G up to `wavenumber`, if any.
std::optional<SFunction> s_inside(const Correction& correction, const Spectrum& spectrum,
                                  std::span<const Segment> surface, double wavenumber) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::friction)
    return SFunction{.gamma = s->gamma};
  if (std::holds_alternative<NayakSFactor>(correction))
    return nayak_s(wavenumber == band(spectrum)[1] ? nayak_parameter(spectrum) : nayak_parameter(surface, wavenumber));
  return {};
}

// G (gamma + (1 - gamma) P) with the P of the result. P(G) falls as G grows, so that there is one. Over ln P the
// residual rises by 1 to 1.5, so that Newton's steps at least halve it.
CorrectedG with_s_of_the_area(double gamma, Form form, double uncorrected) {
  if (uncorrected <= full_contact_g(form) || gamma == 1) return {uncorrected, 1};
  double log_share = std::log(contact_share(uncorrected, form));
  for (int i = 0; i < 60; ++i) {
    const double share = std::exp(log_share), s = gamma + (1 - gamma) * share, g = uncorrected * s;
    const double found = contact_share(g, form), fall = -contact_slope(g, form) * uncorrected * (1 - gamma);
    const double change = (std::log(found) - log_share) / (1 + fall * share / found);
    log_share += change;
    // the next would be its square
    if (std::fabs(change) <= 1e-8) return {uncorrected * (gamma + (1 - gamma) * std::exp(log_share)), s / (1 + fall)};
  }
  throw NotConverged("contact area of the implicit S factor: G without = " + show(uncorrected) + " after 60 steps");
}

}  // namespace

std::optional<SFunction> s_in_integrand(const Correction& correction) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::area)
    return SFunction{.gamma = s->gamma};
  if (const auto* s = std::get_if<NayakSFactor>(&correction)) return SFunction{.gamma = s->friction_gamma};
  return {};
}

AreaG::AreaG(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface, double wavenumber) {
  const Form form = model.form;
  if (const auto s = s_inside(model.correction, spectrum, surface, wavenumber))
    rule_ = [s = *s, inside = SInside(*s, form), form](double g) mutable {
      const double corrected = inside(g);
      return CorrectedG{corrected, s(contact_share(corrected, form))};
    };
  if (const auto* s = std::get_if<ImplicitSFactor>(&model.correction))
    rule_ = [gamma = s->gamma, form](double g) { return with_s_of_the_area(gamma, form, g); };
}

}  // namespace asperity
