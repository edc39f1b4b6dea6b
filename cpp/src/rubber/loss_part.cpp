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

#include "numerics/differences.hpp"

namespace asperity {

namespace {

constexpr double near = 0.2;  // relative distance of two times

struct Pair {
  std::size_t k, l;
  double weight;  // E_k E_l, twice where k and l differ
};

/// Two terms whose times differ: `weight` (s_k - s_l) with 2 E_k E_l x_k x_l / (x_k^2 - x_l^2), and d ln weight / d ln(
/// tau_l / tau_k).
struct FarPair {
  std::size_t k, l;
  double weight, slope;
};

/// All pairs, each once.
template <class Near, class Far>
void visit_pairs(const PronySeries& series, Near near_pair, Far far_pair) {
  const std::vector<double>&e = series.moduli(), &tau = series.relaxation_times();
  for (std::size_t k = 0; k < e.size(); ++k) {
    near_pair(Pair{k, k, e[k] * e[k]});
    for (std::size_t l = 0; l < k; ++l) {
      const double ratio = tau[l] / tau[k], apart = (1 - ratio) * (1 + ratio);
      if (std::fabs(1 - ratio) < near)
        near_pair(Pair{k, l, 2 * e[k] * e[l]});
      else if (std::isfinite(apart))
        far_pair(FarPair{k, l, 2 * e[k] * e[l] * ratio / apart, (1 + ratio * ratio) / apart});
    }
  }
}

}  // namespace

void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part, std::span<double> slope) {
  constexpr std::size_t lanes = 4;  // frequencies at a time
  using Lanes = Eigen::Array<double, lanes, 1>;
  using Block = Eigen::Array<double, lanes, Eigen::Dynamic>;
  const auto terms = static_cast<Eigen::Index>(series.relaxation_times().size());
  Eigen::RowVectorXd weight = Eigen::RowVectorXd::Zero(terms);
  std::vector<Pair> pairs;
  visit_pairs(
      series, [&](const Pair& pair) { pairs.push_back(pair); },
      [&](const FarPair& pair) {
        weight[static_cast<Eigen::Index>(pair.k)] += pair.weight;
        weight[static_cast<Eigen::Index>(pair.l)] -= pair.weight;
      });
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

namespace {

/// The sum of K_m'' times `by`, from m = 1 on, of a pair of E_k E_l = 1.
double of_pair(double x, double x_other, std::span<const double> by) {
  const double r = std::sqrt(1 + x * x), s = std::sqrt(1 + x_other * x_other);
  const double y = x / (r + 1), z = x_other / (s + 1), u = -y * y, v = -z * z;
  const double by_between = 2 * (s / (r + 1)) / (s + 1);
  double power = 1, between = 0, sum = 0;
  for (const double one : by) {
    between = u * between + power;
    power *= v;
    sum += one * (by_between * between + power);
  }
  return x / r * (x_other / s) / (r + s) * sum;
}

}  // namespace

void loss_part_gradient(const PronySeries& series, std::span<const double> w, std::span<const double> by_part,
                        std::span<double> moduli, std::span<double> relaxation_times) {
  const std::vector<double>& tau = series.relaxation_times();
  const std::size_t terms = tau.size();
  std::vector<double> s(terms), rise(terms);  // sums of s_k and ds_k / d ln x
  std::vector<Pair> pairs;
  const auto add = [&](std::size_t k, double over_modulus, double over_time) {
    moduli[k] += 2 * std::numbers::pi * over_modulus;
    relaxation_times[k] += 2 * std::numbers::pi * over_time;
  };
  const auto far_pair = [&](const FarPair& pair) {
    const double value = pair.weight * (s[pair.k] - s[pair.l]);
    add(pair.k, value, pair.weight * rise[pair.k] - pair.slope * value);
    add(pair.l, value, -pair.weight * rise[pair.l] + pair.slope * value);
  };
  std::vector<double> x(terms), r(terms);
  visit_pairs(
      series, [&](const Pair& pair) { pairs.push_back(pair); }, [](const FarPair&) {});
  const std::size_t rows = w.empty() ? 0 : by_part.size() / w.size();
  for (std::size_t i = 0; i < w.size(); ++i) {
    const std::span<const double> by = by_part.subspan(i * rows, rows), by_harmonics = by.subspan(1);
    if (std::ranges::all_of(by, [](double one) { return one == 0; })) continue;
    for (std::size_t k = 0; k < terms; ++k) {
      x[k] = std::fmin(w[i] * tau[k], largest_x);
      r[k] = std::sqrt(1 + x[k] * x[k]);
      const double y = x[k] / r[k], root = x[k] / (r[k] + 1);
      s[k] += by[0] * y * root;
      rise[k] += by[0] * y * y / r[k];
      double power = 1 / r[k];
      for (std::size_t m = 0; m < by_harmonics.size(); ++m) {
        power *= -root * root;
        s[k] -= by_harmonics[m] * power;
        rise[k] -= by_harmonics[m] * power * (2 * static_cast<double>(m + 1) / r[k] - y * y);
      }
    }
    for (const auto& [k, l, of] : pairs) {
      const double a = x[k] / r[k], b = x[l] / r[l], both = r[k] + r[l], value = by[0] * of * a * b / both;
      add(k, value, value * (1 - a * a - x[k] * a / both));
      add(l, value, value * (1 - b * b - x[l] * b / both));
      if (by_harmonics.empty()) continue;
      const auto at = [&, k = k, l = l](double first, double second) {
        return of_pair(x[k] * std::exp(first), x[l] * std::exp(second), by_harmonics);
      };
      const double of_both = of * at(0, 0);
      add(k, of_both, of * slope_at_0([&](double t) { return at(t, 0); }));
      add(l, of_both, of * slope_at_0([&](double t) { return at(0, t); }));
    }
  }
  visit_pairs(
      series, [](const Pair&) {}, far_pair);
}

void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part) {
  if (const auto* const series = std::get_if<PronySeries>(&rubber))
    loss_part(*series, w, part);
  else
    std::get<MasterCurve>(rubber).loss_part(w, part);
}

}  // namespace asperity
