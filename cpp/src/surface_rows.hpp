// Working through a map row by row in double precision, whatever its type and strides.
#pragma once

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "asperity/surface.hpp"

namespace asperity {

/// visit(y, row) for every row.
template <class Visit>
void for_each_row(const HeightMap& map, Visit visit) {
  std::vector<double> row(map.shape()[1]);
  for (std::size_t y = 0; y < map.shape()[0]; ++y) {
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

/// Least-squares polynomial through the measured points of a map.
class Trend {
 public:
  Trend(const HeightMap& map, Detrend order);
  void subtract(std::size_t y, std::span<double> row) const;

 private:
  HeightMap::Shape shape_;
  double anchor_;
  std::array<double, 6> coefficient_{};  // of 1, u, v, u^2, u v, v^2
};

}  // namespace asperity
