// What Gauss-Legendre panels leave out, told from the last Legendre coefficients that they know.
#pragma once

#include <cstddef>

#include "kernels.hpp"

namespace asperity {

/// The larger of coefficients k and k + 1 of a row of them, as one of a pair may vanish.
double larger(const double* tail, std::size_t k);

/// What the rule of n nodes leaves out of the integral over a function as large as `size`: its coefficients from degree
/// 2 n on, told from those half way to n and at n, to which the last ones fall by `decay` a degree. ln(size /
/// coefficient) grows with the degree like n for what is analytic, and by `growth` at most from n to 2 n.
double beyond_rule(double size, const double* tail, double decay, double growth);
inline constexpr double analytic = 2;

/// Sum of effects on a result, those of the last coefficients from the last one down, over all the degrees that follow,
/// where they fall by `decay` a degree.
double following(const double* effect, double decay);

/// F(G) on a panel in which the contact breaks up: exp(-1 / 4 G) is tame where |arg G| < pi / 2 only, so that F is
/// rougher than G is.
struct BreakUp {
  double growth = analytic;  // as of `beyond_rule`: like n^(2/3) at the foot of a front
  double least = 0;          // of what the coefficients of F fall by from n to 2 n
};
BreakUp break_up(const LegendreRule& rule, const double* g);

/// Error of a rule in t on the foot of a front, where F (or F2) leaves the law that it follows above G = 1. It depends
/// on G at the first node alone, whatever the number of nodes: `one` and `three` at most, for P and for P^3, as much
/// less as the exponent says. Measured at n = 12, 20 and 32 against mpmath, G from 1e-7 to 1600; that G must be
/// above 0.
struct Foot {
  double one, three;
  double a, b, c;  // exponent: the least of a / z, b / z^(2/3), c / z^(1/3), with z = sqrt(G)
  [[nodiscard]] double operator()(double g, double gamma) const;
};
inline constexpr Foot foot_of_f{0.021, 0.15, 0.45, 0.92, 3.1}, foot_of_f2{7e-4, 0.014, 0.35, 0.95, 3.4};

}  // namespace asperity
