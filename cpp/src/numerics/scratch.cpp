// Memory on large pages, aligned for SIMD.
#include "numerics/scratch.hpp"

#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace asperity {

void* allocate_pages(std::size_t bytes) {
  constexpr std::size_t large_page = std::size_t{2} << 20, cache_line = 64;
  const bool large = bytes >= large_page;
  void* data = nullptr;
  if (posix_memalign(&data, large ? large_page : cache_line, (bytes + cache_line - 1) / cache_line * cache_line) != 0)
    throw std::bad_alloc();
#ifdef __linux__
  if (large) madvise(data, bytes, MADV_HUGEPAGE);  // advice: nothing is lost where it is not taken
#endif
  return data;
}

}  // namespace asperity
