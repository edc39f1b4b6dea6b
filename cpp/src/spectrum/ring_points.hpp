// The points of a block of rings: a fine rule over its intervals.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/kernels.hpp"

namespace asperity {

/// Gauss-Legendre rules at as many points as are taken at a time, and the integrals of the polynomials through their
/// values up to each node: one rule on one piece, or two of half as many nodes on two pieces that follow each other.
struct PieceRule {
  static constexpr std::size_t points = 4;
  static_assert(points == lanes);
  double node[points], weight[points];
  double to_node[points][points];  // [value][node]
  double to_end[points];           // the polynomial through the values at the upper end
};

/// z, from -1 to 1 over the point's cell; dy and dm, the latter without the rule's weight; m from the lower end on, and
/// at the upper one; where the points of each cell end.
struct FineRule {
  std::vector<double> z, weight, rate, m;
  double m_part = 0;
  std::size_t first_cell = 0;
  std::vector<std::size_t> ends;
  std::vector<const PieceRule*> rules;  // of the points that are taken at a time

  [[nodiscard]] const PieceRule& rule(std::size_t point) const { return *rules[point / PieceRule::points]; }
  [[nodiscard]] std::size_t size() const { return z.size(); }
  [[nodiscard]] std::size_t begin(std::size_t cell) const { return cell == 0 ? 0 : ends[cell - 1]; }

  /// m at the last points taken, whose rates are known.
  void add_up();
};

}  // namespace asperity
