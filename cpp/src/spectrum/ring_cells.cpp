// Integrals of the polynomials of a cell over its rings: G over a cell, and the roughness that their errors meet.
#include "spectrum/ring_cells.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes;

}  // namespace

const std::array<CellPolynomials, nodes>& legendre_of_nodes() {
  static const std::array<CellPolynomials, nodes> matrix = [] {
    std::array<CellPolynomials, nodes> made{};
    const LegendreRule& rule = legendre_rule(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
      double last = 0, now = 1;
      for (std::size_t j = 0; j < nodes; ++j) {
        const auto d = static_cast<double>(j);
        made[k][j] = (d + 0.5) * rule.weight[k] * now;
        const double next = ((2 * d + 1) * rule.node[k] * now - d * last) / (d + 1);
        last = now;
        now = next;
      }
    }
    return made;
  }();
  return matrix;
}

void legendre_in_cell(double z, CellPolynomials& p) {
  p[0] = 1;
  p[1] = z;
  for (std::size_t j = 1; j + 1 < nodes; ++j) {
    const auto d = static_cast<double>(j);
    p[j + 1] = ((2 * d + 1) * z * p[j] - d * p[j - 1]) / (d + 1);
  }
}

namespace {

RingSurface::Moments moments(const FineRule& fine, std::size_t cell, double m_lower) {
  constexpr std::size_t chunk = 64;
  RingSurface::Moments result;
  for (std::size_t from = fine.begin(cell); from < fine.ends[cell]; from += chunk) {
    const std::size_t n = std::min(chunk, fine.ends[cell] - from);
    const double* const z = &fine.z[from];
    double p[nodes][chunk], dm[chunk], du[chunk];
    for (std::size_t i = 0; i < n; ++i) {
      p[0][i] = 1;
      p[1][i] = z[i];
      dm[i] = fine.rule(from + i).weight[i % PieceRule::points] * fine.rate[from + i];
      du[i] = dm[i] > 0 ? dm[i] / std::sqrt(m_lower + std::fmax(fine.m[from + i], 0)) : 0;
    }
    for (std::size_t k = 1; k + 1 < nodes; ++k) {
      const auto d = static_cast<double>(k);
      const double a = (2 * d + 1) / (d + 1), b = d / (d + 1);
      for (std::size_t i = 0; i < n; ++i) p[k + 1][i] = a * z[i] * p[k][i] - b * p[k - 1][i];
    }
    kernels().dots(p[0], chunk, nodes, n, dm, du, result.of_m.data(), result.of_u.data());
  }
  return result;
}

/// The root of the mean square of the integrals of high degree, in units of the first.
double roughness(const CellPolynomials& moment) {
  constexpr std::size_t high = nodes / 2;
  double squares = 0;
  for (std::size_t k = high; k < nodes; ++k) squares += moment[k] * moment[k];
  return moment[0] > 0 ? std::sqrt(squares / (nodes - high)) / moment[0] : 0;
}

}  // namespace

void RingSurface::take_moments(Group& group) const {
  const FineRule fine = points_of(group, group.lower, group.upper, group.m_lower);
  for (std::size_t cell = 0; cell < group.cells.size(); ++cell)
    group.moments.push_back(moments(fine, cell, group.m_lower));
}

double RingSurface::measure_cells(Group& group) {
  double m = 0;
  for (std::size_t cell = 0; cell < group.cells.size(); ++cell) {
    const Moments& of = group.moments[cell];
    group.cells[cell] = {of.of_m[0], roughness(of.of_m), roughness(of.of_u)};
    m += of.of_m[0];
    for (const CellPolynomials& of_node : legendre_of_nodes()) {
      double sum = 0;
      for (std::size_t k = 0; k < nodes; ++k) sum += of.of_m[k] * of_node[k];
      group.to_g.push_back(sum);
    }
  }
  return m;
}

}  // namespace asperity
