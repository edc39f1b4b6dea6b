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

void RoughnessCells::add_cell(std::span<const double> points, std::span<const double> barycentric,
                              std::span<const double> nodes) {
  const std::size_t row = weight_.size(), n = padded(nodes.size());
  cells_.push_back({points.size(), nodes.size()});
  weight_.resize(row + points.size() * n);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      constexpr double least = 1e-14;
      const double apart = nodes[i] - points[k];
      double& weight = weight_[row + k * n + i];
      weight = barycentric[k] / (std::fabs(apart) < least ? least : apart);
      sum += weight;
    }
    for (std::size_t k = 0; k < points.size(); ++k) weight_[row + k * n + i] /= sum;
  }
}

RoughnessCells::RoughnessCells(std::size_t points, double longest, double lower, double upper,
                               std::span<const double> nodes) {
  std::vector<double> zeros(points), weights(points);
  for (std::size_t k = 0; k < points; ++k) {
    const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(points);
    zeros[k] = std::cos(angle);
    weights[k] = k % 2 == 0 ? std::sin(angle) : -std::sin(angle);
  }
  const double start = std::log(lower), length = std::log(upper / lower);
  const auto cells = static_cast<std::size_t>(std::ceil(std::fmax(1, length / longest)));
  const double half = length / static_cast<double>(cells) / 2;
  std::vector<double> place;
  std::size_t node = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double middle = start + half * (2 * static_cast<double>(cell) + 1);
    for (const double point : zeros) wavenumber_.push_back(std::clamp(std::exp(middle + half * point), lower, upper));
    place.clear();
    for (; node < nodes.size() && (cell + 1 == cells || std::log(nodes[node]) < middle + half); ++node)
      place.push_back((std::log(nodes[node]) - middle) / half);
    add_cell(zeros, weights, place);
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
  for (const auto& [points, nodes] : cells_) {
    const std::size_t n = padded(nodes);
    loop(weight, points, n, first, second, first_at_nodes, second_at_nodes);
    weight += points * n;
    first += points;
    second += points;
    first_at_nodes += nodes;
    second_at_nodes += nodes;
  }
}

}  // namespace asperity
