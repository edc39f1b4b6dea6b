// Generalised minimal residuals in single precision: as many digits as a Newton step needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "numerics/scratch.hpp"

namespace asperity {

/// Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986), preconditioned from the right; the
/// preconditioned vectors are kept (Saad's flexible variant, SIAM J. Sci. Comput. 14, 461 (1993)). Memory grows with
/// the steps that are taken and is used again.
class Gmres {
 public:
  struct Result {
    int steps;
    double residual;  // relative
  };

  /// x with |b - A x| <= tolerance |b|, or as near as `most` steps come. apply(from, to) and precondition(from, to) on
  /// n numbers.
  template <class Apply, class Precondition>
  Result operator()(std::size_t n, const float* b, float* x, double tolerance, int most, Apply apply,
                    Precondition precondition) {
    reserve(n, 0);
    std::fill_n(x, n, 0.0F);
    const double norm_b = std::sqrt(dot(n, b, b));
    if (!(norm_b > 0)) return {0, 0};
    scale(n, b, 1 / norm_b, basis_[0].data());
    std::vector<double> rotated{norm_b}, cosine, sine;
    std::vector<std::vector<double>> columns;
    int step = 0;
    double residual = norm_b;
    while (step < most && residual > tolerance * norm_b) {
      const auto j = static_cast<std::size_t>(step);
      reserve(n, j + 1);
      precondition(basis_[j].data(), directions_[j].data());
      apply(directions_[j].data(), basis_[j + 1].data());
      std::vector<double> h = orthogonalise(n, j + 1);
      for (std::size_t i = 0; i < j; ++i) {
        const double low = cosine[i] * h[i] + sine[i] * h[i + 1];
        h[i + 1] = cosine[i] * h[i + 1] - sine[i] * h[i];
        h[i] = low;
      }
      const double length = std::hypot(h[j], h[j + 1]);
      ++step;
      if (!(length > 0) || !std::isfinite(length)) {  // nothing left to add
        --step;
        break;
      }
      cosine.push_back(h[j] / length);
      sine.push_back(h[j + 1] / length);
      const bool exhausted = !(h[j + 1] > 1e-12 * length);
      h[j] = length;
      rotated.push_back(-sine[j] * rotated[j]);
      rotated[j] *= cosine[j];
      residual = std::fabs(rotated[j + 1]);
      columns.push_back(std::move(h));
      if (exhausted) break;
    }
    combine(n, columns, rotated, static_cast<std::size_t>(step), x);
    return {step, residual / norm_b};
  }

 private:
  static constexpr std::size_t block = 2048;

  static double dot(std::size_t n, const float* a, const float* b) {
    double sum = 0;
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t end = std::min(n, first + block);
      float part = 0;
#pragma omp simd reduction(+ : part)
      for (std::size_t i = first; i < end; ++i) part += a[i] * b[i];
      sum += static_cast<double>(part);
    }
    return sum;
  }

  static void scale(std::size_t n, const float* from, double factor, float* to) {
    const auto f = static_cast<float>(factor);
    for (std::size_t i = 0; i < n; ++i) to[i] = f * from[i];
  }

  void reserve(std::size_t n, std::size_t index) {
    if (n > size_) {
      basis_.clear();
      directions_.clear();
      size_ = n;
    }
    while (basis_.size() <= index) basis_.emplace_back(size_);
    while (directions_.size() < basis_.size() - 1) directions_.emplace_back(size_);
  }

  /// Takes the first `count` vectors out of the next one and makes its length 1; the products, and the length last.
  std::vector<double> orthogonalise(std::size_t n, std::size_t count) {
    float* const w = basis_[count].data();
    std::vector<double> h(count + 1, 0.0);
    for (std::size_t i = 0; i < count; ++i) h[i] = dot(n, basis_[i].data(), w);
    double square = 0;
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t end = std::min(n, first + block);
      for (std::size_t i = 0; i < count; ++i) {
        const auto f = static_cast<float>(h[i]);
        const float* const v = basis_[i].data();
        for (std::size_t k = first; k < end; ++k) w[k] -= f * v[k];
      }
      float part = 0;
#pragma omp simd reduction(+ : part)
      for (std::size_t k = first; k < end; ++k) part += w[k] * w[k];
      square += static_cast<double>(part);
    }
    h[count] = std::sqrt(square);
    if (h[count] > 0) scale(n, w, 1 / h[count], w);
    return h;
  }

  void combine(std::size_t n, const std::vector<std::vector<double>>& columns, const std::vector<double>& rotated,
               std::size_t steps, float* x) {
    std::vector<double> y(steps);
    for (std::size_t i = steps; i-- > 0;) {
      double sum = rotated[i];
      for (std::size_t j = i + 1; j < steps; ++j) sum -= columns[j][i] * y[j];
      y[i] = sum / columns[i][i];
    }
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t end = std::min(n, first + block);
      for (std::size_t j = 0; j < steps; ++j) {
        const auto f = static_cast<float>(y[j]);
        const float* const z = directions_[j].data();
        for (std::size_t k = first; k < end; ++k) x[k] += f * z[k];
      }
    }
  }

  std::size_t size_ = 0;
  std::deque<Scratch<float>> basis_, directions_;
};

}  // namespace asperity
