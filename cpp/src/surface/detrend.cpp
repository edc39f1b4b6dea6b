// The least-squares offset, plane or quadratic surface of the measured points of a map, by sums along its rows.
#include "surface/detrend.hpp"

#include <algorithm>
#include <cmath>

#include "asperity/watch.hpp"
#include "numerics/dense.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/simd.hpp"
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

/// Where every point is measured; the powers are the same in all rows. Every eighth point has sums of its own: a
/// single one would wait for each addition to end.
template <bool curved, class T>
void add_heights(RowSums& sums, const T* row, const double* u, std::size_t n, double anchor) {
  constexpr std::size_t lanes = 4;
  Pair z0[lanes] = {}, z1[lanes] = {}, z2[lanes] = {};
  const auto add = [&](std::size_t lane, Pair z, Pair at) {
    z0[lane] += z;
    z1[lane] += at * z;
    if constexpr (curved) z2[lane] += at * at * z;
  };
  const std::size_t whole = n / (2 * lanes) * (2 * lanes);
  for (std::size_t x = 0; x < whole; x += 2 * lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t i = x + 2 * lane;
      add(lane, Pair{row[i] - anchor, row[i + 1] - anchor}, Pair{u[i], u[i + 1]});
    }
  for (std::size_t x = whole; x < n; ++x) add(0, Pair{row[x] - anchor, 0}, Pair{u[x], 0});
  const auto total = [](const Pair* z) {
    const Pair sum = (z[0] + z[1]) + (z[2] + z[3]);
    return sum[0] + sum[1];
  };
  sums.height[0] = total(z0);
  sums.height[1] = total(z1);
  sums.height[2] = total(z2);
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
              curved ? add_heights<true>(sums, read(y), u_.data(), u_.size(), anchor_)
                     : add_heights<false>(sums, read(y), u_.data(), u_.size(), anchor_);
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
