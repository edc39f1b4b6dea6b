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

#include "dma/time_temperature_shift.hpp"
#include "numerics/dense.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/random.hpp"

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

/// A square root of the covariance, which may be singular: times unit normals it is a draw.
Eigen::MatrixXd root_of(const std::vector<double>& covariance, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  const PrincipalAxes axes = principal_axes(Eigen::Map<const Eigen::MatrixXd>(covariance.data(), size, size));
  return axes.vectors * axes.values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// The measurement behind a build, with the splines that it has for shifts.
struct Measurement {
  SweepPoints points;
  Smoothness smoothness;
  ShiftLikelihood likelihood;
  std::array<double, moduli> factor;  // the noise is that of the build itself
  double share;
  MasterSpline own;

  explicit Measurement(const MasterCurveBuild& build)
      : points(measured_points(build)),
        smoothness(local_smoothness(points)),
        likelihood(points, smoothness),
        factor(fit_factors(likelihood, build.shifts.log10_a_T())),
        share(independent_share(likelihood)),
        own(master_spline(likelihood, 0)) {}

  MasterSpline spline(const std::vector<double>& log10_a_T) {
    likelihood.data(log10_a_T, factor);
    return master_spline(likelihood, 0);
  }

  /// Of the coefficients of a spline about their own.
  std::vector<double> error(std::size_t modulus, std::vector<double> white) {
    const double noise = own.residual[modulus] / std::sqrt(share);
    std::vector<double> result = likelihood.spline(modulus).correlate(std::move(white));
    for (double& e : result) e *= noise;
    return result;
  }
};

/// Shifts moved. T_ref between isotherms moves with its neighbours, and all the rest against it.
std::vector<double> moved_shifts(const ShiftTable& shifts, const Eigen::VectorXd& by) {
  std::vector<double> log10_a_T = shifts.log10_a_T();
  for (std::size_t i = 0; i < log10_a_T.size(); ++i) log10_a_T[i] += by[static_cast<Eigen::Index>(i)];
  const double at_reference = Steffen(shifts.temperature(), log10_a_T)(shifts.reference());
  for (double& a : log10_a_T) a -= at_reference;
  return log10_a_T;
}

/// Whether the curve is that of the points, off the spline by their residuals, rather than the spline.
bool is_of_points(const MasterCurveBuild& build) {
  return build.master_curve.angular_frequency() == merged_points(build.points, {}).angular_frequency();
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
  Measurement measured(build);
  const std::size_t n = measured.points.isotherms();
  const MasterSpline& own = measured.own;

  Random random(seed);
  const std::vector<double> along = white(random, n);
  const Eigen::Map<const Eigen::VectorXd> unit(along.data(), static_cast<Eigen::Index>(n));
  const std::vector<double> log10_a_T = moved_shifts(build.shifts, root_of(build.covariance, n) * unit);
  for (std::size_t modulus = 0; modulus < moduli; ++modulus)
    for (std::size_t i = 0; i < n; ++i) {
      double& log_penalty = measured.smoothness.log_penalty[modulus][i];
      log_penalty = std::clamp(log_penalty + measured.smoothness.spread[modulus][i] * random.normal(),
                               lowest_log_penalty, highest_log_penalty);
    }
  MasterSpline spline = measured.spline(log10_a_T);
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    const std::vector<double> error = measured.error(modulus, white(random, spline.coefficients[modulus].size()));
    for (std::size_t j = 0; j < error.size(); ++j) spline.coefficients[modulus][j] += error[j];
  }

  const bool of_points = is_of_points(build);
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
  ShiftTable shifts(build.shifts.reference(), measured.points.temperature, log10_a_T,
                    build.shifts.standard_deviation());
  // a plain curve that ends with what was measured needs no more than this decade
  const std::optional<Extrapolation> beyond = build.master_curve.extrapolation();
  const Extrapolation further = beyond.value_or(Extrapolation::power_law);
  MasterCurve curve = of_points ? merged_points(reduced, further) : spline.sampled(0, further);
  if (beyond) curve = with_rows_at_ends(curve);
  curve = curve.with_shifts(std::make_shared<const ShiftTable>(shifts));
  return {std::move(curve), std::move(shifts), build.b_T, std::move(reduced), build.residual, build.covariance, {}};
}

MasterCurveModes master_curve_modes(const MasterCurveBuild& build, std::span<const double> angular_frequency) {
  constexpr double step = 0.1;  // of a standard deviation
  Measurement measured(build);
  const std::size_t n = measured.points.isotherms();
  const MasterSpline own = measured.own;
  const std::vector<double>& plain = build.shifts.log10_a_T();
  std::vector<double> x;
  for (const double w : angular_frequency) x.push_back(std::clamp(std::log10(w), own.lowest, own.highest));
  MasterCurveModes modes;
  const auto add = [&](const auto& off, const std::vector<double>& log10_a_T) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Eigen::Vector2d of_row = off(k);
      modes.storage.push_back(of_row[0]);
      modes.loss.push_back(of_row[1]);
    }
    for (std::size_t i = 0; i < n; ++i) modes.log10_a_T.push_back((log10_a_T[i] - plain[i]) / step);
    ++modes.count;
  };
  const auto add_spline = [&](const std::vector<double>& log10_a_T) {
    const MasterSpline spline = measured.spline(log10_a_T);
    add([&](std::size_t k) -> Eigen::Vector2d { return (spline.at(x[k]) - own.at(x[k])) / step; }, log10_a_T);
  };
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    MasterSpline error = own;
    const std::size_t size = own.coefficients[modulus].size();
    error.coefficients[1 - modulus].assign(size, 0);
    for (std::size_t j = 0; j < size; ++j) {
      std::vector<double> one(size, 0);
      one[j] = 1;
      error.coefficients[modulus] = measured.error(modulus, std::move(one));
      add([&](std::size_t k) { return error.at(x[k]); }, plain);
    }
  }
  if (is_of_points(build)) {
    const MasterCurve& curve = build.master_curve;
    const double low = curve.angular_frequency().front(), high = curve.angular_frequency().back();
    const auto off = [&](std::size_t k) -> Eigen::Vector2d {
      const std::complex<double> e = curve.modulus(std::clamp(angular_frequency[k], low, high));
      return Eigen::Vector2d(std::log(e.real()), std::log(e.imag())) - own.at(x[k]);
    };
    add(off, plain);
  }
  const Eigen::MatrixXd root = root_of(build.covariance, n);
  for (Eigen::Index k = 0; k < root.cols(); ++k) add_spline(moved_shifts(build.shifts, step * root.col(k)));
  for (std::size_t modulus = 0; modulus < moduli; ++modulus)
    for (std::size_t i = 0; i < n; ++i) {
      double& log_penalty = measured.smoothness.log_penalty[modulus][i];
      const double before = log_penalty;
      log_penalty =
          std::clamp(before + step * measured.smoothness.spread[modulus][i], lowest_log_penalty, highest_log_penalty);
      add_spline(plain);
      log_penalty = before;
    }
  return modes;
}

}  // namespace asperity
