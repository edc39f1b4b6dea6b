// Products of a function of the wavevector with the modes of a real grid, row by row: what lies outside of a set of
// points needs no memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/fft.hpp"

namespace asperity {

/// A factor for each mode of a real grid, column by column.
template <class T>
class Factor {
 public:
  explicit Factor(Grid shape) : rows_(shape[0]), factors_((shape[1] / 2 + 1) * shape[0]) {}
  void set(std::size_t y, std::size_t x, std::complex<T> factor) { factors_[x * rows_ + y] = factor; }
  [[nodiscard]] const std::complex<T>* column(std::size_t x) const { return factors_.data() + x * rows_; }

 private:
  std::size_t rows_;
  std::vector<std::complex<T>> factors_;
};

template <class T>
class Convolution {
 public:
  explicit Convolution(Grid shape)
      : shape_(shape),
        half_(shape[1] / 2 + 1),
        pitch_(Scratch<std::complex<T>>::aligned(half_) + 8),
        forward_row_(shape[1]),
        backward_row_(shape[1], Direction::backward),
        forward_columns_(shape[0]),
        backward_columns_(shape[0], Direction::backward),
        modes_(shape[0] * pitch_),
        columns_(forward_columns_.distance() * width),
        transformed_(forward_columns_.distance() * width),
        row_(shape[1] + 2) {
    std::fill_n(columns_.data(), forward_columns_.distance() * width, std::complex<T>());
  }

  /// fill(y, row) writes row y of a grid into nx numbers, and returns false, without having written, for a row of
  /// zeros. take(y, row) reads a row of the product where wanted(y).
  template <class Fill, class Wanted, class Take>
  void operator()(const Factor<T>& factor, Fill fill, Wanted wanted, Take take) {
    heed();
    const std::size_t ny = shape_[0];
    for (std::size_t y = 0; y < ny; ++y) {
      std::complex<T>* const modes = modes_.data() + y * pitch_;
      if (fill(y, row_.data()))
        forward_row_(row_.data(), modes);
      else
        std::fill_n(modes, half_, std::complex<T>());
    }
    for (std::size_t first = 0; first < half_; first += width) multiply(factor, first);
    for (std::size_t y = 0; y < ny; ++y)
      if (wanted(y)) {
        backward_row_(modes_.data() + y * pitch_, row_.data());
        take(y, row_.data());
      }
  }

 private:
  static constexpr std::size_t width = ColumnsTransform<T>::width;

  /// A few columns: there, times the factor, and back.
  void multiply(const Factor<T>& factor, std::size_t first) {
    heed();
    const std::size_t ny = shape_[0], length = forward_columns_.distance(), columns = std::min(width, half_ - first);
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t k = 0; k < columns; ++k) columns_.data()[k * length + y] = modes_.data()[y * pitch_ + first + k];
    forward_columns_(columns_.data(), transformed_.data());
    const T norm = 1 / static_cast<T>(ny * shape_[1]);
    for (std::size_t k = 0; k < columns; ++k) {
      T* const m = reinterpret_cast<T*>(transformed_.data() + k * length);
      const T* const f = reinterpret_cast<const T*>(factor.column(first + k));
      for (std::size_t i = 0; i < 2 * ny; i += 2) {
        const T a = norm * m[i], b = norm * m[i + 1];
        m[i] = f[i] * a - f[i + 1] * b;
        m[i + 1] = f[i] * b + f[i + 1] * a;
      }
    }
    backward_columns_(transformed_.data(), columns_.data());
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t k = 0; k < columns; ++k) modes_.data()[y * pitch_ + first + k] = columns_.data()[k * length + y];
  }

  Grid shape_;
  std::size_t half_, pitch_;
  RealTransform<T> forward_row_, backward_row_;
  ColumnsTransform<T> forward_columns_, backward_columns_;
  Scratch<std::complex<T>> modes_, columns_, transformed_;
  Scratch<T> row_;
};

}  // namespace asperity
