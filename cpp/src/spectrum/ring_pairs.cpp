// A grid whose cells are pairs of those of a finer one: polynomials over a cell are polynomials over its halves, so
// that all integrals and matrices (ring_blocks.hpp) are sums of the finer grid's. Rubbers with kinks often ask for
// both.
#include <algorithm>

#include "numerics/gauss_legendre.hpp"
#include "spectrum/ring_blocks.hpp"
#include "spectrum/ring_cells.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, pair = 2 * nodes;

/// Where the nodes of both halves of a cell are in it, -1 to 1.
double node_of_pair(std::size_t i) { return (legendre_rule(nodes).node[i % nodes] + (i < nodes ? -1 : 1)) / 2; }

/// L_k, the polynomials through values at the nodes of a cell, at the nodes of its halves.
const std::array<std::array<double, pair>, nodes>& values_at_pairs() {
  static const auto matrix = [] {
    std::array<std::array<double, pair>, nodes> made{};
    for (std::size_t i = 0; i < pair; ++i) {
      CellPolynomials p;
      legendre_in_cell(node_of_pair(i), p);
      for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t j = 0; j < nodes; ++j) made[k][i] += legendre_of_nodes()[k][j] * p[j];
    }
    return made;
  }();
  return matrix;
}

/// Legendre's polynomials of a cell by those of each of its halves.
const std::array<std::array<CellPolynomials, nodes>, 2>& legendre_by_halves() {
  static const auto matrices = [] {
    std::array<std::array<CellPolynomials, nodes>, 2> made{};
    for (std::size_t i = 0; i < pair; ++i) {
      CellPolynomials p;
      legendre_in_cell(node_of_pair(i), p);
      for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t j = 0; j < nodes; ++j) made[i / nodes][k][j] += p[k] * legendre_of_nodes()[i % nodes][j];
    }
    return made;
  }();
  return matrices;
}

void append_columns(const std::vector<RowsOf24>& fine, std::size_t first, std::size_t count, std::size_t of_pair,
                    std::vector<RowsOf24>& columns) {
  for (const auto& values : values_at_pairs())
    kernels().combine(&fine[first], count, values.data() + of_pair, columns.emplace_back().data);
}

RingBlock on_pairs(const RingBlock& fine) {
  RingBlock block = fine;
  block.first_cell = fine.first_cell / 2;
  block.to_g.clear();
  block.to_slope.clear();
  const std::size_t end = nodes * fine.first_cell + fine.to_g.size();  // of the finer group's points
  for (std::size_t at = nodes * fine.first_cell; at < end;) {
    const std::size_t next = std::min(end, (at / pair + 1) * pair), first = at - nodes * fine.first_cell;
    append_columns(fine.to_g, first, next - at, at % pair, block.to_g);
    append_columns(fine.to_slope, first, next - at, at % pair, block.to_slope);
    at = next;
  }
  return block;
}

}  // namespace

void RingSurface::take_moments(const Group& finer, Group& group) const {
  group.moments.resize(group.cells.size());
  for (std::size_t half = 0; half < finer.moments.size(); ++half) {
    const Moments& of_half = finer.moments[half];
    Moments& of = group.moments[half / 2];
    for (std::size_t k = 0; k < nodes; ++k) {
      const CellPolynomials& by = legendre_by_halves()[half % 2][k];
      for (std::size_t j = 0; j <= k; ++j) {
        of.of_m[k] += by[j] * of_half.of_m[j];
        of.of_u[k] += by[j] * of_half.of_u[j];
      }
    }
  }
}

const RingSurface::Group& RingSurface::finer(const Group& group) const {
  return finer_->groups()[static_cast<std::size_t>(&group - groups_.get())];
}

std::unique_ptr<RingTree> RingSurface::root_of_finer(const Group& group) const {
  auto mine = std::make_unique<RingTree>();
  mine->finer = &finer_->root(finer(group));
  mine->block = on_pairs(mine->finer->block);
  return mine;
}

std::unique_ptr<std::array<RingTree, 2>> RingSurface::halves_of_finer(const Group& group, const RingTree& tree) const {
  const std::array<RingTree, 2>& halves = finer_->halves(finer(group), *tree.finer);
  auto mine = std::make_unique<std::array<RingTree, 2>>();
  for (std::size_t i = 0; i < halves.size(); ++i) {
    (*mine)[i].finer = &halves[i];
    (*mine)[i].block = on_pairs(halves[i].block);
  }
  return mine;
}

}  // namespace asperity
