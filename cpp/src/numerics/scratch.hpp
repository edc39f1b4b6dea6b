// Memory for long computations.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace asperity {

/// `bytes` on large pages where the system has them: touching 4 KiB pages for the first time costs as much as a row's
/// transform.
void* allocate_pages(std::size_t bytes);

/// Memory for numbers that are written before they are read: not cleared, aligned for SIMD.
template <class T>
class Scratch {
 public:
  explicit Scratch(std::size_t size) : data_(static_cast<T*>(allocate_pages(size * sizeof(T)))) {}
  [[nodiscard]] T* data() const { return data_.get(); }
  /// Rows of this many entries keep the alignment of the first one.
  static constexpr std::size_t aligned(std::size_t row) { return (row + 7) / 8 * 8; }

 private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  std::unique_ptr<T, Free> data_;
};

}  // namespace asperity
