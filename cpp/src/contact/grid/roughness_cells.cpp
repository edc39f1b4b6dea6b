// Lagrange's polynomials of Chebyshev's points in their barycentric form: J.-P. Berrut, L. N. Trefethen, SIAM Rev. 46,
// 501 (2004). With singularities pi / 2 off the real axis an interpolant through n points of a cell of length L misses
// some 2 r^-n, r = pi / L + sqrt(1 + (pi / L)^2): 1e-10 for L = 0.8 and n = 12.
#include "contact/grid/roughness_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

RoughnessCells::RoughnessCells(std::size_t points, double lower, double upper, std::span<const double> nodes)
    : points_(points) {
  constexpr double longest = 0.8;
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
    const std::size_t row = weight_.size(), n = node - first;
    weight_.resize(row + points * n);
    for (std::size_t i = 0; i < n; ++i) {
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

void RoughnessCells::at_nodes(std::span<const double> at_points, std::span<double> at_nodes) const {
  const double *weight = weight_.data(), *value = at_points.data();
  std::size_t begin = 0;
  for (const std::size_t end : end_) {
    const std::size_t n = end - begin;
    double* const sum = at_nodes.data() + begin;
    std::fill_n(sum, n, 0.0);
    for (std::size_t k = 0; k < points_; ++k, weight += n, ++value)
      for (std::size_t i = 0; i < n; ++i) sum[i] += weight[i] * *value;
    begin = end;
  }
}

}  // namespace asperity
