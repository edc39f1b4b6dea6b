// The sums over the points of a block of rings that its matrices (ring_blocks.hpp) are made of.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "numerics/kernels.hpp"
#include "spectrum/ring_blocks.hpp"
#include "spectrum/ring_cells.hpp"
#include "spectrum/ring_gauss.hpp"

namespace asperity {

/// u = sqrt(m) over a block, from its lower end on.
struct RootOfM {
  double m_lower, lower, whole;

  RootOfM(double m_at_lower, double m_part)
      : m_lower(m_at_lower),
        lower(std::sqrt(m_at_lower)),
        whole(m_part / (std::sqrt(m_at_lower + m_part) + std::sqrt(m_at_lower))) {}

  /// u at m beyond that of the lower end, as -1 to 1 over the block, and u from there.
  [[nodiscard]] double scaled(double part) const {
    return part > 0 ? 2 * (part / (std::sqrt(m_lower + part) + lower)) / whole - 1 : -1;
  }
  [[nodiscard]] double at(double x) const { return lower + whole * (x + 1) / 2; }
};

struct BlockSums {
  static constexpr std::size_t degrees = Jacobi::most;
  static_assert(degrees == RingBlock::fine && 2 * degrees == RingBlock::rows);
  using ByPolynomial = std::array<double, degrees>;

  /// On a cell, P_k Legendre's: int p_j / m int c P_k and after them int p_j dP_k / dy; int c P_k.
  struct OfCell {
    std::array<RowsOf24, RingBlock::nodes> by_degree{};
    CellPolynomials to_m{};
  };

  double lower = 0, upper = 0, m_lower = 0, m_part = 0;  // as of the block
  std::size_t first_cell = 0;
  Jacobi jacobi;
  NodeRule rule{};  // of as many nodes as there are degrees
  std::vector<OfCell> cells;
  ByPolynomial over_m{};                  // int p_j / m
  std::vector<double> m, root_of_weight;  // of the points: m from the lower end on, and the root of dy

  [[nodiscard]] RootOfM root() const { return {m_lower, m_part}; }
};

/// The sums over the points of a rule from `lower` to `upper`, on cells that are `width` long.
BlockSums sums_of(FineRule&& fine, double lower, double upper, double m_lower, double width);

/// Those of two blocks that follow each other, on both of which u grows, as of one block: its p_j are polynomials in u
/// on each of them, so that nothing is looked up at points again.
BlockSums joined(const BlockSums& first, const BlockSums& second);

/// The block of the sums, whose last cell begins at `last_cell`.
RingBlock block_of(const BlockSums& of, double last_cell, double width);

}  // namespace asperity
