// The points of a block of rings: a fine rule over its intervals.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/kernels.hpp"

namespace asperity {

/// The Gauss-Legendre rule of a piece, and the integrals of the polynomial through its values up to each node.
struct PieceRule {
  static constexpr std::size_t points = 4;
  static_assert(points == lanes);
  double node[points], weight[points];
  double to_node[points][points];  // [value][node]
  double to_end[points];           // the polynomial through the values at the upper end
};

const PieceRule& piece_rule();

/// z, from -1 to 1 over the point's cell; dy and dm, the latter without the rule's weight; m from the lower end on, and
/// at the upper one; where the points of each cell end.
struct FineRule {
  std::vector<double> z, weight, rate, m;
  double m_part = 0;
  std::size_t first_cell = 0;
  std::vector<std::size_t> ends;

  [[nodiscard]] std::size_t size() const { return z.size(); }
  [[nodiscard]] std::size_t begin(std::size_t cell) const { return cell == 0 ? 0 : ends[cell - 1]; }

  /// m at the points of a piece, whose rates are known.
  void add_up(std::size_t first);
};

}  // namespace asperity
