// Lagrange's polynomials of Chebyshev's points in their barycentric form: J.-P. Berrut, L. N. Trefethen, SIAM Rev. 46,
// 501 (2004). With singularities pi / 2 off the real axis an interpolant through n points of a cell of length L misses
// some 2 r^-n, r = pi / L + sqrt(1 + (pi / L)^2): 4e-10 for L = 1 and n = 12.
#include "contact/grid/roughness_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/kernels.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

#define ASPERITY_LOOPS "contact/grid/cell_loops.inc"
#include "numerics/vector_units.inc"

/// As many as the loop takes for n nodes.
constexpr std::size_t padded(std::size_t n) {
  constexpr std::size_t taken = RoughnessCells::excess + 1;
  static_assert(taken == 2 * lanes);
  return (n + taken - 1) / taken * taken;
}

}  // namespace

RoughnessCells::RoughnessCells(std::size_t points, double longest, double lower, double upper,
                               std::span<const double> nodes)
    : points_(points) {
  std::vector<double> zeros(points);
  for (std::size_t k = 0; k < points; ++k)
    zeros[k] = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(points));
  const double start = std::log(lower), length = std::log(upper / lower);
  const auto cells = static_cast<std::size_t>(std::ceil(std::fmax(1, length / longest)));
  const double half = length / static_cast<double>(cells) / 2;
  std::size_t node = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double middle = start + half * (2 * static_cast<double>(cell) + 1);
    for (const double point : zeros) wavenumber_.push_back(std::clamp(std::exp(middle + half * point), lower, upper));
    const std::size_t first = node;
    while (node < nodes.size() && (cell + 1 == cells || std::log(nodes[node]) < middle + half)) ++node;
    end_.push_back(node);
    const std::size_t row = weight_.size(), n = padded(node - first);
    weight_.resize(row + points * n);
    for (std::size_t i = 0; i < node - first; ++i) {
      const double z = (std::log(nodes[first + i]) - middle) / half;
      double sum = 0;
      for (std::size_t k = 0; k < points; ++k) {
        const double sine = std::sqrt((1 - zeros[k]) * (1 + zeros[k])), apart = z - zeros[k];
        double& weight = weight_[row + k * n + i];
        weight = (k % 2 == 0 ? sine : -sine) / (std::fabs(apart) < 1e-14 ? 1e-14 : apart);
        sum += weight;
      }
      for (std::size_t k = 0; k < points; ++k) weight_[row + k * n + i] /= sum;
    }
  }
}

void RoughnessCells::at_nodes(const double* first, const double* second, double* first_at_nodes,
                              double* second_at_nodes) const {
#ifdef __x86_64__
  static const auto loop = vector_unit() == VectorUnit::baseline ? baseline::at_nodes_of_cell : avx2::at_nodes_of_cell;
#else
  constexpr auto loop = baseline::at_nodes_of_cell;
#endif
  const double* weight = weight_.data();
  std::size_t begin = 0;
  for (const std::size_t end : end_) {
    const std::size_t n = padded(end - begin);
    loop(weight, points_, n, first, second, first_at_nodes + begin, second_at_nodes + begin);
    weight += points_ * n;
    first += points_;
    second += points_;
    begin = end;
  }
}

}  // namespace asperity
