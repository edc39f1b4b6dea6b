// The spline through isotherms whose shifts are known, its residual, and the share of it that is no noise but misfit
// between isotherms: a lag-one correlation r of residuals leaves (1 - r) / (1 + r) of the points independent (M. S.
// Bartlett, J. R. Stat. Soc. 98, 536 (1935)).
#include <algorithm>
#include <cmath>

#include "dma/time_temperature_shift.hpp"
#include "numerics/roots.hpp"

namespace asperity {

Eigen::Vector2d MasterSpline::at(double x) const {
  const auto intervals = static_cast<double>(coefficients[0].size() - 3);
  const double place = (x - lower) / SplineBasis::spacing;
  const double interval = std::clamp(std::floor(place), 0.0, intervals - 1);
  const auto basis = cubic_basis(place - interval);
  const auto first = static_cast<std::size_t>(interval);
  Eigen::Vector2d value(0, 0);
  for (std::size_t j = 0; j < 4; ++j)
    value += basis[j] * Eigen::Vector2d(coefficients[0][first + j], coefficients[1][first + j]);
  return value;
}

void MasterSpline::move(double distance) {
  lowest += distance;
  highest += distance;
  lower += distance;
}

MasterCurve MasterSpline::sampled(double shift, std::optional<Extrapolation> extrapolation) const {
  const int steps = std::max(2, static_cast<int>(std::ceil(10 * (highest - lowest))));
  std::vector<double> w, storage, loss;
  for (int i = 0; i <= steps; ++i) {
    const double x = lowest + (highest - lowest) * i / steps;
    const Eigen::Vector2d value = at(x);
    w.push_back(std::pow(10, x + shift));
    storage.push_back(std::exp(value[0]));
    loss.push_back(std::exp(value[1]));
  }
  return {std::move(w), std::move(storage), std::move(loss), extrapolation};
}

MasterSpline master_spline(ShiftLikelihood& likelihood, std::size_t shifted) {
  MasterSpline result;
  const auto [lowest, highest] = likelihood.ends();
  result.lowest = lowest;
  result.highest = highest;
  result.lower = likelihood.basis().lower;
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    PenalizedSpline& spline = likelihood.spline(modulus);
    result.coefficients[modulus] = spline.coefficients();
    spline.invert();
    double sum = 0;
    for (const double left : spline.left()) sum += left * left;
    const double freedom = static_cast<double>(spline.left().size()) - spline.degrees_of_freedom(likelihood.basis()) -
                           static_cast<double>(shifted) / static_cast<double>(moduli);
    result.residual[modulus] = std::sqrt(sum / std::max(1.0, freedom));
  }
  return result;
}

double independent_share(ShiftLikelihood& likelihood) {
  const SweepPoints& points = likelihood.points();
  constexpr double by_chance = 0.1;  // residuals of noise alone are no more correlated than this
  double least = 1;
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    if (!likelihood.used()[modulus]) continue;
    const auto left = likelihood.spline(modulus).left();
    double square = 0, product = 0;
    for (std::size_t k = 0; k < points.isotherms(); ++k)
      for (std::size_t i = points.first[k]; i < points.first[k + 1]; ++i) {
        square += left[i] * left[i];
        if (i + 1 < points.first[k + 1]) product += left[i] * left[i + 1];
      }
    const double correlation = std::clamp(product / std::max(square, 1e-300) - by_chance, 0.0, 0.999);
    const double per_isotherm = static_cast<double>(points.x.size()) / static_cast<double>(points.isotherms());
    least = std::min(least, std::max((1 - correlation) / (1 + correlation), 1 / per_isotherm));
  }
  return least;
}

std::array<double, moduli> fit_factors(ShiftLikelihood& likelihood, std::span<const double> shift) {
  std::array<double, moduli> factor{0, 0};
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    const auto cost = [&](double log_factor) { return likelihood.alone(modulus, shift, log_factor); };
    factor[modulus] = least_of(cost, -8, 8, 8, 0.01);
  }
  likelihood.data(shift, factor);
  return factor;
}

MasterSpline master_spline_at(const SweepPoints& points, const std::vector<double>& shift) {
  const Smoothness smoothness = local_smoothness(points);
  ShiftLikelihood likelihood(points, smoothness);
  fit_factors(likelihood, shift);
  return master_spline(likelihood, 0);
}

}  // namespace asperity
