// The error of a Gauss-Legendre rule told by the last coefficients of the function.
#pragma once

#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

/// The rule of n nodes misses coefficients from degree 2 n on. From n / 2 to n they fell by some factor: by as much, at
/// least, they fall from n to 2 n, be it as a power of the degree (at kinks) or faster.
inline double rule_error(const double* tail) {
  double last = 0;
  for (std::size_t k = 0; k < LegendreRule::tails; ++k) last = std::fmax(last, std::fabs(tail[k]));
  const double half_way = std::fmax(std::fabs(tail[LegendreRule::tails]), std::fabs(tail[LegendreRule::tails + 1]));
  return half_way > last ? last * (last / half_way) : last;
}

}  // namespace asperity
