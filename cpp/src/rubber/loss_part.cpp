// With x_k = w tau_k and r_k = sqrt(1 + x_k^2), the loss modulus of a Prony series gives to I2
//   2 pi sum_kl E_k E_l x_k x_l / (r_k r_l (r_k + r_l)).
// With s_k = 1 - 1 / r_k a pair is also x_k x_l (s_k - s_l) / (x_k^2 - x_l^2), in which w falls out of the factor: all
// pairs whose times differ are one sum over s_k. The others, and k = l, keep the form that does not cancel.
// With u_k = -(r_k - 1) / (r_k + 1) the mean of cos(2 m phi) / (1 + x_k^2 cos^2 phi) is u_k^m / r_k, so that K_m'' has
// u_k^m / r_k in the place of 1 / r_k = 1 - s_k, and a pair has its divided difference over x^2.
#include "rubber/loss_part.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

constexpr double near = 0.2;  // relative distance of two times

struct Pair {
  std::size_t k, l;
  double weight;  // E_k E_l, twice where k and l differ
};

}  // namespace

void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part, std::span<double> slope) {
  constexpr std::size_t lanes = 4;  // frequencies at a time
  using Lanes = Eigen::Array<double, lanes, 1>;
  using Block = Eigen::Array<double, lanes, Eigen::Dynamic>;
  const auto terms = static_cast<Eigen::Index>(series.relaxation_times().size());
  Eigen::RowVectorXd weight = Eigen::RowVectorXd::Zero(terms);
  std::vector<Pair> pairs;  // those whose times differ have 2 E_k E_l x_k x_l / (x_k^2 - x_l^2) times s_k - s_l
  const std::vector<double>&e = series.moduli(), &tau = series.relaxation_times();
  for (std::size_t k = 0; k < e.size(); ++k) {
    pairs.push_back({k, k, e[k] * e[k]});
    for (std::size_t l = 0; l < k; ++l) {
      const double ratio = tau[l] / tau[k], apart = (1 - ratio) * (1 + ratio);
      if (std::fabs(1 - ratio) < near) {
        pairs.push_back({k, l, 2 * e[k] * e[l]});
      } else if (std::isfinite(apart)) {
        weight[static_cast<Eigen::Index>(k)] += 2 * e[k] * e[l] * ratio / apart;
        weight[static_cast<Eigen::Index>(l)] -= 2 * e[k] * e[l] * ratio / apart;
      }
    }
  }
  const std::size_t n = w.size(), rows = n > 0 ? part.size() / n : 0;
  const auto near_pairs = std::ssize(pairs);
  Block x(lanes, terms), r, inverse, y, half, power;
  Block value(lanes, near_pairs), u_k = value, u_l = value, by_between = value, power_l, between;  // of pairs
  for (std::size_t first = 0; first < n; first += lanes) {
    const std::size_t here = std::min(lanes, n - first);
    const auto put = [&](const Lanes& sum, double* to) {
      for (std::size_t i = 0; i < here; ++i) to[first + i] = 2 * std::numbers::pi * sum[static_cast<Eigen::Index>(i)];
    };
    const auto over_terms = [&](const Block& of) -> Lanes { return (of.matrix() * weight.transpose()).array(); };
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      for (Eigen::Index k = 0; k < terms; ++k)
        x(i, k) = std::fmin(w[std::min(first + static_cast<std::size_t>(i), n - 1)] *
                                series.relaxation_times()[static_cast<std::size_t>(k)],
                            largest_x);
    r = (1 + x.square()).sqrt();
    inverse = 1 / r;
    y = x * inverse;
    half = x / (r + 1);
    Lanes rise = over_terms(y.square() * inverse);
    for (Eigen::Index j = 0; j < near_pairs; ++j) {
      const auto& [of_k, of_l, of] = pairs[static_cast<std::size_t>(j)];
      const auto k = static_cast<Eigen::Index>(of_k), l = static_cast<Eigen::Index>(of_l);
      const Lanes over_both = 1 / (r.col(k) + r.col(l));
      value.col(j) = of * y.col(k) * y.col(l) * over_both;
      rise += value.col(j) *
              (2 - y.col(k).square() - y.col(l).square() - (x.col(k) * y.col(k) + x.col(l) * y.col(l)) * over_both);
      if (rows < 2) continue;
      u_k.col(j) = -half.col(k).square();
      u_l.col(j) = -half.col(l).square();
      by_between.col(j) = 2 * value.col(j) * (r.col(l) / (r.col(k) + 1)) / (r.col(l) + 1);
    }
    put(over_terms(y * half) + value.rowwise().sum(), part.data());
    if (!slope.empty()) put(rise, slope.data());
    power = inverse;
    power_l.setOnes(lanes, near_pairs);
    between.setZero(lanes, near_pairs);
    for (std::size_t m = 1; m < rows; ++m) {
      between = u_k * between + power_l;
      power_l *= u_l;
      power *= -half.square();
      put((by_between * between + value * power_l).rowwise().sum() - over_terms(power), &part[m * n]);
    }
  }
}

void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part) {
  if (const auto* const series = std::get_if<PronySeries>(&rubber))
    loss_part(*series, w, part);
  else
    std::get<MasterCurve>(rubber).loss_part(w, part);
}

}  // namespace asperity
