// Tables of F(G) = int_0^G P S(P) dG and F2 = int_0^G F dG in y = z / (1 + z), z = sqrt(G), with P = erf(1 / (2 z)) or
// (1 + (pi G)^1.5)^(-1/3) (Eq. 7) and S = gamma + (1 - gamma) P^2 (Eq. 8): integrals over P and over P^3, divided by
// their powers of z at both ends, as polynomials on equal steps of y.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "contact/solver/contact_integral.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t steps = ContactTable::steps, terms = ContactTable::terms;
using Samples = std::array<double, terms>;

constexpr double chebyshev_angle(std::size_t j) { return std::numbers::pi * (static_cast<double>(j) + 0.5) / terms; }

/// The polynomial in powers of u through samples at Chebyshev's points.
void fit(const Samples& sample, double (&power)[terms][ContactTable::functions], std::size_t function) {
  Samples last{1}, now{0, 1};
  for (std::size_t k = 0; k < terms; ++k) {
    double coefficient = 0;
    for (std::size_t j = 0; j < terms; ++j)
      coefficient += (k == 0 ? 1.0 : 2.0) / terms * sample[j] * std::cos(static_cast<double>(k) * chebyshev_angle(j));
    for (std::size_t m = 0; m < terms; ++m) power[m][function] += coefficient * last[m];
    Samples next{};  // T_k+1 = 2 u T_k - T_k-1
    for (std::size_t m = 0; m < terms; ++m) {
      if (m + 1 < terms) next[m + 1] += 2 * now[m];
      next[m] -= last[m];
    }
    last = now;
    now = next;
  }
}

/// U and V of P^power into a table.
void tabulate(Form form, int power, ContactTable& table) {
  const LegendreRule& rule = legendre_rule(24);
  struct Integrals {
    double of_p, of_gp;  // int P^power dG, int G P^power dG
  };
  // in z up to 1, then in ln z: at the upper end of the last step z runs away
  const auto integrals = [&](double from, double to) {
    const double a = from / (1 - from), b = to / (1 - to);
    const bool far = from >= 0.5;
    const double lower = far ? std::log(a) : a, half = ((far ? std::log(b) : b) - lower) / 2;
    Integrals sum{};
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double at = lower + half * (1 + rule.node[i]), z = far ? std::exp(at) : at;
      const double share = contact_share(z * z, form);
      const double part = half * rule.weight[i] * 2 * z * (power == 3 ? share * share * share : share) * (far ? z : 1);
      sum.of_p += part;
      sum.of_gp += z * z * part;
    }
    return sum;
  };
  Integrals before{};
  constexpr double width = 1.0 / steps;
  for (std::size_t i = 0; i < steps; ++i) {
    const double lower = static_cast<double>(i) * width;
    Samples first, second;
    for (std::size_t j = 0; j < terms; ++j) {
      const double y = lower + width * (1 + std::cos(chebyshev_angle(j))) / 2, rest = 1 - y, g = y * y / (rest * rest);
      const Integrals here = integrals(lower, y);
      const double f = before.of_p + here.of_p, f2 = g * f - (before.of_gp + here.of_gp);
      first[j] = f / (y * y) * (power == 3 ? 1 : rest);
      second[j] = f2 / (y * y) / g * (power == 3 ? 1 : rest);
    }
    const std::size_t function = power == 3 ? 1 : 0;
    fit(first, table.power[i], function);
    fit(second, table.power[i], function + 2);
    if (i + 1 == steps) break;
    const Integrals whole = integrals(lower, lower + width);
    before = {before.of_p + whole.of_p, before.of_gp + whole.of_gp};
  }
}

/// y = 1, where z is beyond all, is the start of one step more.
void close(ContactTable& table) {
  for (std::size_t m = 0; m < terms; ++m)
    for (std::size_t function = 0; function < ContactTable::functions; ++function)
      table.power[steps][0][function] += table.power[steps - 1][m][function];
}

const ContactTable& table_of(Form form) {
  static const std::array<ContactTable, 2> tables = [] {
    std::array<ContactTable, 2> made{};
    for (const Form of : {Form::exact, Form::interpolated}) {
      ContactTable& table = made[of == Form::exact ? 0 : 1];
      for (const int power : {1, 3}) tabulate(of, power, table);
      close(table);
    }
    return made;
  }();
  return tables[form == Form::exact ? 0 : 1];
}

}  // namespace

ContactIntegral::ContactIntegral(Form form, const std::optional<SFunction>& factor)
    : table(table_of(form)),
      gamma(factor ? factor->gamma : 1),
      whole(full_contact_g(form)),
      has_second(form == Form::exact) {}

}  // namespace asperity
