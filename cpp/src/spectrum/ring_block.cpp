// The matrices of a block of rings (ring_blocks.hpp), from its sums (ring_sums.hpp).
#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/ring_blocks.hpp"
#include "spectrum/ring_sums.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, degrees = BlockSums::degrees;

void measure_foot(const BlockSums& of, RingBlock& block) {
  const double m_upper = of.m_lower + of.m_part;
  for (std::size_t i = 0; i < of.m.size(); ++i) {
    const double share = (of.m_lower + of.m[i]) / m_upper;  // of u^2
    double small = 0.1;
    for (double& length : block.foot) {
      if (!(share < small)) break;
      length += of.root_of_weight[i] * of.root_of_weight[i];
      small *= 0.1;
    }
  }
}

/// The rows of a block by the degrees of p_j: u_i^2 p_j(u_i), and g_i p_j(u_i).
struct ByDegree {
  std::array<RowsOf24, degrees> to_g{}, to_slope{};

  void set(const NodeRule& of, const RootOfM& root, std::size_t first, RingBlock& block) {
    for (std::size_t i = 0; i < of.count; ++i) {
      const double u = root.at(of.x[i]);
      for (std::size_t j = 0; j < of.count; ++j) {
        to_g[j].data[first + i] = u * u * of.p[i][j];
        to_slope[j].data[first + i] = of.measure[i] * of.p[i][j];
      }
      block.measure[first + i] = of.measure[i];
      block.of_lower.data[first + i] = 0;
    }
  }
};

/// The columns of a cell.
void append_columns(const BlockSums::OfCell& cell, const ByDegree& rows, RingBlock& block) {
  const Kernels& loops = kernels();
  for (const CellPolynomials& of_node : legendre_of_nodes()) {
    double sums[2 * degrees];
    loops.combine(cell.by_degree.data(), nodes, of_node.data(), sums);
    RowsOf24& to_g = block.to_g.emplace_back();
    loops.combine(rows.to_g.data(), degrees, sums, to_g.data);
    for (std::size_t k = 0; k < nodes; ++k) to_g.data[RingBlock::end] += cell.to_m[k] * of_node[k];
    loops.combine(rows.to_slope.data(), degrees, sums + degrees, block.to_slope.emplace_back().data);
  }
}

}  // namespace

RingBlock block_of(const BlockSums& of, double last_cell, double width) {
  RingBlock block;
  block.lower = of.lower;
  block.upper = of.upper;
  block.m_lower = of.m_lower;
  block.m_part = of.m_part;
  block.first_cell = of.first_cell;
  if (of.m_part > 0) measure_foot(of, block);

  for (double& one : block.of_lower.data) one = 1;
  ByDegree by_degree;
  const RootOfM u = of.root();
  by_degree.set(of.rule, u, 0, block);
  by_degree.set(gauss(of.jacobi, RingBlock::coarse), u, RingBlock::fine, block);
  if (of.m_lower > 0) {
    double of_lower[RingBlock::rows];
    kernels().combine(by_degree.to_g.data(), degrees, of.over_m.data(), of_lower);
    for (std::size_t i = 0; i < RingBlock::end; ++i) block.of_lower.data[i] += of_lower[i];
  }
  block.to_g.reserve(nodes * of.cells.size());
  block.to_slope.reserve(nodes * of.cells.size());
  for (const BlockSums::OfCell& cell : of.cells) append_columns(cell, by_degree, block);
  CellPolynomials end;
  legendre_in_cell(2 * (of.upper - last_cell) / width - 1, end);
  RowsOf24* const columns = &block.to_slope[(of.cells.size() - 1) * nodes];
  for (std::size_t k = 0; k < nodes; ++k) {
    const CellPolynomials& of_node = legendre_of_nodes()[k];
    for (std::size_t j = 0; j < nodes; ++j) columns[k].data[RingBlock::end] += end[j] * of_node[j];
  }
  return block;
}

}  // namespace asperity
