// The least-squares offset, plane or quadratic surface of the measured points of a map, by sums along its rows.
#include "surface/detrend.hpp"

#include <algorithm>
#include <cmath>

#include "asperity/watch.hpp"
#include "numerics/dense.hpp"
#include "numerics/parallel_for.hpp"
#include "surface/rows.hpp"

namespace asperity {

namespace {

constexpr Eigen::Index terms(Detrend order) { return order == Detrend::offset ? 1 : order == Detrend::plane ? 3 : 6; }

/// n coordinates from -1 to 1.
std::vector<double> coordinates(std::size_t n) {
  std::vector<double> u(n, 0.0);
  for (std::size_t i = 0; i < n && n > 1; ++i) u[i] = 2 * static_cast<double>(i) / static_cast<double>(n - 1) - 1;
  return u;
}

/// Sums along a row: u^k for k = 0..4 and u^k z for k = 0..2.
struct RowSums {
  double power[5] = {}, height[3] = {};
};

/// Where every point is measured; the powers are the same in all rows.
template <class T>
void add_heights(RowSums& sums, const T* row, const std::vector<double>& along, double anchor, bool curved) {
  const auto n = std::ssize(along);
  const auto u = Eigen::ArrayXd::Map(along.data(), n);
  const Eigen::ArrayXd z = Eigen::ArrayX<T>::Map(row, n).template cast<double>() - anchor;
  sums.height[0] = z.sum();
  sums.height[1] = (u * z).sum();
  if (curved) sums.height[2] = (u.square() * z).sum();
}

template <class T>
RowSums measured_sums(const T* row, const std::vector<double>& u, double anchor) {
  RowSums sums;
  for (std::size_t x = 0; x < u.size(); ++x) {
    if (std::isnan(row[x])) continue;
    const double z = row[x] - anchor;
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= u[x]) {
      sums.power[k] += power;
      if (k < 3) sums.height[k] += power * z;
    }
  }
  return sums;
}

struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  explicit Normal(Eigen::Index m) : matrix(Eigen::MatrixXd::Zero(m, m)), right(Eigen::VectorXd::Zero(m)) {}

  void add(const RowSums& sums, double v) {
    // terms 1, u, v, u^2, u v, v^2 as powers of u times powers of v
    constexpr int power_u[6] = {0, 1, 0, 2, 1, 0};
    const double power_v[6] = {1, 1, v, 1, v, v * v};
    for (Eigen::Index i = 0; i < right.size(); ++i) {
      right[i] += power_v[i] * sums.height[power_u[i]];
      for (Eigen::Index j = 0; j < right.size(); ++j)
        matrix(i, j) += power_v[i] * power_v[j] * sums.power[power_u[i] + power_u[j]];
    }
  }
};

}  // namespace

// Normal equations in coordinates from -1 to 1 and heights about one of them: neither a large offset nor the unit
// of length costs digits.
Trend::Trend(const HeightMap& map, Detrend order, unsigned threads)
    : anchor_(first_height(map)),
      u_(coordinates(map.shape()[1])),
      v_(coordinates(map.shape()[0])),
      single_u_(u_.begin(), u_.end()) {
  const bool complete = map.dropout_fraction() == 0, curved = order == Detrend::quadratic;
  RowSums full;
  for (const double u : u_) {
    double power = 1;
    for (double& sum : full.power) {
      sum += power;
      power *= u;
    }
  }
  std::vector<Normal> contributions(threads, Normal(terms(order)));
  std::visit(
      [&](const auto* data) {
        using T = std::remove_cvref_t<decltype(*data)>;
        in_parts(threads, v_.size(), [&](unsigned part, std::size_t begin, std::size_t end) {
          RowReader<T> read(map);
          RowSums sums = full;
          for (std::size_t y = begin; y < end; ++y) {
            heed();
            if (complete)
              add_heights(sums, read(y), u_, anchor_, curved);
            else
              sums = measured_sums(read(y), u_, anchor_);
            contributions[part].add(sums, v_[y]);
          }
        });
      },
      map.data());
  Normal& total = contributions[0];
  for (unsigned part = 1; part < threads; ++part) {
    total.matrix += contributions[part].matrix;
    total.right += contributions[part].right;
  }
  // Rank-revealing: on one row, or one column, terms that it cannot tell apart are shared, not invented.
  std::ranges::copy(shortest_solution(total.matrix, total.right), coefficient_.begin());
}

Trend::Line Trend::line_at(std::size_t y) const {
  const auto& c = coefficient_;
  const double v = v_[y];
  return {anchor_, c[0] + v * (c[2] + v * c[5]), c[1] + v * c[4], c[3]};
}

}  // namespace asperity
