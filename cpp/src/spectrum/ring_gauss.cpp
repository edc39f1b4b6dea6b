// Orthonormal polynomials by the Lanczos recurrence, and their Gauss rules from the eigenvectors of the Jacobi matrix
// (G. H. Golub and J. H. Welsch, Math. Comp. 23, 221 (1969);
// G. H. Golub and C. F. Van Loan, Matrix Computations (1996), section 8.3).
#include "spectrum/ring_gauss.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

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

namespace {

/// Eigenvalues of a symmetric tridiagonal matrix, and its eigenvectors one after the other.
struct Axes {
  double value[Jacobi::most], vector[Jacobi::most][Jacobi::most];
};

/// The turn that takes (a, b) to (length, 0).
struct Turn {
  double cosine, sine, length;
  Turn(double a, double b) : cosine(1), sine(0), length(std::sqrt(a * a + b * b)) {
    if (length == 0) return;
    cosine = a / length;
    sine = b / length;
  }
};

/// By implicit QR steps from the top with Wilkinson's shift, which split off an eigenvalue at the bottom: each turn
/// pushes the one element beside the three diagonals a row further down.
Axes axes_of(const Jacobi& jacobi, std::size_t n) {
  constexpr double rounding = 1e-16;
  Axes axes{};
  double* const d = axes.value;
  double e[Jacobi::most] = {};
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = jacobi.diagonal[i];
    if (i + 1 < n) e[i] = jacobi.beside[i];
    axes.vector[i][i] = 1;
  }
  const auto split = [&](std::size_t i) {
    return std::fabs(e[i]) <= rounding * (std::fabs(d[i]) + std::fabs(d[i + 1]));
  };
  std::size_t last = n - 1;
  for (std::size_t step = 0; last > 0 && step < 30 * n;) {
    if (split(last - 1)) {
      --last;
      continue;
    }
    ++step;
    std::size_t first = last - 1;
    while (first > 0 && !split(first - 1)) --first;
    const double half = (d[last - 1] - d[last]) / 2, beside = e[last - 1];
    const double shift =
        d[last] - beside * beside / (half + std::copysign(std::sqrt(half * half + beside * beside), half));
    double ahead = d[first] - shift, bulge = e[first];
    for (std::size_t i = first; i < last; ++i) {
      const Turn turn(ahead, bulge);
      const double c = turn.cosine, s = turn.sine;
      if (i > first) e[i - 1] = turn.length;
      const double top = d[i], bottom = d[i + 1], between = e[i];
      const double mixed = 2 * c * s * between;
      d[i] = c * c * top + s * s * bottom + mixed;
      d[i + 1] = s * s * top + c * c * bottom - mixed;
      e[i] = c * s * (bottom - top) + (c * c - s * s) * between;
      ahead = e[i];
      if (i + 1 < last) {
        bulge = s * e[i + 1];
        e[i + 1] *= c;
      }
      double *const a = axes.vector[i], *const b = axes.vector[i + 1];
      for (std::size_t k = 0; k < Jacobi::most; ++k) {
        const double a_k = a[k], b_k = b[k];
        a[k] = c * a_k + s * b_k;
        b[k] = c * b_k - s * a_k;
      }
    }
  }
  return axes;
}

}  // namespace

NodeRule gauss(const Jacobi& jacobi, std::size_t wanted) {
  NodeRule result{};
  const std::size_t n = result.count = std::min(wanted, jacobi.degrees);
  if (n == 0) return result;
  const Axes axes = axes_of(jacobi, n);
  std::array<std::size_t, Jacobi::most> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), {},
                    [&](std::size_t i) { return axes.value[i]; });
  const double root = std::sqrt(jacobi.measure);
  for (std::size_t i = 0; i < n; ++i) {
    const double* const vector = axes.vector[order[i]];
    const double first = vector[0];  // that of p_0
    result.x[i] = axes.value[order[i]];
    if (first == 0) continue;  // a node without weight
    result.measure[i] = jacobi.measure * first * first;
    for (std::size_t j = 0; j < n; ++j) result.p[i][j] = vector[j] / first / root;
  }
  return result;
}

}  // namespace asperity
