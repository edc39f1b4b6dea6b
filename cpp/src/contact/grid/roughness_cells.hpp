// Functions of ln q that are smooth, at nodes of a surface, from points of cells.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// Polynomials through values at the points of each cell, at nodes that rise.
class RoughnessCells {
 public:
  RoughnessCells() = default;
  /// On equal cells of a band in ln q, through Chebyshev's points of each. Functions that are analytic within pi / 2 of
  /// the real axis are had to 4e-10 of their size in a cell of length 1 with 12 points.
  RoughnessCells(std::size_t points, double longest, double lower, double upper, std::span<const double> nodes);
  /// Points and nodes of a cell from -1 to 1 follow those before; `barycentric` are the weights of the points.
  void add_cell(std::span<const double> points, std::span<const double> barycentric, std::span<const double> nodes);
  /// Of the equal cells [1/m].
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  /// Two functions at the nodes, from their values at the wavenumbers. What they are written to has room for
  /// `excess` more than there are nodes.
  static constexpr std::size_t excess = 7;
  void at_nodes(const double* first, const double* second, double* first_at_nodes, double* second_at_nodes) const;

 private:
  std::vector<double> wavenumber_;
  struct Cell {
    std::size_t points, nodes;
  };
  std::vector<Cell> cells_;
  // of each point of a cell, at each of its nodes, as many as the loop takes: zeros follow
  std::vector<double> weight_;
};

}  // namespace asperity
