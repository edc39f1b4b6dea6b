// Functions of ln q that are smooth, at many nodes of a surface, from few points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// Polynomials in ln q on equal cells of a band, through values at Chebyshev's points of each, at nodes that rise.
/// Functions that are analytic within pi / 2 of the real axis in ln q are had to 1e-10 of their size in a cell with 12
/// points, to a thousandth with 4.
class RoughnessCells {
 public:
  RoughnessCells() = default;
  RoughnessCells(std::size_t points, double lower, double upper, std::span<const double> nodes);
  /// [1/m], as many points in each cell.
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  /// A function at the nodes, from its values at the wavenumbers.
  void at_nodes(std::span<const double> at_points, std::span<double> at_nodes) const;

 private:
  std::size_t points_ = 0;
  std::vector<double> wavenumber_;
  std::vector<std::size_t> end_;  // of each cell's nodes
  std::vector<double> weight_;    // of each point of a cell, at each of its nodes
};

}  // namespace asperity
