// The Fourier modes of a map, column by column, from which every two-dimensional spectrum is summed.
#pragma once

#include <algorithm>
#include <complex>
#include <cstring>
#include <type_traits>
#include <variant>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/fft.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/simd.hpp"
#include "spectrum/window.hpp"
#include "surface/rows.hpp"

namespace asperity {

/// take(part, k_x, column) for k_x = 0 .. nx / 2, where column holds the ny modes sum w h exp(-i (..)) of that k_x; the
/// other half plane is its mirror image. Parts run in threads of their own.
///
/// Rows, then columns, a few at a time: what is read once from memory is detrended, weighed and transformed while it is
/// in the cache, and a column is taken before it leaves it. The half plane of modes between the two is all the memory
/// that is used.
template <class T, class Take>
void for_each_column(const HeightMap& map, const Preparation& prepared, unsigned threads, Take take) {
  const auto [ny, nx] = map.shape();
  const std::size_t half = nx / 2 + 1;
  // an odd number of cache lines a row: columns of a power of two would all fall into the same few cache sets
  const std::size_t pitch = Scratch<std::complex<T>>::aligned(half) + ((half / 8) % 2 == 1 ? 8 : 0);
  const Scratch<std::complex<T>> plane(ny * pitch);

  const bool past_cache = ny * pitch * sizeof(std::complex<T>) > std::size_t{12} << 20;
  const std::vector<T> wx(prepared.wx.begin(), prepared.wx.end());
  const RealTransform<T> along_rows(nx);
  constexpr std::size_t rows = RealTransform<T>::together;
  const std::size_t length_of_row = Scratch<T>::aligned(nx) + (rows > 1 ? 8 : 0);
  in_parts(threads, (ny + rows - 1) / rows, [&](unsigned, std::size_t begin, std::size_t end) {
    const Scratch<T> row(length_of_row * rows);
    std::fill_n(row.data(), length_of_row * rows, T());  // those beyond the last one are transformed too
    const Scratch<std::complex<T>> modes(pitch * rows);
    RowReader<T> read(map);
    const std::size_t last = std::min(end * rows, ny);
    for (std::size_t first = begin * rows; first < last; first += rows) {
      const std::size_t behind = std::min(first + rows, last);
      for (std::size_t y = first; y < behind; ++y) {
        heed();
        const T* const heights = read(y);
        const T wy = static_cast<T>(prepared.wy[y]);
        T* const weighed = row.data() + (y - first) * length_of_row;
        if (prepared.trend)
          prepared.trend->subtract_and_weigh(y, heights, wy, wx.data(), weighed);
        else
          for (std::size_t x = 0; x < nx; ++x) weighed[x] = heights[x] * (wy * wx[x]);
        if (y + 1 < last) read.fetch(y + 1);  // on its way from memory while this one is transformed
      }
      const bool apart = past_cache || behind < first + rows;
      std::complex<T>* const to = plane.data() + first * pitch;
      std::complex<T>* const at = apart ? modes.data() : to;
      along_rows(row.data(), length_of_row, at, pitch);
      for (std::size_t y = 0; y < behind - first; ++y)
        std::fill(at + y * pitch + half, at + (y + 1) * pitch, std::complex<T>());
      if (apart) store_past_cache(at, (behind - first) * pitch * sizeof *at, to);
    }
  });

  constexpr std::size_t together = ColumnsTransform<T>::width;
  constexpr std::size_t ahead = 32;  // rows that are fetched before they are needed
  const std::size_t blocks = (half + together - 1) / together;
  const ColumnsTransform<T> along_columns(ny);
  const std::size_t length = along_columns.distance();
  in_parts(threads, blocks, [&](unsigned part, std::size_t begin, std::size_t end) {
    const Scratch<std::complex<T>> in(length * together), out(length * together);
    std::fill_n(in.data(), length * together, std::complex<T>());
    for (std::size_t block = begin; block < end; ++block) {
      heed();
      const std::size_t first = block * together, columns = std::min(together, half - first);
      const std::complex<T>* from = plane.data() + first;
      for (std::size_t y = 0; y < ny; ++y, from += pitch) {
        __builtin_prefetch(from + (y + ahead < ny ? ahead * pitch : 0));
        for (std::size_t k = 0; k < together; ++k)  // as one piece each
          std::memcpy(in.data() + k * length + y, from + k, sizeof *from);
      }
      along_columns(in.data(), out.data());
      for (std::size_t k = 0; k < columns; ++k) take(part, first + k, out.data() + k * length);
    }
  });
}

/// The same for heights of either type: take(part, k_x, column) with columns of complex floats or doubles.
template <class Take>
void for_each_mode_column(const HeightMap& map, const Preparation& prepared, unsigned threads, Take take) {
  std::visit(
      [&](const auto* data) {
        using T = std::remove_cvref_t<decltype(*data)>;
        for_each_column<T>(map, prepared, threads, take);
      },
      map.data());
}

}  // namespace asperity
