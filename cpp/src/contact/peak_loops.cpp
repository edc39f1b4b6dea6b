// Sums over the peaks of Greenwood and Williamson's asperities, <(z - d)_+^(3/2)> of Eq. 16 for measured heights, and
// what they are bracketed by (peak_loops.inc). J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. Lond. A 295, 300
// (1966).
#include "contact/peak_loops.hpp"

#include "numerics/kernels.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

#define ASPERITY_LOOPS "contact/peak_loops.inc"
#include "numerics/vector_units.inc"

bool wide() {
  static const bool chosen = vector_unit() != VectorUnit::baseline;
  return chosen;
}

}  // namespace

PeakRange range_of_peaks(const double* height, std::size_t n) {
#ifdef __x86_64__
  if (wide()) return avx2::range(height, n);
#endif
  return baseline::range(height, n);
}

PeakSums sums_over_peaks(const double* height, std::size_t n, double highest, double depth) {
#ifdef __x86_64__
  if (wide()) return avx2::sums(height, n, highest, depth);
#endif
  return baseline::sums(height, n, highest, depth);
}

}  // namespace asperity
