// Skewness and kurtosis of heights and the kurtosis of their curvature from one reading.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Sums of the first four powers of heights about a height near their mean, and of second differences over two points
/// along either axis: short waves that are gathered along one of them alone are faint along the other.
class HeightMoments {
 public:
  void add(std::span<const double> heights, double anchor) {
    double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
    for (const double height : heights) {
      const double z = height - anchor, square = z * z;
      s1 += z;
      s2 += square;
      s3 += square * z;
      s4 += square * square;
    }
    first_ += s1;
    second_ += s2;
    third_ += s3;
    fourth_ += s4;
    count_ += static_cast<double>(heights.size());
    for (std::size_t i = 4; i < heights.size(); ++i)
      curvature_[0].add(heights[i - 4] - 2 * heights[i - 2] + heights[i]);
  }
  /// The same of rows that are two apart.
  void add_across(std::span<const double> before, std::span<const double> heights, std::span<const double> after) {
    for (std::size_t i = 0; i < heights.size(); ++i) curvature_[1].add(before[i] - 2 * heights[i] + after[i]);
  }

  [[nodiscard]] double mean(double anchor) const { return anchor + first_ / count_; }
  [[nodiscard]] double rms() const { return std::sqrt(second_ / count_ - first_ / count_ * (first_ / count_)); }
  /// None where all heights are alike.
  [[nodiscard]] std::optional<HeightShape> shape() const {
    const double m = first_ / count_, raw2 = second_ / count_, raw3 = third_ / count_, raw4 = fourth_ / count_;
    const double m2 = raw2 - m * m, m3 = raw3 - 3 * m * raw2 + 2 * m * m * m,
                 m4 = raw4 - 4 * m * raw3 + 6 * m * m * raw2 - 3 * m * m * m * m;
    if (!(m2 > 1e-20 * raw2) || !std::isfinite(m4 / (m2 * m2))) return {};
    double most = 0;
    for (const Curvature& of : curvature_) {
      const double square = of.second * of.second;
      if (square > 0 && std::isfinite(square)) most = std::fmax(most, of.fourth * of.count / square);
    }
    HeightShape shape{m3 / (m2 * std::sqrt(m2)), m4 / (m2 * m2)};
    if (most > 0) shape.curvature_kurtosis = most;
    return shape;
  }

 private:
  double first_ = 0, second_ = 0, third_ = 0, fourth_ = 0, count_ = 0;
  struct Curvature {
    double second = 0, fourth = 0, count = 0;
    void add(double value) {
      const double square = value * value;
      second += square;
      fourth += square * square;
      count += 1;
    }
  };
  std::array<Curvature, 2> curvature_;  // along x and along y
};

}  // namespace asperity
