// Polynomials through values at the nodes of a cell (ring_blocks.hpp), by Legendre's.
#pragma once

#include <array>

#include "spectrum/ring_blocks.hpp"

namespace asperity {

/// P_0, P_1 ... or what belongs to each.
using CellPolynomials = std::array<double, RingBlock::nodes>;

/// From values at the nodes of a cell to coefficients: those that a value adds to, by node.
const std::array<CellPolynomials, RingBlock::nodes>& legendre_of_nodes();

/// The polynomials at z, -1 to 1 over the cell.
void legendre_in_cell(double z, CellPolynomials& p);

}  // namespace asperity
