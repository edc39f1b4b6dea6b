// A build drawn from its errors: log10 a_T from its normal distribution, the smoothness from the range that the
// isotherms leave open, then the coefficients of the spline about the points moved there from theirs,
// N(c, s^2 (B^T B + P)^-1) (G. Wahba, J. R. Stat. Soc. B 45, 133 (1983)), the noise s larger where the residuals are
// correlated. A curve of points is off the spline by their residuals: a draw has them times a number of mean 1 and
// variance 1, so that draws lie about that curve, and as far apart as it and the spline do. Nothing is searched for.
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>

#include "dma/master_spline.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/random.hpp"
#include "numerics/symmetric_matrix.hpp"

namespace asperity {

namespace {

/// The points of a build as they were measured, b_T taken out.
SweepPoints measured_points(const MasterCurveBuild& build) {
  const ShiftTable& shifts = build.shifts;
  SweepPoints points;
  points.temperature = shifts.temperature();
  points.first.push_back(0);
  for (std::size_t i = 0; i < points.isotherms(); ++i) {
    for (const MasterPoint& p : build.points)  // in rising frequency
      if (p.isotherm == i) {
        points.x.push_back(std::log10(p.angular_frequency) - shifts.log10_a_T()[i]);
        points.y[0].push_back(std::log(p.storage_modulus));
        points.y[1].push_back(std::log(p.loss_modulus));
      }
    points.first.push_back(points.x.size());
  }
  return points;
}

std::vector<double> white(Random& random, std::size_t count) {
  std::vector<double> result(count);
  for (double& w : result) w = random.normal();
  return result;
}

/// Normal of mean 0 and of the covariance, which may be singular.
Eigen::VectorXd drawn_shifts(const std::vector<double>& covariance, std::size_t n, Random& random) {
  const auto size = static_cast<Eigen::Index>(n);
  const PrincipalAxes axes = principal_axes(Eigen::Map<const Eigen::MatrixXd>(covariance.data(), size, size));
  const std::vector<double> along = white(random, n);
  const Eigen::VectorXd deviation = axes.values.cwiseMax(0).cwiseSqrt();
  return axes.vectors * deviation.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(along.data(), size));
}

/// The curve with a row at each end of its extrapolation, so that it goes on from there. Drawn shifts move the ends of
/// what was measured, and whoever asks the plain curve at the end of its decade is to have that of a draw too.
MasterCurve with_rows_at_ends(const MasterCurve& curve) {
  std::vector<double> w = curve.angular_frequency();
  w.insert(w.begin(), curve.lowest_frequency());
  w.push_back(curve.highest_frequency());
  std::vector<double> storage, loss;
  for (const double one : w) {
    const std::complex<double> e = curve.modulus(one);
    storage.push_back(e.real());
    loss.push_back(e.imag());
  }
  return {std::move(w), std::move(storage), std::move(loss), curve.extrapolation()};
}

}  // namespace

MasterCurveBuild draw_master_curve(const MasterCurveBuild& build, std::uint64_t seed) {
  const SweepPoints points = measured_points(build);
  const std::size_t n = points.isotherms();
  Smoothness smoothness = local_smoothness(points);
  ShiftLikelihood likelihood(points, smoothness);
  // the noise is that of the build itself
  const std::array<double, moduli> factor = fit_factors(likelihood, build.shifts.log10_a_T());
  const double share = independent_share(likelihood);
  const MasterSpline own = master_spline(likelihood, 0);

  Random random(seed);
  const Eigen::VectorXd moved = drawn_shifts(build.covariance, n, random);
  std::vector<double> log10_a_T = build.shifts.log10_a_T();
  for (std::size_t i = 0; i < n; ++i) log10_a_T[i] += moved[static_cast<Eigen::Index>(i)];
  // T_ref between isotherms moves with its neighbours, and all the rest against it
  const double at_reference = Steffen(points.temperature, log10_a_T)(build.shifts.reference());
  for (double& a : log10_a_T) a -= at_reference;
  for (std::size_t modulus = 0; modulus < moduli; ++modulus)
    for (std::size_t i = 0; i < n; ++i) {
      double& log_penalty = smoothness.log_penalty[modulus][i];
      log_penalty = std::clamp(log_penalty + smoothness.spread[modulus][i] * random.normal(), lowest_log_penalty,
                               highest_log_penalty);
    }
  likelihood.data(log10_a_T, factor, nullptr);
  MasterSpline spline = master_spline(likelihood, 0);
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    const double noise = own.residual[modulus] / std::sqrt(share);
    const std::vector<double> error =
        likelihood.spline(modulus).correlate(white(random, spline.coefficients[modulus].size()));
    for (std::size_t j = 0; j < error.size(); ++j) spline.coefficients[modulus][j] += noise * error[j];
  }

  const bool of_points = build.master_curve.angular_frequency() == merged_points(build.points, {}).angular_frequency();
  const double times = 1 + random.normal();  // one for all: residuals hold nothing that a spline could follow
  std::vector<MasterPoint> reduced = build.points;
  for (MasterPoint& p : reduced) {
    const double moved_by = log10_a_T[p.isotherm] - build.shifts.log10_a_T()[p.isotherm];
    const double x = std::log10(p.angular_frequency);
    p.angular_frequency *= std::pow(10, moved_by);
    if (!of_points) continue;
    const Eigen::Vector2d before = own.at(x), drawn = spline.at(x + moved_by);
    p.storage_modulus = std::exp(drawn[0] + times * (std::log(p.storage_modulus) - before[0]));
    p.loss_modulus = std::exp(drawn[1] + times * (std::log(p.loss_modulus) - before[1]));
  }
  std::ranges::stable_sort(reduced, {}, &MasterPoint::angular_frequency);
  ShiftTable shifts(build.shifts.reference(), points.temperature, log10_a_T, build.shifts.standard_deviation());
  // a plain curve that ends with what was measured needs no more than this decade
  const std::optional<Extrapolation> beyond = build.master_curve.extrapolation();
  const Extrapolation further = beyond.value_or(Extrapolation::power_law);
  MasterCurve curve = of_points ? merged_points(reduced, further) : spline.sampled(0, further);
  if (beyond) curve = with_rows_at_ends(curve);
  curve = curve.with_shifts(std::make_shared<const ShiftTable>(shifts));
  return {std::move(curve), std::move(shifts), build.b_T, std::move(reduced), build.residual, build.covariance, {}};
}

}  // namespace asperity
