// Transforms of real grids, by FFTW (fft_fftw.cpp) or by pocketfft (fft_pocketfft.cpp): the one place that knows
// either.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "numerics/libraries.hpp"
#include "numerics/scratch.hpp"

namespace asperity {

using Grid = std::array<std::size_t, 2>;  // ny, nx

enum class Direction { forward, backward };

/// One-dimensional transforms of length n, planned once, run from any thread. Every pointer must be aligned as Scratch
/// is.
template <class T>
class RealTransform {  // n real numbers to n / 2 + 1 modes, or back; the input is overwritten
 public:
  /// Rows that are transformed at once: pocketfft takes for all of them little longer than for one.
  static constexpr std::size_t together = has_gsl_and_fftw ? 1 : 32 / sizeof(T);
  explicit RealTransform(std::size_t n, Direction direction = Direction::forward);
  void operator()(T* in, std::complex<T>* out) const;
  /// `together` rows at once, `row` numbers and `modes` modes from one to the next.
  void operator()(T* in, std::size_t row, std::complex<T>* out, std::size_t modes) const;
  /// The way back, sum m exp(i k x 2 pi / n), of one that goes it.
  void operator()(std::complex<T>* in, T* out) const;

 private:
  [[maybe_unused]] std::size_t n_;
  std::shared_ptr<void> plan_;
};

/// Transforms of `width` columns of n modes, as many as a cache line has of each row; the input is overwritten.
template <class T>
class ColumnsTransform {
 public:
  static constexpr std::size_t width = 64 / sizeof(std::complex<T>);
  explicit ColumnsTransform(std::size_t n, Direction direction = Direction::forward);
  /// From one column to the next: they lie behind each other in memory, a cache line apart from a power of two.
  [[nodiscard]] std::size_t distance() const { return distance_; }
  void operator()(std::complex<T>* in, std::complex<T>* out) const;

 private:
  std::size_t distance_;
  Direction direction_;
  std::shared_ptr<void> plan_;
};

/// sum over all modes of m exp(i (k_y y / ny + k_x x / nx) 2 pi) of a real grid; modes ny x (nx / 2 + 1), which are
/// overwritten.
std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape);

/// The ny x (nx / 2 + 1) modes sum h exp(-i (..)) of a real grid.
std::vector<std::complex<double>> forward_transform(const std::vector<double>& heights, Grid shape);

}  // namespace asperity
