// How far shifts are known: the inverse Hessian of -ln L, and the reach of each step. On a plateau the determinant of
// the likelihood draws isotherms together, and its curvature is no information; what the data say is how far one may
// slide there before the residual alone tells.
#include <algorithm>
#include <cmath>
#include <functional>

#include "dma/time_temperature_shift.hpp"
#include "numerics/dense.hpp"

namespace asperity {

namespace {

Eigen::MatrixXd hessian(ShiftLikelihood& likelihood, const ShiftFit& fit) {
  const Eigen::Index n = fit.unknowns.size();
  Eigen::MatrixXd result(n, n);
  Eigen::VectorXd above, below;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double width = 0.1 * std::sqrt(std::clamp(fit.inverse(i, i), 1e-10, 1e-2));
    Eigen::VectorXd at = fit.unknowns;
    at[i] += width;
    likelihood(at, above);
    at[i] -= 2 * width;
    likelihood(at, below);
    result.col(i) = (above - below) / (2 * width);
  }
  return (result + result.transpose()) / 2;
}

/// How far all isotherms beyond a step may move before the residual part of -ln L rises by 2, two standard deviations
/// were it a parabola: no farther than `limit`.
double reach_of(ShiftLikelihood& likelihood, const ShiftFit& fit, const std::vector<double>& shift, std::size_t step,
                double way, double from, double limit) {
  const std::array<double, moduli> factor = ShiftLikelihood::log_factors(fit.unknowns);
  const double here = likelihood.data(shift, factor, nullptr, true);
  std::vector<double> moved = shift;
  const auto rise = [&](double distance) {
    for (std::size_t k = step + 1; k < shift.size(); ++k) moved[k] = shift[k] + way * distance;
    return fit.weight * (likelihood.data(moved, factor, nullptr, true) - here);
  };
  double inside = 0, risen = 0, outside = std::min(from, limit);
  for (;;) {
    const double there = rise(outside);
    if (there >= 2) return inside + (outside - inside) * (2 - risen) / (there - risen);
    if (outside >= limit) return limit;
    inside = outside;
    risen = there;
    outside = std::min(1.5 * outside, limit);
  }
}

}  // namespace

Eigen::MatrixXd shift_covariance(ShiftLikelihood& likelihood, const ShiftFit& fit, const std::vector<bool>& tied,
                                 std::size_t fixed) {
  const SweepPoints& points = likelihood.points();
  const std::vector<double> shift = likelihood.shifts(fit.unknowns);
  const auto steps = static_cast<Eigen::Index>(shift.size()) - 1;
  likelihood.weight = fit.weight;

  const PrincipalAxes curvature = principal_axes(hessian(likelihood, fit));
  // the prior alone has the curvature 1 / spread^2 or more; less is rounding
  const Eigen::VectorXd variance =
      curvature.values.cwiseMax(1 / (RatePrior::spread * RatePrior::spread)).cwiseInverse();
  const Eigen::MatrixXd inverse = congruence(curvature.vectors, variance.asDiagonal());

  // of the steps: d step = step d ln rate; where the data reach farther, as much wider
  Eigen::VectorXd scale(steps), beyond = Eigen::VectorXd::Zero(steps);
  for (Eigen::Index i = 0; i < steps; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double step = shift[at] - shift[at + 1], deviation = step * std::sqrt(inverse(i, i));
    const double gap = points.lower(at) + step - points.upper(at + 1);  // below zero where they overlap
    const double limit = std::max(points.length(at), points.length(at + 1)) + 1 + std::max(0.0, gap);
    const double start = 2 * deviation;
    const bool open = !tied[at] || gap > 0;
    // across a gap the residual tells how smooth the isotherms are, and not what lies between them
    const double reach =
        open ? limit
             : std::max(reach_of(likelihood, fit, shift, at, -1, start, limit),
                        reach_of(likelihood, fit, shift, at, 1, std::min(start, step), std::min(step, limit)));
    if (open)  // whatever the others do
      beyond[i] = std::max(0.0, reach * reach / 4 - deviation * deviation);
    scale[i] = open ? step : step * std::max(1.0, reach / 2 / deviation);
  }
  Eigen::MatrixXd of_steps = scale.asDiagonal() * inverse.topLeftCorner(steps, steps) * scale.asDiagonal();
  of_steps.diagonal() += beyond;

  // shift of isotherm i about the fixed one: the steps between them, down from a colder one and up from a hotter one
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(steps + 1, steps);
  const auto reference = static_cast<Eigen::Index>(fixed);
  for (Eigen::Index i = 0; i <= steps; ++i)
    for (Eigen::Index k = std::min(i, reference); k < std::max(i, reference); ++k) sum(i, k) = i > reference ? -1 : 1;
  return congruence(sum, of_steps);
}

// Whether neighbours overlap at all, by what they measured and not by how a curve would go on between them. E' rises
// with frequency at every temperature: where E' of the hotter isotherm ends above the lowest E' of the colder one by
// more than noise, they overlap. E'' says so too where it rises, or falls, throughout both; about an extremum it
// cannot, since the next extremum of a rippled modulus looks the same.

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
