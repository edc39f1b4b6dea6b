// Working through a map row by row in double precision, whatever its type and strides.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "asperity/surface.hpp"
#include "asperity/watch.hpp"

namespace asperity {

/// visit(y, row) for every row.
template <class Visit>
void for_each_row(const HeightMap& map, Visit visit) {
  std::vector<double> row(map.shape()[1]);
  for (std::size_t y = 0; y < map.shape()[0]; ++y) {
    heed();
    map.read_row(y, row.data());
    visit(y, std::span<const double>(row));
  }
}

/// A new map of the same type whose rows are what change(y, row) made of the old ones.
template <class Change>
HeightMap map_rows(const HeightMap& map, Change change) {
  return std::visit(
      [&](const auto* data) {
        using T = std::remove_cvref_t<decltype(*data)>;
        const auto [ny, nx] = map.shape();
        std::vector<T> heights(ny * nx);
        std::vector<double> row(nx);
        for (std::size_t y = 0; y < ny; ++y) {
          heed();
          map.read_row(y, row.data());
          change(y, std::span<double>(row));
          for (std::size_t x = 0; x < nx; ++x) heights[y * nx + x] = static_cast<T>(row[x]);
        }
        return HeightMap(std::move(heights), map.shape(), map.pixel_size());
      },
      map.data());
}

/// The first measured height: what large offsets are taken out against.
double first_height(const HeightMap& map);

/// Rows of a map of known type, in place where they are contiguous, else gathered.
template <class T>
class RowReader {
 public:
  explicit RowReader(const HeightMap& map)
      : data_(std::get<const T*>(map.data())),
        strides_(map.strides()),
        columns_(map.shape()[1]),
        gathered_(strides_[1] == 1 ? 0 : map.shape()[1]) {}
  void fetch(std::size_t y) const {
    const T* const row = data_ + static_cast<std::ptrdiff_t>(y) * strides_[0];
    for (std::size_t x = 0; x < columns_ && gathered_.empty(); x += 64 / sizeof(T)) __builtin_prefetch(row + x, 0, 2);
  }
  const T* operator()(std::size_t y) {
    const T* const row = data_ + static_cast<std::ptrdiff_t>(y) * strides_[0];
    if (gathered_.empty()) return row;
    for (std::size_t x = 0; x < gathered_.size(); ++x) gathered_[x] = row[static_cast<std::ptrdiff_t>(x) * strides_[1]];
    return gathered_.data();
  }

 private:
  const T* data_;
  HeightMap::Strides strides_;
  std::size_t columns_;
  std::vector<T> gathered_;
};

}  // namespace asperity
