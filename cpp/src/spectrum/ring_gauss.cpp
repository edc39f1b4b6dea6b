// Orthonormal polynomials by the Lanczos recurrence, and their Gauss rules from the eigenvectors of the Jacobi matrix
// (G. H. Golub and J. H. Welsch, Math. Comp. 23, 221 (1969)).
#include "spectrum/ring_gauss.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/symmetric_matrix.hpp"

namespace asperity {

namespace {

double dot(std::size_t n, const double* a, const double* b) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

// Where x takes few values nearly, and the recurrence forgets what it is orthogonal to, it is told.
Jacobi orthonormal(const std::vector<double>& weight, const std::vector<double>& x, std::vector<double>& rows) {
  Jacobi result;
  const std::size_t n = x.size();
  for (const double w : weight) result.measure += w;
  const double size = 1 / std::sqrt(result.measure);
  for (std::size_t i = 0; i < n; ++i) rows[i] = std::sqrt(weight[i]) * size;
  std::vector<double> product(n);
  bool few_values = false;
  for (std::size_t j = 0; j < Jacobi::most; ++j) {
    result.degrees = j + 1;
    const double* const now = &rows[j * n];
    for (std::size_t i = 0; i < n; ++i) product[i] = x[i] * now[i];
    const double diagonal = result.diagonal[j] = dot(n, product.data(), now);
    if (j + 1 == Jacobi::most) break;
    double* const next = &rows[(j + 1) * n];
    const double* const last = j > 0 ? now - n : now;
    const double beside = j > 0 ? result.beside[j - 1] : 0;
    for (std::size_t i = 0; i < n; ++i) next[i] = product[i] - diagonal * now[i] - beside * last[i];
    double square = dot(n, next, next);
    constexpr double small = 1e-2, least = 1e-9;
    few_values |= !(square > small * small);
    if (few_values) {
      for (std::size_t k = 0; k <= j; ++k) {
        const double along = dot(n, next, &rows[k * n]);
        for (std::size_t i = 0; i < n; ++i) next[i] -= along * rows[k * n + i];
      }
      square = dot(n, next, next);
    }
    if (!(square > least * least)) break;
    result.beside[j] = std::sqrt(square);
    const double scale = 1 / result.beside[j];
    for (std::size_t i = 0; i < n; ++i) next[i] *= scale;
  }
  return result;
}

NodeRule gauss(const Jacobi& jacobi, std::size_t wanted) {
  NodeRule result{};
  const std::size_t n = result.count = std::min(wanted, jacobi.degrees);
  if (n == 0) return result;
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(index(n), index(n));
  for (std::size_t i = 0; i < n; ++i) {
    matrix(index(i), index(i)) = jacobi.diagonal[i];
    if (i + 1 < n) matrix(index(i), index(i + 1)) = matrix(index(i + 1), index(i)) = jacobi.beside[i];
  }
  const PrincipalAxes axes = principal_axes(matrix);
  const double root = std::sqrt(jacobi.measure);
  for (std::size_t i = 0; i < n; ++i) {
    const double first = axes.vectors(0, index(i));  // that of p_0
    result.x[i] = axes.values(index(i));
    if (first == 0) continue;  // a node without weight
    result.measure[i] = jacobi.measure * first * first;
    for (std::size_t j = 0; j < n; ++j) result.p[i][j] = axes.vectors(index(j), index(i)) / first / root;
  }
  return result;
}

}  // namespace asperity
