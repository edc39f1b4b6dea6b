// How the roughness of each node is shared by the rows of the spectrum.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contact/grid/directions.hpp"
#include "contact/grid/grid.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// Between two rows ln C changes linearly with theirs, as a table has it; beside a row of zero C does.
class RoughnessRows {
 public:
  /// `wavenumber` are the rows, those of the table that pieces of the grid are of.
  /// Pieces take rings together: with `directions` the slope over a row is at its own first `harmonics`.
  RoughnessRows(std::span<const Segment> surface, bool of_table, const ContactGrid& grid,
                std::vector<double> wavenumber, const Directions* directions = nullptr, std::size_t harmonics = 0);
  [[nodiscard]] const std::vector<double>& wavenumber() const { return rows_; }
  /// From slopes of a number over ln C at all nodes, and over the harmonics there, a column each, to those over ln C of
  /// the rows.
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& by_node, const Eigen::MatrixXd& by_rings) const;

 private:
  /// The slopes of ln C at q over those of the row at or below it and of the next.
  struct Shares {
    std::size_t row;
    double lower, upper;
  };
  [[nodiscard]] Shares shares_at(double wavenumber, double log_q) const;
  /// `origin` is that of a panel's cell.
  void add_stretch(const ContactGrid& grid, const ContactGrid::Stretch& stretch,
                   const ContactGrid::Cell* panel = nullptr);

  std::span<const Segment> surface_;
  bool of_table_;
  std::vector<double> rows_, log_rows_;
  std::vector<std::size_t> first_;  // of each node among the entries
  std::vector<Eigen::Index> row_;
  std::vector<double> share_;
  const Directions* directions_;
  std::size_t harmonics_;
  std::vector<double> rings_;  // of each entry, its harmonics less those of the node, times the share
};

}  // namespace asperity
