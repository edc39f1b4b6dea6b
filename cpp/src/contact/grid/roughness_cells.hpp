// Functions of ln q that are smooth, at many nodes of a surface, from few points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// Polynomials in ln q on equal cells of a band, through values at Chebyshev's points of each, at nodes that rise.
/// Functions that are analytic within pi / 2 of the real axis in ln q are had to 4e-10 of their size in a cell of
/// length 1 with 12 points.
class RoughnessCells {
 public:
  RoughnessCells() = default;
  RoughnessCells(std::size_t points, double longest, double lower, double upper, std::span<const double> nodes);
  /// [1/m], as many points in each cell.
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  /// Two functions at the nodes, from their values at the wavenumbers. What they are written to has room for
  /// `excess` more than there are nodes.
  static constexpr std::size_t excess = 7;
  void at_nodes(const double* first, const double* second, double* first_at_nodes, double* second_at_nodes) const;

 private:
  std::size_t points_ = 0;
  std::vector<double> wavenumber_;
  std::vector<std::size_t> end_;  // of each cell's nodes
  // of each point of a cell, at each of its nodes, as many as the loop takes: zeros follow
  std::vector<double> weight_;
};

}  // namespace asperity
