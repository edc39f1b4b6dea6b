// Sums whose order no compiler chooses.
#pragma once

#include <cstddef>

namespace asperity {

/// term(0) + ... + term(n - 1) as four sums side by side, which are then joined: less rounding than one after another,
/// and room for vector units.
template <class Term>
double sum(std::size_t n, Term term) {
  double lane[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (std::size_t k = 0; k < 4; ++k) lane[k] += term(i + k);
  double even = lane[0] + lane[2], odd = lane[1] + lane[3];
  if (i + 2 <= n) {
    even += term(i);
    odd += term(i + 1);
    i += 2;
  }
  return i < n ? even + odd + term(i) : even + odd;
}

}  // namespace asperity
