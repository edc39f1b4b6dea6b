// Whether neighbours overlap at all, by what they measured and not by how a curve would go on between them. E' rises
// with frequency at every temperature: where E' of the hotter isotherm ends above the lowest E' of the colder one by
// more than noise, they overlap. E'' says so too where it rises, or falls, throughout both; about an extremum it
// cannot, since the next extremum of a rippled modulus looks the same.
#include <algorithm>
#include <cmath>
#include <functional>

#include "dma/time_temperature_shift.hpp"

namespace asperity {

namespace {

/// An isotherm's own curve of one modulus.
struct Alone {
  double low, high, variance;  // at either end, and of low and high together
  bool rises, falls;
};

Alone alone(const SweepPoints& points, const Smoothness& smoothness, std::size_t modulus, std::size_t isotherm) {
  const auto own = [&](const std::vector<double>& of) {
    return std::span(of).subspan(points.first[isotherm], points.size(isotherm));
  };
  SplineBasis basis;
  basis.place(own(points.x));
  const std::vector<double> log_penalty(basis.differences(), smoothness.log_penalty[modulus][isotherm]);
  PenalizedSpline spline;
  spline.factor(basis, log_penalty);
  const auto y = own(points.y[modulus]);
  spline.solve(basis, y);
  spline.invert();
  std::vector<double> value(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) value[i] = y[i] - spline.left()[i];
  const auto variance = [&](std::size_t i) {
    return spline.variance(basis.value[i], basis.value[i], basis.first[i]) * std::pow(smoothness.noise[modulus], 2);
  };
  return {value.front(), value.back(), std::max(variance(0), variance(y.size() - 1)), std::ranges::is_sorted(value),
          std::ranges::is_sorted(value, std::greater{})};
}

}  // namespace

std::vector<bool> neighbours_tied(const SweepPoints& points, const Smoothness& smoothness,
                                  const std::vector<double>& shift) {
  // Standard deviations by which moduli have to meet: beyond chance where the shifts leave little in common, and where
  // they leave enough E' must not speak against it.
  constexpr double beyond_chance = 3, not_against = 0;
  std::vector<bool> tied;
  for (std::size_t k = 0; k + 1 < points.isotherms(); ++k) {
    const double overlap = points.upper(k + 1) + shift[k + 1] - points.lower(k) - shift[k];
    const double least = overlap < least_overlap ? beyond_chance : not_against;
    const auto meets = [&](std::size_t modulus) {
      const Alone cold = alone(points, smoothness, modulus, k), hot = alone(points, smoothness, modulus, k + 1);
      const bool falls = modulus == 1 && cold.falls && hot.falls;
      if (modulus == 1 && !falls && !(cold.rises && hot.rises)) return false;
      const double common = falls ? cold.low - hot.high : hot.high - cold.low;
      return common > (modulus == 0 ? least : beyond_chance) * std::sqrt(cold.variance + hot.variance);
    };
    tied.push_back(meets(0) || meets(1));
  }
  return tied;
}

}  // namespace asperity
