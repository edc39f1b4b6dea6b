// All shifts at once: the likeliest, begun where pairs of neighbours say and with noise of 3 % more, which is then
// taken away in turn. Residuals that are correlated within isotherms are misfit between isotherms, of which there is
// less to learn than of noise: the data then count by the share of points that are independent.
#include "dma/time_temperature_shift.hpp"

#include <algorithm>
#include <cmath>

#include "asperity/watch.hpp"

namespace asperity {

bool meet(const Isotherm& a, const Isotherm& b, double b_a, double b_b) {
  const auto [a_low, a_high] = std::ranges::minmax(a.storage_modulus());
  const auto [b_low, b_high] = std::ranges::minmax(b.storage_modulus());
  return a_low / b_a <= b_high / b_b && b_low / b_b <= a_high / b_a;
}

namespace {

/// Where f is least near x, by quasi-Newton steps (BFGS; J. Nocedal and S. J. Wright, Numerical Optimization, Springer
/// 2006, Algorithm 6.1 with a line search that halves). `inverse`, of the Hessian, is improved on the way: one that is
/// empty begins as the identity. Ends where a step would gain less than `gain`.
void minimize(ShiftLikelihood& f, Eigen::VectorXd& x, Eigen::MatrixXd& inverse, double gain) {
  constexpr int most_steps = 200;
  const Eigen::Index n = x.size();
  Eigen::VectorXd gradient(n), next_gradient(n);
  double value = f(x, gradient);
  bool fresh = inverse.size() == 0;
  if (fresh) inverse = Eigen::MatrixXd::Identity(n, n);
  for (int step = 0; step < most_steps; ++step) {
    heed();
    Eigen::VectorXd way = -(inverse * gradient);
    double slope = way.dot(gradient);
    if (!(slope < 0)) {
      inverse.setIdentity();
      fresh = true;
      way = -gradient;
      slope = way.dot(gradient);
    }
    if (!(-slope / 2 > gain)) break;  // what a parabola would gain
    constexpr double longest = 0.5;   // of a step, in any of the unknowns
    double length = std::min(1.0, longest / way.cwiseAbs().maxCoeff());
    double next_value = value;
    Eigen::VectorXd next = x;
    bool lower = false;
    for (int halving = 0; halving < 30 && !lower; ++halving) {
      next = x + length * way;
      next_value = f(next, next_gradient);
      lower = next_value <= value + 1e-4 * length * slope;
      if (!lower) {  // the parabola through both values and the slope
        const double curved = next_value - value - length * slope;
        const double least = std::isfinite(curved) ? -slope * length * length / (2 * curved) : 0;
        length = std::clamp(least, 0.1 * length, 0.5 * length);
      }
    }
    if (!lower) break;
    const Eigen::VectorXd moved = next - x, turned = next_gradient - gradient;
    const double curvature = moved.dot(turned);
    if (curvature > 1e-12 * moved.norm() * turned.norm()) {
      if (fresh) inverse *= curvature / turned.squaredNorm();
      fresh = false;
      const Eigen::VectorXd image = inverse * turned;
      inverse += (1 + turned.dot(image) / curvature) / curvature * (moved * moved.transpose()) -
                 (image * moved.transpose() + moved * image.transpose()) / curvature;
    }
    x = next;
    value = next_value;
    gradient = next_gradient;
  }
}

// Steps end where they would gain less of -ln L: a hundredth of a standard deviation at the end, less on the way there.
constexpr double gain = 1e-4, rough_gain = 1e-2;

ShiftFit descend(ShiftLikelihood& likelihood, const Smoothness& smoothness, Eigen::VectorXd unknowns, double weight,
                 std::span<const double> floors) {
  ShiftFit fit{std::move(unknowns), {}, weight};
  likelihood.weight = weight;
  for (const double floor : floors) {
    likelihood.floor = floor;
    if (floor == floors.front())
      for (std::size_t m = 0; m < moduli; ++m)  // as much smoother as the noise is larger
        fit.unknowns[fit.unknowns.size() - 2 + static_cast<Eigen::Index>(m)] +=
            std::log1p(std::pow(floor / smoothness.noise[m], 2));
    minimize(likelihood, fit.unknowns, fit.inverse, floor == floors.back() ? gain : rough_gain);
  }
  Eigen::VectorXd gradient;
  likelihood(fit.unknowns, gradient);  // so that its splines are those of the end
  return fit;
}

ShiftFit from_pairs(ShiftLikelihood& likelihood, const Smoothness& smoothness, double weight) {
  const SweepPoints& points = likelihood.points();
  const std::vector<double> steps = search_steps(points, smoothness, weight);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(steps.size() + moduli));
  for (std::size_t k = 0; k < steps.size(); ++k)
    start[static_cast<Eigen::Index>(k)] = std::log(steps[k] / (points.temperature[k + 1] - points.temperature[k]));
  return descend(likelihood, smoothness, start, weight, noise_floors);
}

std::vector<double> about(std::vector<double> shift, std::size_t fixed) {
  const double there = shift[fixed];
  for (double& s : shift) s -= there;
  return shift;
}

}  // namespace

