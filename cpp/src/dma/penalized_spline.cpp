// Cubic B-splines with a penalty on third differences (P. H. C. Eilers and B. D. Marx, Statist. Sci. 11, 89 (1996)):
// A c = B^T y, A = B^T B + sum_j lambda_j d_j d_j^T, d = (-1, 3, -3, 1). Both sums couple four neighbours, so that the
// factor A = L D L^T, its determinant and the part of the inverse that gradients ask for take a time linear in the
// knots.
#include <algorithm>
#include <cmath>

#include "dma/shift_likelihood.hpp"

namespace asperity {

namespace {

constexpr std::array<double, 4> third_difference{-1, 3, -3, 1};

std::array<double, 4> basis_slope(double t) {
  const double s = 1 - t;
  return {-s * s / 2, t * (1.5 * t - 2), s * (2 - 1.5 * s), t * t / 2};
}

}  // namespace

void SplineBasis::place(std::span<const double> x) {
  const auto [least, most] = std::ranges::minmax(x);
  const double lowest = std::floor(least / spacing);
  lower = lowest * spacing;
  coefficients = static_cast<std::size_t>(std::floor(most / spacing) - lowest) + 4;
  first.resize(x.size());
  value.resize(x.size());
  slope.resize(x.size());
  gram.assign(coefficients, {});
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double at = x[i] / spacing, interval = std::floor(at);
    first[i] = static_cast<std::size_t>(interval - lowest);
    const std::array<double, 4> b = value[i] = cubic_basis(at - interval);
    slope[i] = basis_slope(at - interval);
    for (double& s : slope[i]) s /= spacing;
    std::array<double, 4>* row = &gram[first[i]];
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k <= j; ++k) row[j][k] += b[j] * b[j - k];
  }
}

void PenalizedSpline::factor(const SplineBasis& basis, std::span<const double> log_penalty) {
  const std::size_t p = basis.coefficients;
  band_.assign(basis.gram.begin(), basis.gram.end());
  penalty_.resize(log_penalty.size());
  double logarithms = 0;
  for (std::size_t j = 0; j < log_penalty.size(); ++j) {
    const bool same = j > 0 && log_penalty[j] == log_penalty[j - 1];
    penalty_[j] = same ? penalty_[j - 1] : std::exp(log_penalty[j]);
    logarithms += log_penalty[j];
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        band_[j + i][k] += penalty_[j] * (third_difference[i] * third_difference[i - k]);
  }
  lower_.resize(p + 3);  // three rows of zeros behind the last
  std::fill(lower_.end() - 3, lower_.end(), Row{});
  inverse_pivot_.resize(p);
  double product = 1, sum = 0;
  Row before{}, second{};          // rows j - 1, j - 2 of L
  std::array<double, 4> pivots{};  // 1 / pivot of rows j - 1, j - 2, j - 3; none before the first
  for (std::size_t j = 0; j < p; ++j) {
    const Row& a = band_[j];
    const double u3 = a[3], u2 = a[2] - u3 * second[1], u1 = a[1] - u3 * before[2] - u2 * before[1];
    const Row l{0, u1 * pivots[1], u2 * pivots[2], u3 * pivots[3]};
    const double pivot = a[0] - u3 * l[3] - u2 * l[2] - u1 * l[1];
    inverse_pivot_[j] = 1 / pivot;
    lower_[j] = l;
    product *= pivot;
    if (j % 8 == 7) {  // before it may overflow
      sum += std::log(product);
      product = 1;
    }
    pivots = {0, inverse_pivot_[j], pivots[1], pivots[2]};
    second = before;
    before = l;
  }
  log_determinant_ = sum + std::log(product) - logarithms;
}

void PenalizedSpline::solve(const SplineBasis& basis, std::span<const double> y) {
  const std::size_t p = basis.coefficients;
  coefficients_.assign(p + 3, 0.0);
  double* c = coefficients_.data();
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t j = 0; j < 4; ++j) c[basis.first[i] + j] += basis.value[i][j] * y[i];
  double c1 = 0, c2 = 0, c3 = 0;  // rows j - 1, j - 2, j - 3, then j + 1, j + 2, j + 3
  for (std::size_t j = 0; j < p; ++j) {
    const Row& l = lower_[j];
    c[j] = c[j] - l[3] * c3 - l[2] * c2 - l[1] * c1;
    c3 = c2;
    c2 = c1;
    c1 = c[j];
  }
  c1 = c2 = c3 = 0;
  for (std::size_t j = p; j-- > 0;) {
    c[j] = c[j] * inverse_pivot_[j] - lower_[j + 3][3] * c3 - lower_[j + 2][2] * c2 - lower_[j + 1][1] * c1;
    c3 = c2;
    c2 = c1;
    c1 = c[j];
  }
  coefficients_.resize(p);
  left_.resize(y.size());
  residual_ = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Row& b = basis.value[i];
    const double* of = c + basis.first[i];
    left_[i] = y[i] - (b[0] * of[0] + b[1] * of[1]) - (b[2] * of[2] + b[3] * of[3]);
    residual_ += left_[i] * left_[i];
  }
  for (std::size_t j = 0; j < penalty_.size(); ++j) residual_ += penalized_difference(j);
}

void PenalizedSpline::invert() {
  const std::size_t p = inverse_pivot_.size();
  inverse_.assign(p + 3, Row{});
  for (std::size_t j = p; j-- > 0;) {
    const double l1 = lower_[j + 1][1], l2 = lower_[j + 2][2], l3 = lower_[j + 3][3];
    const Row &z1 = inverse_[j + 1], &z2 = inverse_[j + 2], &z3 = inverse_[j + 3];
    Row& z = inverse_[j];
    z[1] = -(l1 * z1[0] + l2 * z1[1] + l3 * z1[2]);
    z[2] = -(l1 * z1[1] + l2 * z2[0] + l3 * z2[1]);
    z[3] = -(l1 * z1[2] + l2 * z2[1] + l3 * z3[0]);
    z[0] = inverse_pivot_[j] - (l1 * z[1] + l2 * z[2] + l3 * z[3]);
  }
}

double PenalizedSpline::penalized_variance(std::size_t j) const {
  return penalty_[j] * variance(third_difference, third_difference, j);
}

double PenalizedSpline::degrees_of_freedom(const SplineBasis& basis) const {
  double sum = 0;
  for (std::size_t i = 0; i < basis.first.size(); ++i) sum += variance(basis.value[i], basis.value[i], basis.first[i]);
  return sum;
}

std::vector<double> PenalizedSpline::correlate(std::vector<double> white) const {
  const std::size_t p = inverse_pivot_.size();
  white.resize(p + 3);
  for (std::size_t j = p; j-- > 0;)
    white[j] = white[j] * std::sqrt(inverse_pivot_[j]) - lower_[j + 1][1] * white[j + 1] -
               lower_[j + 2][2] * white[j + 2] - lower_[j + 3][3] * white[j + 3];
  white.resize(p);
  return white;
}

}  // namespace asperity
