// How smooth a master curve is where each isotherm lies, from the isotherms alone: for every isotherm the mean of
// ln lambda over its likelihood (REML) on its own points and, at half weight, on those of its neighbours, with one
// noise for all of them. The mean and not the likeliest, which jumps to the stiffest wherever few points show no
// curvature.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dma/shift_likelihood.hpp"

namespace asperity {

namespace {

constexpr std::size_t penalties = 29;
double log_penalty(std::size_t i) {
  return lowest_log_penalty + (highest_log_penalty - lowest_log_penalty) * static_cast<double>(i) / (penalties - 1);
}

/// Of a modulus, isotherm by isotherm and penalty by penalty.
struct Alone {
  std::vector<std::array<double, penalties>> residual, log_determinant;
};

Alone alone(const SweepPoints& points, std::size_t modulus) {
  Alone result;
  result.residual.resize(points.isotherms());
  result.log_determinant.resize(points.isotherms());
  SplineBasis basis;
  PenalizedSpline spline;
  std::vector<double> same;
  for (std::size_t k = 0; k < points.isotherms(); ++k) {
    basis.place(std::span(points.x).subspan(points.first[k], points.size(k)));
    for (std::size_t i = 0; i < penalties; ++i) {
      same.assign(basis.differences(), log_penalty(i));
      spline.factor(basis, same);
      spline.solve(basis, std::span(points.y[modulus]).subspan(points.first[k], points.size(k)));
      result.residual[k][i] = spline.residual();
      result.log_determinant[k][i] = spline.log_determinant();
    }
  }
  return result;
}

/// The penalties for a noise; returned is -2 ln of the likelihood of isotherm and noise.
double penalties_for(const Alone& of, double variance, std::vector<double>& chosen, std::vector<double>& spread) {
  const std::size_t n = of.residual.size();
  double total = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto own = [&](std::size_t isotherm, std::size_t i) {
      return of.residual[isotherm][i] / variance + of.log_determinant[isotherm][i];
    };
    std::array<double, penalties> value;
    for (std::size_t i = 0; i < penalties; ++i)
      value[i] = own(k, i) + (k > 0 ? own(k - 1, i) / 2 : 0) + (k + 1 < n ? own(k + 1, i) / 2 : 0);
    const double least = *std::ranges::min_element(value);
    double weight = 0, mean = 0, square = 0, average = 0;
    for (std::size_t i = 0; i < penalties; ++i) {
      const double likely = std::exp((least - value[i]) / 2);
      weight += likely;
      mean += likely * log_penalty(i);
      square += likely * log_penalty(i) * log_penalty(i);
      average += likely * own(k, i);
    }
    chosen[k] = mean / weight;
    spread[k] = std::sqrt(std::max(0.0, square / weight - chosen[k] * chosen[k]));
    total += average / weight;
  }
  return total;
}

}  // namespace

Smoothness local_smoothness(const SweepPoints& points) {
  Smoothness result;
  const auto freedom = static_cast<double>(points.x.size() - 3 * points.isotherms());
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    const Alone of = alone(points, modulus);
    std::vector<double> chosen(points.isotherms()), spread(points.isotherms());
    double least = std::numeric_limits<double>::infinity();
    for (double noise = least_noise; noise < 0.5; noise *= 1.25) {
      const double value = penalties_for(of, noise * noise, chosen, spread) + freedom * std::log(noise * noise);
      if (value < least) {
        least = value;
        result.noise[modulus] = noise;
        result.log_penalty[modulus] = chosen;
        result.spread[modulus] = spread;
      }
    }
  }
  return result;
}

}  // namespace asperity
