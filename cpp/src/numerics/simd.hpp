// Several numbers in one register: the vector extension that GCC and Clang share, in the few forms that are used.
//
// Loops that pay for wider registers than the baseline's stand in an .inc file, without templates and inline functions
// from outside, and vector_units.inc compiles them for each unit; vector_unit() says which of them to call.
#pragma once

#include <cstddef>
#ifdef __SSE2__
#include <emmintrin.h>
#else
#include <cstring>
#endif

namespace asperity {

using Pair = double __attribute__((vector_size(16)));

/// The vector units that loops are compiled for, each with all that the one before it has.
enum class VectorUnit { baseline, avx2, avx512 };

/// The best that this machine has, or the lesser one that the environment names: ASPERITY_VECTORS=baseline or avx2.
VectorUnit vector_unit();

/// Copies whole registers between aligned addresses without reading the target's cache lines first, where the processor
/// can: right for numbers that are read again only after they have left the cache.
inline void store_past_cache(const void* from, std::size_t bytes, void* to) {
#ifdef __SSE2__
  const auto* const source = static_cast<const __m128i*>(from);
  auto* const target = static_cast<__m128i*>(to);
  for (std::size_t i = 0; i < bytes / sizeof *source; ++i) _mm_stream_si128(target + i, _mm_load_si128(source + i));
#else
  std::memcpy(to, from, bytes);
#endif
}

}  // namespace asperity