ShiftFit fit_shifts(ShiftLikelihood& likelihood, const Smoothness& smoothness, const Eigen::VectorXd& near,
                    double weight) {
  return descend(likelihood, smoothness, near, weight, std::span(noise_floors).subspan(1));
}

ShiftFit fit_shifts(ShiftLikelihood& likelihood, const Smoothness& smoothness) {
  ShiftFit fit = from_pairs(likelihood, smoothness, 1);
  const double share = independent_share(likelihood);
  constexpr double few = 0.6;  // below, the way through the pairs may be another
  if (share < few) {
    const ShiftFit other = from_pairs(likelihood, smoothness, share);
    const double weight = std::max(share, independent_share(likelihood));
    const auto cost = [&](const ShiftFit& of) {
      Eigen::VectorXd gradient;
      likelihood.weight = weight;
      return likelihood(of.unknowns, gradient);
    };
    if (cost(other) < cost(fit)) fit = other;
    return descend(likelihood, smoothness, fit.unknowns, weight, std::span(noise_floors).last(1));
  }
  return share < 1 ? descend(likelihood, smoothness, fit.unknowns, share, std::span(noise_floors).last(1)) : fit;
}

Shifted joint_shifts(const SweepPoints& points, std::size_t fixed, const Shifted* first) {
  const Smoothness smoothness = local_smoothness(points);
  ShiftLikelihood likelihood(points, smoothness);
  const ShiftFit fit =
      first ? fit_shifts(likelihood, smoothness, first->unknowns, first->weight) : fit_shifts(likelihood, smoothness);
  const std::vector<double> shift = likelihood.shifts(fit.unknowns);
  Shifted result{
      master_spline(likelihood, points.isotherms() - 1), about(shift, fixed), {}, fit.unknowns, fit.weight, {}};
  result.spline.move(-shift[fixed]);
  if (first) return result;
  result.tied = neighbours_tied(points, smoothness, shift);
  result.covariance = shift_covariance(likelihood, fit, result.tied, fixed);
  return result;
}

Disagreement moduli_apart(const SweepPoints& points, std::size_t fixed, const Shifted& both, double least) {
  const Smoothness smoothness = local_smoothness(points);
  ShiftLikelihood storage(points, smoothness, {true, false}), loss(points, smoothness, {false, true});
  const ShiftFit of_storage = fit_shifts(storage, smoothness, both.unknowns, both.weight);
  const ShiftFit of_loss = fit_shifts(loss, smoothness, both.unknowns, both.weight);
  Disagreement result{about(storage.shifts(of_storage.unknowns), fixed), about(loss.shifts(of_loss.unknowns), fixed),
                      std::vector<double>(points.isotherms(), 0.0)};
  const auto distance = [&](std::size_t i) { return std::fabs(result.storage[i] - result.loss[i]); };
  bool far = false;
  for (std::size_t i = 0; i < points.isotherms(); ++i) far = far || distance(i) > least;
  if (!far) return result;
  const Eigen::MatrixXd covariance =
      shift_covariance(storage, of_storage, both.tied, fixed) + shift_covariance(loss, of_loss, both.tied, fixed);
  for (std::size_t i = 0; i < points.isotherms(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (i != fixed) result.deviations[i] = distance(i) / std::sqrt(covariance(at, at));
  }
  return result;
}

}  // namespace asperity
