// Skewness and kurtosis of heights and the kurtosis of their curvature from one reading.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Sums of the first four powers of heights about a height near their mean, and of second differences over two points
/// along either axis: short waves that are gathered along one of them alone are faint along the other.
class HeightMoments {
 public:
  using Heights = Eigen::Ref<const Eigen::ArrayXd>;

  void add(const Heights& heights, double anchor) {
    const auto z = heights - anchor;
    first_ += z.sum();
    second_ += z.square().sum();
    third_ += z.cube().sum();
    fourth_ += z.square().square().sum();
    count_ += static_cast<double>(z.size());
    if (const Eigen::Index n = z.size() - 4; n > 0)
      curvature_[0].add(heights.head(n) - 2 * heights.segment(2, n) + heights.tail(n));
  }
  /// The same of rows that are two apart.
  void add_across(const Heights& before, const Heights& heights, const Heights& after) {
    curvature_[1].add(before - 2 * heights + after);
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
    template <class Values>
    void add(const Values& values) {
      second += values.square().sum();
      fourth += values.square().square().sum();
      count += static_cast<double>(values.size());
    }
  };
  std::array<Curvature, 2> curvature_;  // along x and along y
};

}  // namespace asperity
