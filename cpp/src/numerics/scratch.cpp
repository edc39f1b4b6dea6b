// Memory on large pages, aligned for SIMD; the last large block is kept on loan for the next computation.
#include "numerics/scratch.hpp"

#include <complex>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace asperity {

namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;

struct Block {
  void* data = nullptr;
  std::size_t bytes = 0;
};

/// The last large block that was given back, kept for the next scan of about that size: fresh pages are cleared, which
/// takes a tenth of a transform's time, and on a virtual machine that has given them back to its host more than the
/// transform. The system may take pages of a kept block whenever it is short of memory.
class Reserve {
 public:
  static Reserve& get() {
    static Reserve reserve;
    return reserve;
  }
  Reserve() = default;
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;
  ~Reserve() { std::free(kept_.data); }

  Block take(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    return kept_.bytes >= bytes && kept_.bytes <= 2 * bytes ? std::exchange(kept_, {}) : Block{};
  }
  void give(Block block) {
    if (block.bytes >= large_page && on_loan(block)) {
      const std::scoped_lock lock(mutex_);
      std::swap(block, kept_);
    }
    std::free(block.data);
  }

 private:
  static constexpr std::size_t little = std::size_t{64} << 20;

  /// Whether a block may be kept: a large one where the system can have its pages without asking.
  static bool on_loan(const Block& block) {
    if (block.bytes <= little) return true;
#ifdef MADV_FREE
    return madvise(block.data, block.bytes, MADV_FREE) == 0;
#else
    return false;
#endif
  }

  std::mutex mutex_;
  Block kept_;
};

Block allocate(std::size_t wanted) {
  const bool large = wanted >= large_page;
  const std::size_t bytes = (wanted + 63) / 64 * 64;
  if (large)
    if (const Block kept = Reserve::get().take(bytes); kept.data) return kept;
  Block fresh{nullptr, bytes};
  if (posix_memalign(&fresh.data, large ? large_page : 64, bytes) != 0) throw std::bad_alloc();
#ifdef __linux__
  if (large) madvise(fresh.data, bytes, MADV_HUGEPAGE);  // advice: nothing is lost where it is not taken
#endif
  return fresh;
}

}  // namespace

template <class T>
Scratch<T>::Scratch(std::size_t size) {
  const Block block = allocate(size * sizeof(T));
  data_ = static_cast<T*>(block.data);
  bytes_ = block.bytes;
}

template <class T>
Scratch<T>::~Scratch() {
  Reserve::get().give({data_, bytes_});
}

template class Scratch<float>;
template class Scratch<double>;
template class Scratch<std::complex<float>>;
template class Scratch<std::complex<double>>;

}  // namespace asperity
