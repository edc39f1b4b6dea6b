// With x_k = w tau_k and r_k = sqrt(1 + x_k^2), the loss modulus of a Prony series gives to I2
//   2 pi sum_kl E_k E_l x_k x_l / (r_k r_l (r_k + r_l)).
// With s_k = 1 - 1 / r_k a pair is also x_k x_l (s_k - s_l) / (x_k^2 - x_l^2), in which w falls out of the factor: all
// pairs whose times differ are one sum over s_k. The others, and k = l, keep the form that does not cancel.
// With u_k = -(r_k - 1) / (r_k + 1) the mean of cos(2 m phi) / (1 + x_k^2 cos^2 phi) is u_k^m / r_k, so that K_m'' has
// u_k^m / r_k in the place of 1 / r_k = 1 - s_k, and a pair has its divided difference over x^2.
#include "rubber/loss_part.hpp"

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
  const std::vector<double>& tau = series.relaxation_times();
  const std::size_t terms = tau.size();
  std::vector<double> weight(terms), x(terms), r(terms);
  std::vector<Pair> pairs;
  visit_pairs(
      series, [&](const Pair& pair) { pairs.push_back(pair); },
      [&](const FarPair& pair) {
        weight[pair.k] += pair.weight;
        weight[pair.l] -= pair.weight;
      });
  const std::size_t n = w.size(), rows = n > 0 ? part.size() / n : 0;
  std::vector<double> u(terms), power(terms), between(pairs.size());
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, rise = 0;
    for (std::size_t k = 0; k < terms; ++k) {
      x[k] = std::fmin(w[i] * tau[k], largest_x);
      r[k] = std::sqrt(1 + x[k] * x[k]);
      const double y = x[k] / r[k];
      sum += weight[k] * y * (x[k] / (r[k] + 1));
      rise += weight[k] * y * y / r[k];
    }
    for (const auto& [k, l, of] : pairs) {
      const double a = x[k] / r[k], b = x[l] / r[l], both = r[k] + r[l], value = of * a * b / both;
      sum += value;
      rise += value * (2 - a * a - b * b - (x[k] * a + x[l] * b) / both);
    }
    part[i] = 2 * std::numbers::pi * sum;
    if (!slope.empty()) slope[i] = 2 * std::numbers::pi * rise;
    if (rows < 2) continue;
    for (std::size_t k = 0; k < terms; ++k) {
      const double y = x[k] / (r[k] + 1);
      u[k] = -y * y;
      power[k] = 1 / r[k];
    }
    std::ranges::fill(between, 0.0);
    for (std::size_t m = 1; m < rows; ++m) {
      double whole = 0;
      for (std::size_t j = 0; j < pairs.size(); ++j) {
        const auto& [k, l, of] = pairs[j];
        between[j] = u[k] * between[j] + power[l] * r[l];
        const double x_x = (x[k] / r[k]) * (x[l] / r[l]) / (r[k] + r[l]);
        whole += of * x_x * (2 * between[j] * (r[l] / (r[k] + 1)) / (r[l] + 1) + u[l] * power[l] * r[l]);
      }
      for (std::size_t k = 0; k < terms; ++k) {
        power[k] *= u[k];
        whole -= weight[k] * power[k];
      }
      part[m * n + i] = 2 * std::numbers::pi * whole;
    }
  }
}

namespace {

/// The sum of K_m'' times `by`, from m = 1 on, of a pair of E_k E_l = 1.
double of_pair(double x, double x_other, std::span<const double> by) {
  const double r = std::sqrt(1 + x * x), s = std::sqrt(1 + x_other * x_other);
  const double y = x / (r + 1), z = x_other / (s + 1), u = -y * y, v = -z * z;
  double power = 1, between = 0, sum = 0;
  for (const double one : by) {
    between = u * between + power;
    power *= v;
    sum += one * (2 * between * (s / (r + 1)) / (s + 1) + power);
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
