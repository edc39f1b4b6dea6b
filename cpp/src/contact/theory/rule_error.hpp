// The error of a Gauss-Legendre rule told by the last coefficients of the function.
#pragma once

#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

/// The rule of n nodes misses coefficients from degree 2 n on. From n / 2 to n they fell by some factor: by as much
/// they fall from n to 2 n where they go as a power of the degree, as where a function begins as a broken power at an
/// end, with a knot of a master curve or else; by its square where they fall like those of analytic functions. Where a
/// small part of a function falls more slowly than the rest, they fall less than this says, by `least_fall`.
inline constexpr double least_fall = 0.02;
inline double rule_error(const double* tail) {
  double last = 0;
  for (std::size_t k = 0; k < LegendreRule::tails; ++k) last = std::fmax(last, std::fabs(tail[k]));
  const double half_way = std::fmax(std::fabs(tail[LegendreRule::tails]), std::fabs(tail[LegendreRule::tails + 1]));
  if (!(half_way > last)) return last;
  const double fall = last / half_way;
  return last * std::fmax(least_fall, fall * std::fmin(1, 20 * fall));
}

}  // namespace asperity
