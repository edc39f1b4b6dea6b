// What Gauss-Legendre panels leave out, told from the last Legendre coefficients that they know.
#pragma once

#include <cstddef>

#include "numerics/kernels.hpp"

namespace asperity {

/// The larger of coefficients k and k + 1 of a row of them, as one of a pair may vanish.
double larger(const double* tail, std::size_t k);

/// What the rule of n nodes leaves out of the integral over a function as large as `size`: its coefficients from degree
/// 2 n on, told from those half way to n and at n, to which the last ones fall by `decay` a degree. ln(size /
/// coefficient) grows with the degree like n for what is analytic, and by `growth` at most from n to 2 n.
double beyond_rule(double size, const double* tail, double decay, double growth);
inline constexpr double analytic = 2;

}  // namespace asperity
