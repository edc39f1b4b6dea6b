// The grid of a contact with heat, and where its temperature is an unknown.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "contact/grid/grid.hpp"

namespace asperity {

/// The temperature is an unknown at Chebyshev's points in ln q, both ends of the grid among them, as it is analytic
/// within pi of the real axis.
class HeatGrid : public ContactGrid {
 public:
  /// Of a level, up to those of a double.
  static constexpr int digits(std::size_t level) { return std::min(first_digits + 2 * static_cast<int>(level), 16); }
  /// `also_felt`: a temperature point that may lie outside of the band [1/m].
  HeatGrid(std::span<const Segment> surface, const ContactGridOptions& options, const std::optional<double>& also_felt);

  /// Points of the temperature [1/m]; the last is the upper end.
  [[nodiscard]] const std::vector<double>& temperature_points() const { return points_; }
  /// From values at those points to values at the nodes.
  [[nodiscard]] const Eigen::MatrixXd& to_nodes() const { return to_nodes_; }
  /// The row that takes values at the points to that at a wavenumber.
  [[nodiscard]] Eigen::RowVectorXd row_at(double wavenumber) const;
  /// Whether the first of the points is beside the band.
  [[nodiscard]] bool lone_point() const { return first_point_ == 1; }
  /// The row of `also_felt`.
  [[nodiscard]] const Eigen::RowVectorXd& also_felt() const { return also_felt_; }

 private:
  std::size_t first_point_ = 0;
  std::vector<double> points_, log_points_;
  Eigen::MatrixXd to_nodes_;
  Eigen::RowVectorXd also_felt_;
};

}  // namespace asperity
