// The solver's loops (kernel_loops.inc), compiled once for each vector unit, and the choice between them at run time.
#include "numerics/kernels.hpp"

#include <cstdlib>
#include <cstring>
#include <string>

#include "asperity/errors.hpp"

namespace asperity {

namespace {

#ifndef __clang__
#pragma GCC diagnostic ignored "-Wpsabi"  // nothing with four numbers in it leaves this file
#endif

namespace baseline {
constexpr std::size_t width = 2;
#include "numerics/kernel_loops.inc"
}  // namespace baseline

#ifdef __x86_64__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
constexpr std::size_t width = 4;
#include "numerics/kernel_loops.inc"
}  // namespace avx2
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

Kernels choose() {
  const char* const wish = std::getenv("ASPERITY_VECTORS");
  if (wish && std::strcmp(wish, "baseline") != 0 && std::strcmp(wish, "avx2") != 0)
    throw InvalidInput("ASPERITY_VECTORS = " + std::string(wish) + ": must be baseline or avx2");
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && !(wish && std::strcmp(wish, "baseline") == 0)) return avx2::loops("avx2");
#endif
  return baseline::loops("baseline");
}

}  // namespace

const Kernels& kernels() {
  static const Kernels chosen = choose();
  return chosen;
}

}  // namespace asperity
