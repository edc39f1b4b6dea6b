// Products of a function of the wavevector with the modes of a real grid, row by row: what lies outside of a set of
// points needs no memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/fft.hpp"

namespace asperity {

/// c(q_x) |q|^power, power 1 or -1, and 0 at q = 0.
template <class T>
struct Factor {
  std::vector<std::complex<T>> column;  // by k_x
  int power;
};

/// Wavenumbers are in radians a pixel along x; `aspect` is dx / dy.
template <class T>
class Convolution {
 public:
  Convolution(Grid shape, double aspect)
      : shape_(shape),
        half_(shape[1] / 2 + 1),
        pitch_(Scratch<std::complex<T>>::aligned(half_) + 8),
        forward_row_(shape[1]),
        backward_row_(shape[1]),
        forward_columns_(shape[0], Direction::forward),
        backward_columns_(shape[0], Direction::backward),
        qx_squared_(pitch_),
        qy_squared_(shape[0]),
        modes_(shape[0] * pitch_),
        slab_(shape[0] * width),
        row_(shape[1] + 2) {
    // columns beside the last one stay 0
    std::memset(static_cast<void*>(modes_.data()), 0, shape[0] * pitch_ * sizeof(std::complex<T>));
    const auto [ny, nx] = shape;
    const double step_x = 2 * std::numbers::pi / static_cast<double>(nx);
    const double step_y = 2 * std::numbers::pi * aspect / static_cast<double>(ny);
    for (std::size_t k = 0; k < pitch_; ++k) qx_squared_[k] = squared(step_x * static_cast<double>(k));
    for (std::size_t k = 0; k < ny; ++k) qy_squared_[k] = squared(step_y * static_cast<double>(std::min(k, ny - k)));
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
        std::memset(static_cast<void*>(modes), 0, pitch_ * sizeof *modes);
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
  static T squared(double q) { return static_cast<T>(q * q); }

  /// A cache line of columns: there, times the factor, and back.
  void multiply(const Factor<T>& factor, std::size_t first) {
    heed();
    const std::size_t ny = shape_[0], bytes = width * sizeof(std::complex<T>);
    std::complex<T>* const slab = slab_.data();
    for (std::size_t y = 0; y < ny; ++y)
      std::memcpy(static_cast<void*>(slab + y * width), modes_.data() + y * pitch_ + first, bytes);
    forward_columns_(slab);
    const T norm = 1 / static_cast<T>(ny * shape_[1]);
    T real[width] = {}, imaginary[width] = {};
    for (std::size_t k = 0; k < width && first + k < half_; ++k) {
      real[k] = norm * factor.column[first + k].real();
      imaginary[k] = norm * factor.column[first + k].imag();
    }
    const T* const qx = qx_squared_.data() + first;
    for (std::size_t y = 0; y < ny; ++y) {
      const T qy = qy_squared_[y];
      T* const m = reinterpret_cast<T*>(slab + y * width);
      T scale[width];
      for (std::size_t k = 0; k < width; ++k) scale[k] = std::sqrt(qx[k] + qy);
      if (factor.power < 0)
        for (std::size_t k = 0; k < width; ++k) scale[k] = 1 / scale[k];
      if (first == 0 && y == 0) scale[0] = 0;
      for (std::size_t k = 0; k < width; ++k) {
        const T a = m[2 * k] * scale[k], b = m[2 * k + 1] * scale[k];
        m[2 * k] = real[k] * a - imaginary[k] * b;
        m[2 * k + 1] = real[k] * b + imaginary[k] * a;
      }
    }
    backward_columns_(slab);
    for (std::size_t y = 0; y < ny; ++y)
      std::memcpy(static_cast<void*>(modes_.data() + y * pitch_ + first), slab + y * width, bytes);
  }

  Grid shape_;
  std::size_t half_, pitch_;
  RealTransform<T> forward_row_;
  RealInverse<T> backward_row_;
  ColumnsTransform<T> forward_columns_, backward_columns_;
  std::vector<T> qx_squared_, qy_squared_;
  Scratch<std::complex<T>> modes_, slab_;
  Scratch<T> row_;
};

}  // namespace asperity
