// The choice between vector units when the program runs, and the solver's loops (kernel_loops.inc), compiled for each.
#include "numerics/kernels.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "numerics/arguments.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

VectorUnit choose() {
  const char* const wish = std::getenv("ASPERITY_VECTORS");
  if (wish != nullptr && std::strcmp(wish, "baseline") != 0 && std::strcmp(wish, "avx2") != 0)
    throw InvalidInput(argument("ASPERITY_VECTORS") + " = " + word(std::string(wish)) + must_be() + "baseline or avx2");
#ifdef __x86_64__
  if ((wish && std::strcmp(wish, "baseline") == 0) || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return VectorUnit::baseline;
  const bool wider = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                     __builtin_cpu_supports("avx512vl") && wish == nullptr;
  return wider ? VectorUnit::avx512 : VectorUnit::avx2;
#else
  return VectorUnit::baseline;
#endif
}

}  // namespace

VectorUnit vector_unit() {
  static const VectorUnit chosen = choose();
  return chosen;
}

namespace {

#define ASPERITY_LOOPS "numerics/kernel_loops.inc"
#include "numerics/vector_units.inc"

}  // namespace

const Kernels& kernels() {
  static const Kernels chosen = vector_unit() == VectorUnit::baseline ? baseline::loops() : avx2::loops();
  return chosen;
}

}  // namespace asperity
