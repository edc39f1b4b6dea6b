// Tables of F(G) = int_0^G P S(P) dG and F2 = int_0^G F dG in rest = 1 / (1 + z), z = sqrt(G), with P = erf(1 / (2 z))
// or (1 + (pi G)^1.5)^(-1/3) (Eq. 7) and S = gamma + (1 - gamma) P^2 (Eq. 8): integrals over P and over P^3, divided by
// their powers of z at both ends, as polynomials about equal steps of rest.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/theory/contact_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "numerics/chebyshev.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t steps = ContactTable::steps, terms = ContactTable::terms;
using Samples = std::array<double, terms>;

/// p((u - middle) / half) of the polynomial p with these coefficients.
Samples stretched(const Samples& power, double middle, double half) {
  Samples result{};
  for (std::size_t m = terms; m-- > 0;) {  // Horner: times (u - middle) / half
    for (std::size_t i = terms; i-- > 0;) result[i] = ((i > 0 ? result[i - 1] : 0) - middle * result[i]) / half;
    result[0] += power[m];
  }
  return result;
}

struct Integrals {
  double of_p = 0, of_gp = 0;  // int P^power dG, int G P^power dG
};

/// From one value of rest down to another: in z down to rest = 1/2, then in ln z, as z runs away at the end.
Integrals integrals(Form form, int power, double from, double to) {
  const LegendreRule& rule = legendre_rule(24);
  const double a = (1 - from) / from, b = (1 - to) / to;
  const bool far = from <= 0.5;
  const double half = (far ? std::log(b / a) : b - a) / 2;
  Integrals sum;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double at = half * (1 + rule.node[i]), z = far ? a * std::exp(at) : a + at;
    const double share = contact_share(z * z, form);
    const double part = half * rule.weight[i] * 2 * z * (power == 3 ? share * share * share : share) * (far ? z : 1);
    sum.of_p += part;
    sum.of_gp += z * z * part;
  }
  return sum;
}

/// U and V of P^power.
ContactTable tabulated(Form form, int power) {
  static const ChebyshevZeros<terms> zeros;
  ContactTable table;
  Integrals before;
  for (std::size_t i = steps + 1; i-- > 0;) {
    // in u
    const double lower = i == 0 ? 0 : -0.5, upper = i == steps ? 0 : 0.5, middle = (lower + upper) / 2;
    const double half = (upper - lower) / 2;
    const auto rest_at = [&](double u) { return (static_cast<double>(i) + u) / steps; };
    Samples first, second;
    for (std::size_t j = 0; j < terms; ++j) {
      const double rest = rest_at(middle + half * zeros.point[j]), z = (1 - rest) / rest, g = z * z;
      const Integrals here = integrals(form, power, rest_at(upper), rest);
      const double f = before.of_p + here.of_p, f2 = g * f - (before.of_gp + here.of_gp);
      first[j] = f / g / rest;
      second[j] = f2 / g / g / rest;
    }
    for (const auto& [values, powers] : {std::pair{&first, table.first[i]}, std::pair{&second, table.second[i]}}) {
      const Samples found = stretched(powers_of(zeros.series(*values)), middle, half);
      std::ranges::copy(found, powers);
    }
    if (i == 0) break;
    const Integrals whole = integrals(form, power, rest_at(upper), rest_at(lower));
    before = {before.of_p + whole.of_p, before.of_gp + whole.of_gp};
  }
  // F and F2 / G of P^3 are finite where rest is 0
  if (power == 3) table.first[0][0] = table.second[0][0] = 0;
  return table;
}

/// gamma times that of P, and the rest of that of P^3.
ContactTable combined(Form form, double gamma) {
  static const std::array<std::array<ContactTable, 2>, 2> tables{
      {{tabulated(Form::exact, 1), tabulated(Form::exact, 3)},
       {tabulated(Form::interpolated, 1), tabulated(Form::interpolated, 3)}}};
  const auto& [of_p, of_third_power] = tables[form == Form::exact ? 0 : 1];
  ContactTable table;
  for (std::size_t i = 0; i <= steps; ++i)
    for (std::size_t m = 0; m < terms; ++m) {
      table.first[i][m] = gamma * of_p.first[i][m] + (1 - gamma) * of_third_power.first[i][m];
      table.second[i][m] = gamma * of_p.second[i][m] + (1 - gamma) * of_third_power.second[i][m];
    }
  return table;
}

}  // namespace

ContactIntegral::ContactIntegral(Form form, const std::optional<SFunction>& factor)
    : table(combined(form, factor ? factor->gamma : 1)),
      gamma(factor ? factor->gamma : 1),
      whole(full_contact_g(form)),
      has_second(form == Form::exact) {}

}  // namespace asperity
