// Tables of F(G) = int_0^G P S(P) dG in rest = 1 / (1 + z), z = sqrt(G), with P = erf(1 / (2 z)) or
// (1 + (pi G)^1.5)^(-1/3) (Eq. 7) and S = gamma + (1 - gamma) P^2 (Eq. 8): integrals over P and over P^3, divided by
// their powers of z at both ends, as polynomials about equal steps of rest.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/theory/contact_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

/// int P^power dG from one value of rest down to another: in z down to rest = 1/2, then in ln z, as z runs away at the
/// end.
double integral(Form form, int power, double from, double to) {
  const LegendreRule& rule = legendre_rule(24);
  const double a = (1 - from) / from, b = (1 - to) / to;
  const bool far = from <= 0.5;
  const double half = (far ? std::log(b / a) : b - a) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double at = half * (1 + rule.node[i]), z = far ? a * std::exp(at) : a + at;
    const double share = contact_share(z * z, form);
    sum += half * rule.weight[i] * 2 * z * (power == 3 ? share * share * share : share) * (far ? z : 1);
  }
  return sum;
}

/// U of P^power.
ContactTable tabulated(Form form, int power) {
  static const ChebyshevZeros<terms> zeros;
  ContactTable table;
  double before = 0;
  for (std::size_t i = steps + 1; i-- > 0;) {
    // in u
    const double lower = i == 0 ? 0 : -0.5, upper = i == steps ? 0 : 0.5, middle = (lower + upper) / 2;
    const double half = (upper - lower) / 2;
    const auto rest_at = [&](double u) { return (static_cast<double>(i) + u) / steps; };
    Samples values;
    for (std::size_t j = 0; j < terms; ++j) {
      const double rest = rest_at(middle + half * zeros.point[j]), z = (1 - rest) / rest;
      values[j] = (before + integral(form, power, rest_at(upper), rest)) / (z * z) / rest;
    }
    std::ranges::copy(stretched(powers_of(zeros.series(values)), middle, half), table.powers[i]);
    if (i > 0) before += integral(form, power, rest_at(upper), rest_at(lower));
  }
  if (power == 3) table.powers[0][0] = 0;  // F of P^3 is finite where rest is 0
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
    for (std::size_t m = 0; m < terms; ++m)
      table.powers[i][m] = gamma * of_p.powers[i][m] + (1 - gamma) * of_third_power.powers[i][m];
  return table;
}

}  // namespace

ContactIntegral::ContactIntegral(Form form, const std::optional<SFunction>& factor)
    : table(combined(form, factor ? factor->gamma : 1)),
      gamma(factor ? factor->gamma : 1),
      whole(full_contact_g(form)) {}

}  // namespace asperity
