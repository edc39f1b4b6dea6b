// How the roughness of each node is shared by the rows of the spectrum.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contact/grid/grid.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// Between two rows ln C changes linearly with theirs, as a table has it; beside a row of zero C does.
class RoughnessRows {
 public:
  /// `wavenumber` are the rows, at which panels of the grid end, or those of the table that its pieces are of.
  RoughnessRows(std::span<const Segment> surface, bool of_table, const ContactGrid& grid,
                std::vector<double> wavenumber);
  [[nodiscard]] const std::vector<double>& wavenumber() const { return rows_; }
  /// From slopes of a number over ln C at all nodes to those over ln C of the rows.
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& by_node) const;

 private:
  /// The slopes of ln C at q over those of the row at or below it and of the next.
  struct Shares {
    std::size_t row;
    double lower, upper;
  };
  [[nodiscard]] Shares shares_at(double wavenumber) const;
  void add_stretch(const ContactGrid& grid, const ContactGrid::Stretch& stretch);

  std::span<const Segment> surface_;
  bool of_table_;
  std::vector<double> rows_;
  std::vector<std::size_t> first_;  // of each node among the entries
  std::vector<Eigen::Index> row_;
  std::vector<double> share_;
};

}  // namespace asperity
