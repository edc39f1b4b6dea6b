// Transforms of whole grids, row by row and then a few columns at a time.
#include "numerics/fft.hpp"

#include <algorithm>

#include "asperity/watch.hpp"

namespace asperity {

namespace {

/// Transforms of the columns of a grid of modes, in place, a few at a time: in one call for a large grid, which takes
/// seconds, no watch could be heeded.
void transform_columns(std::vector<std::complex<double>>& modes, Grid shape, Direction direction) {
  const std::size_t ny = shape[0], half = shape[1] / 2 + 1;
  const ColumnsTransform<double> along_columns(ny, direction);
  constexpr std::size_t together = ColumnsTransform<double>::width;
  const std::size_t length = along_columns.distance();
  const Scratch<std::complex<double>> in(length * together), out(length * together);
  std::fill_n(in.data(), length * together, std::complex<double>());
  for (std::size_t first = 0; first < half; first += together) {
    heed();
    const std::size_t columns = std::min(together, half - first);
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t k = 0; k < columns; ++k) in.data()[k * length + y] = modes[y * half + first + k];
    along_columns(in.data(), out.data());
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t k = 0; k < columns; ++k) modes[y * half + first + k] = out.data()[k * length + y];
  }
}

}  // namespace

std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape) {
  const auto [ny, nx] = shape;
  const std::size_t half = nx / 2 + 1;
  transform_columns(modes, shape, Direction::backward);
  std::vector<double> heights(ny * nx);
  const Scratch<std::complex<double>> in(half);
  const Scratch<double> out(nx);
  const RealTransform<double> along_row(nx, Direction::backward);
  for (std::size_t y = 0; y < ny; ++y) {
    heed();
    std::copy_n(modes.data() + y * half, half, in.data());
    along_row(in.data(), out.data());
    std::copy_n(out.data(), nx, heights.data() + y * nx);
  }
  return heights;
}

std::vector<std::complex<double>> forward_transform(const std::vector<double>& heights, Grid shape) {
  const auto [ny, nx] = shape;
  const std::size_t half = nx / 2 + 1;
  std::vector<std::complex<double>> modes(ny * half);
  const RealTransform<double> along_row(nx);
  const Scratch<double> in(nx);
  const Scratch<std::complex<double>> out(half);
  for (std::size_t y = 0; y < ny; ++y) {
    heed();
    std::copy_n(heights.data() + y * nx, nx, in.data());
    along_row(in.data(), out.data());
    std::copy_n(out.data(), half, modes.data() + y * half);
  }
  transform_columns(modes, shape, Direction::forward);
  return modes;
}

}  // namespace asperity
