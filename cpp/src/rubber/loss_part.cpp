// With x_k = w tau_k and r_k = sqrt(1 + x_k^2), the loss modulus of a Prony series gives to I2
//   2 pi sum_kl E_k E_l x_k x_l / (r_k r_l (r_k + r_l)).
// With s_k = 1 - 1 / r_k a pair is also x_k x_l (s_k - s_l) / (x_k^2 - x_l^2), in which w falls out of the factor: all
// pairs whose times differ are one sum over s_k. The others, and k = l, keep the form that does not cancel.
#include "rubber/loss_part.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

struct Pair {
  std::size_t k, l;
  double weight;  // E_k E_l, twice where k and l differ
};

}  // namespace

void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part, std::span<double> slope) {
  constexpr double near = 0.2;  // relative distance of two times
  const std::vector<double>&e = series.moduli(), &tau = series.relaxation_times();
  const std::size_t terms = e.size();
  std::vector<double> weight(terms), x(terms), r(terms);
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < terms; ++k) {
    pairs.push_back({k, k, e[k] * e[k]});
    for (std::size_t l = 0; l < k; ++l) {
      const double ratio = tau[l] / tau[k], apart = (1 - ratio) * (1 + ratio);
      if (std::fabs(1 - ratio) < near) {
        pairs.push_back({k, l, 2 * e[k] * e[l]});
        continue;
      }
      const double both = 2 * e[k] * e[l] * (std::isfinite(apart) ? ratio / apart : 0);
      weight[k] += both;
      weight[l] -= both;
    }
  }
  for (std::size_t i = 0; i < w.size(); ++i) {
    double sum = 0, rise = 0;
    for (std::size_t k = 0; k < terms; ++k) {
      x[k] = std::fmin(w[i] * tau[k], 1e100);
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
  }
}

void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part) {
  if (const auto* const series = std::get_if<PronySeries>(&rubber))
    loss_part(*series, w, part);
  else
    std::get<MasterCurve>(rubber).loss_part(w, part);
}

}  // namespace asperity
