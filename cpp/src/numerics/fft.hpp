// Transforms of real grids: the one place that knows FFTW.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include "numerics/scratch.hpp"

namespace asperity {

using Grid = std::array<std::size_t, 2>;  // ny, nx

/// One-dimensional transforms of length n, planned once (FFTW_ESTIMATE), run from any thread. Every pointer must
/// be aligned as Scratch is.
template <class T>
class RealTransform {  // n real numbers to n / 2 + 1 modes; the input is overwritten
 public:
  explicit RealTransform(std::size_t n);
  void operator()(T* in, std::complex<T>* out) const;

 private:
  std::size_t n_;
  std::shared_ptr<void> plan_;
  std::vector<std::complex<T>> twiddles_;  // where it goes by a complex transform of half the length
};

enum class Direction { forward, backward };

template <class T>
class ComplexTransform {  // `count` transforms at once, `distance` from one to the next; the input is overwritten
 public:
  ComplexTransform(std::size_t n, std::size_t count, std::size_t distance, Direction direction = Direction::forward);
  void operator()(std::complex<T>* in, std::complex<T>* out) const;

 private:
  std::shared_ptr<void> plan_;
};

template <class T>
class RealInverse {  // n / 2 + 1 modes to the n real numbers sum m exp(i k x 2 pi / n); the input is overwritten
 public:
  explicit RealInverse(std::size_t n);
  void operator()(std::complex<T>* in, T* out) const;

 private:
  std::size_t n_;
  std::shared_ptr<void> plan_;
  std::vector<std::complex<T>> twiddles_;
};

/// Transforms of `width` columns of n modes that lie side by side, a cache line a row, in place.
template <class T>
class ColumnsTransform {
 public:
  static constexpr std::size_t width = 64 / sizeof(std::complex<T>);
  ColumnsTransform(std::size_t n, Direction direction);
  void operator()(std::complex<T>* columns) const;

 private:
  std::shared_ptr<void> plan_;
};

/// sum over all modes of m exp(i (k_y y / ny + k_x x / nx) 2 pi) of a real grid; modes ny x (nx / 2 + 1), which are
/// overwritten.
std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape);

/// The ny x (nx / 2 + 1) modes sum h exp(-i (..)) of a real grid.
std::vector<std::complex<double>> forward_transform(const std::vector<double>& heights, Grid shape);

}  // namespace asperity
