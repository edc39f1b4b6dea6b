// The solver's loops (kernel_loops.inc), compiled once for each vector unit, and the choice between them at run time.
#include "numerics/kernels.hpp"

#include <cstdint>

#include "numerics/simd.hpp"

namespace asperity {

namespace {

#define ASPERITY_LOOPS "numerics/kernel_loops.inc"
#include "numerics/vector_units.inc"

}  // namespace

const Kernels& kernels() {
#ifdef __x86_64__
  static const Kernels chosen = vector_unit() == VectorUnit::baseline ? baseline::loops() : avx2::loops();
#else
  static const Kernels chosen = baseline::loops();
#endif
  return chosen;
}

}  // namespace asperity
