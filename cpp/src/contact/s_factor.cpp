// P(G), exact, erf(1 / (2 sqrt G)), or interpolated (Eq. 7), and the S factor S = gamma + (1 - gamma) P^2 (Eq. 8)
// inside G, where dG = S dG(uncorrected), or on the integrand of Eq. 22. NayakSFactor has an S of its own, fitted to
// boundary elements. B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/s_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

using std::numbers::pi;

double contact_share(double g, Form form) {
  if (form == Form::exact) return std::erf(0.5 / std::sqrt(g));
  return 1 / std::cbrt(1 + std::pow(pi * g, 1.5));
}

double full_contact_g(Form form) { return form == Form::exact ? 0.007 : 1e-11; }

double SFunction::operator()(double share) const {
  double full = share;
  for (int i = 1; i < power; ++i) full *= share;
  return gamma + (rise == 0 ? 0 : rise * std::sqrt(share)) + (1 - gamma - rise) * full;
}

namespace {

constexpr double step = 1;  // in ln G: the rule of 16 nodes is good to rounding on it

}  // namespace

SInside::SInside(const SFunction& s, Form form)
    : s_(s), form_(form), start_(std::log(full_contact_g(form))), phi_{std::exp(start_)} {}

/// int dG / S from the lower edge of a step to x = ln G.
double SInside::part(std::size_t index, double x) const {
  const LegendreRule& rule = legendre_rule(16);
  const double lower = start_ + step * static_cast<double>(index), half = (x - lower) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double g = std::exp(lower + half * (1 + rule.node[i]));
    sum += rule.weight[i] * g / s_(contact_share(g, form_));
  }
  return half * sum;
}

// Phi(G) = int_0^G dg / S is close to a power of G between 1 and 2, so that Newton's steps in ln Phi over ln G
// converge from anywhere. Up to the first edge S is 1 to rounding.
double SInside::operator()(double uncorrected) {
  if (uncorrected <= phi_.front() || s_.gamma == 1) return uncorrected;
  while (phi_.back() < uncorrected) {
    const std::size_t last = phi_.size() - 1;
    phi_.push_back(phi_.back() + part(last, start_ + step * static_cast<double>(last + 1)));
  }
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(phi_, uncorrected) - phi_.begin());
  const std::size_t index = above - 1;
  double x = start_ + step * (static_cast<double>(index) +
                              std::log(uncorrected / phi_[index]) / std::log(phi_[above] / phi_[index]));
  for (int i = 0; i < 20; ++i) {
    const double phi = phi_[index] + part(index, x), g = std::exp(x);
    const double change = std::log(uncorrected / phi) * s_(contact_share(g, form_)) * phi / g;
    x += change;
    if (std::fabs(change) <= 1e-14 * std::fmax(1, std::fabs(x))) return std::exp(x);
  }
  throw NotConverged("contact area with the S factor inside G: G = " + show(std::exp(x)) + " after 20 steps");
}

// Fitted to the areas of 177 boundary-element contacts (tests/reference/make_nayak_s_factor.py).
SFunction nayak_s(double nayak_parameter) {
  return {.gamma = 0.63 * (1 - 0.50 / std::sqrt(std::sqrt(nayak_parameter))), .rise = 0.29, .power = 13};
}

std::optional<SFunction> s_inside(const Correction& correction, const Spectrum& spectrum,
                                  std::span<const Segment> surface, double wavenumber) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::friction)
    return SFunction{.gamma = s->gamma};
  if (std::holds_alternative<NayakSFactor>(correction))
    return nayak_s(wavenumber == band(spectrum)[1] ? nayak_parameter(spectrum) : nayak_parameter(surface, wavenumber));
  return {};
}

std::optional<SFunction> s_in_integrand(const Correction& correction) {
  if (const auto* s = std::get_if<SFactor>(&correction); s && s->applies_to != SFactor::AppliesTo::area)
    return SFunction{.gamma = s->gamma};
  if (const auto* s = std::get_if<NayakSFactor>(&correction)) return SFunction{.gamma = s->friction_gamma};
  return {};
}

AreaG::AreaG(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface, double wavenumber) {
  if (const auto s = s_inside(model.correction, spectrum, surface, wavenumber)) inside_.emplace(*s, model.form);
}

double AreaG::operator()(double g) { return inside_ && g > 0 ? (*inside_)(g) : g; }

}  // namespace asperity
