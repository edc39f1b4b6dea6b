// Memory for long computations.
#pragma once

#include <cstddef>

namespace asperity {

/// Memory for numbers that are written before they are read: not cleared, on large pages where the system has
/// them (touching 4 KiB pages for the first time costs as much as a row's transform), aligned for SIMD.
template <class T>
class Scratch {
 public:
  explicit Scratch(std::size_t size);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] T* data() const { return data_; }
  /// Rows of this many entries keep the alignment of the first one.
  static constexpr std::size_t aligned(std::size_t row) { return (row + 7) / 8 * 8; }

 private:
  T* data_;
  std::size_t bytes_;
};

}  // namespace asperity
