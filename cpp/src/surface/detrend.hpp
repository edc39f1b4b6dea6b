// The least-squares offset, plane or quadratic surface of a map.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "asperity/surface.hpp"

namespace asperity {

class Trend {
 public:
  /// Through the measured points.
  Trend(const HeightMap& map, Detrend order, unsigned threads = 1);

  /// Row `y` without the trend; `row` and `result` may be the same.
  template <class T, class R>
  void subtract(std::size_t y, const T* row, R* result) const {
    const Line line = line_at(y);
    const double* const u = u_.data();
    for (std::size_t x = 0; x < u_.size(); ++x) result[x] = static_cast<R>(line.residual(u[x], row[x]));
  }
  /// The same times a weight a point, in the precision of the heights: the anchor is one of them, so that the first
  /// difference is as exact as they are.
  template <class T>
  void subtract_and_weigh(std::size_t y, const T* row, double weight, const T* weights, T* result) const {
    const Line line = line_at(y);
    const auto anchor = static_cast<T>(line.anchor), constant = static_cast<T>(line.constant),
               linear = static_cast<T>(line.linear), square = static_cast<T>(line.square);
    const T scale = static_cast<T>(weight);
    const T* const u = [this] {
      if constexpr (std::is_same_v<T, float>)
        return single_u_.data();
      else
        return u_.data();
    }();
    for (std::size_t x = 0; x < u_.size(); ++x)
      result[x] = ((row[x] - anchor) - (constant + u[x] * (linear + u[x] * square))) * (scale * weights[x]);
  }

 private:
  /// The surface along one row, in the coordinate u in [-1, 1].
  struct Line {
    double anchor, constant, linear, square;
    [[nodiscard]] double residual(double u, double z) const {
      return (z - anchor) - (constant + u * (linear + u * square));
    }
  };
  [[nodiscard]] Line line_at(std::size_t y) const;

  double anchor_;  // a height of the map: large offsets are taken out against it first
  std::vector<double> u_, v_;
  std::vector<float> single_u_;
  std::array<double, 6> coefficient_{};  // of 1, u, v, u^2, u v, v^2
};

}  // namespace asperity
