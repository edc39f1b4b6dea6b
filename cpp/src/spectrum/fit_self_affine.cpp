#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "numerics/minimum.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Rows that are fitted: x = ln q, y = ln C, w the weights, of sum 1.
struct Rows {
  Eigen::ArrayXd x, y, w;
  [[nodiscard]] Eigen::Index size() const { return x.size(); }
};

bool flagged(const TabulatedSpectrum& spectrum, std::size_t row, int flags) {
  return !spectrum.quality().flag.empty() && (spectrum.quality().flag[row] & flags) != 0;
}

/// Without q_min (q_max) rows start (end) with the reliable ones; those of a scan start where its band does: what lies
/// below has less than 0.4 of the highest density.
std::vector<std::size_t> chosen_rows(const TabulatedSpectrum& spectrum, const FitOptions& options) {
  const auto& q = spectrum.wavenumber();
  const auto& c = spectrum.density();
  std::size_t first = 0, last = q.size();
  if (!options.q_min)
    while (first < last && flagged(spectrum, first, few_periods | few_modes)) ++first;
  if (!options.q_max)
    while (last > first && flagged(spectrum, last - 1, near_nyquist)) --last;
  std::vector<std::size_t> rows;
  for (std::size_t i = first; i < last; ++i) {
    const bool counts = spectrum.quality().count.empty() || spectrum.quality().count[i] > 0;
    if (counts && (!options.q_min || q[i] >= *options.q_min) && (!options.q_max || q[i] <= *options.q_max))
      rows.push_back(i);
  }
  if (!options.q_min && !rows.empty() && !spectrum.quality().flag.empty()) {
    const double highest = c[*std::ranges::max_element(rows, {}, [&](std::size_t i) { return c[i]; })];
    rows.erase(rows.begin(), std::ranges::find_if(rows, [&](std::size_t i) { return c[i] >= 0.4 * highest; }));
  }
  return rows;
}

Rows gather(const TabulatedSpectrum& spectrum, const std::vector<std::size_t>& rows, FitMethod method) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Rows result{Eigen::ArrayXd(n), Eigen::ArrayXd(n), Eigen::ArrayXd::Ones(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    if (spectrum.density()[row] == 0)
      refuse("density[" + std::to_string(row) + "]", 0,
             "positive for a fit in the logarithm; q_min, q_max may leave it out");
    result.x[i] = std::log(spectrum.wavenumber()[row]);
    result.y[i] = std::log(spectrum.density()[row]);
    if (method == FitMethod::least_squares && !spectrum.quality().count.empty())
      result.w[i] = spectrum.quality().count[row];
  }
  result.w /= result.w.sum();
  return result;
}

/// y = level below x_r, level + slope (x - x_r) above it.
struct Broken {
  double level, slope, x_r;
  double sum_of_squares;  // weighted, of what is left

  /// The best line for a given x_r, and slope where that is given too.
  Broken(const Rows& rows, double at, std::optional<double> held = std::nullopt) : x_r(at) {
    const Eigen::ArrayXd above = (rows.x - at).max(0);
    const double mean = (rows.w * above).sum(), mean_y = (rows.w * rows.y).sum();
    slope =
        held ? *held : (rows.w * (above - mean) * (rows.y - mean_y)).sum() / (rows.w * (above - mean).square()).sum();
    level = mean_y - slope * mean;
    sum_of_squares = (rows.w * (rows.y - level - slope * above).square()).sum();
  }

  /// ln h_rms of the band [x0, x1], for given parameters: 2 pi int q C dq of the flat and the falling part.
  static double log_rms(double level, double slope, double x_r, double x0, double x1) {
    const double e = 2 + slope, length = x1 - x_r;
    const double flat = -std::expm1(2 * (x0 - x_r)) / 2, fall = e == 0 ? length : std::expm1(e * length) / e;
    return (std::log(2 * pi * (flat + fall)) + level) / 2 + x_r;
  }
};

/// The break that leaves least: among 64 places in ln q first, then between the neighbours of the best of them. At
/// least three rows lie on either side, and the flat part spans a factor 1.5.
std::optional<Broken> best_break(const Rows& rows) {
  const Eigen::Index n = rows.size();
  if (n < 7) return std::nullopt;
  const double lower = std::max(rows.x[2], rows.x[0] + std::log(1.5)), upper = rows.x[n - 4];
  if (!(upper > lower)) return std::nullopt;
  constexpr int places = 64;
  const double step = (upper - lower) / places;
  double best = lower, least = Broken(rows, lower).sum_of_squares;
  for (int i = 1; i <= places; ++i)
    if (const double left = Broken(rows, lower + step * i).sum_of_squares; left < least) {
      least = left;
      best = lower + step * i;
    }
  const auto left = [&](double at) { return Broken(rows, at).sum_of_squares; };
  return Broken(rows, golden_section(left, std::max(lower, best - step), std::min(upper, best + step), 1e-9));
}

/// The slope of the rows below x_r by themselves.
double slope_below(const Rows& rows, double x_r) {
  const Eigen::ArrayXd w = (rows.x < x_r).select(rows.w, 0.0);
  const double mean_x = (w * rows.x).sum() / w.sum(), mean_y = (w * rows.y).sum() / w.sum();
  return (w * (rows.x - mean_x) * (rows.y - mean_y)).sum() / (w * (rows.x - mean_x).square()).sum();
}

/// Whether the roll-off is more than chance, by Schwarz's criterion (Ann. Stat. 6, 461 (1978)) with some to spare, and
/// more than a bend: what lies below it is flat, or falls less than a quarter as steeply as what lies above.
bool convincing(const Rows& rows, const Broken& line, const Broken& broken) {
  const auto n = static_cast<double>(rows.size());
  return broken.slope < 0 && n * std::log(line.sum_of_squares / broken.sum_of_squares) > std::log(n) + 10 &&
         slope_below(rows, broken.x_r) > broken.slope / 4;
}

/// s^2 (J^T W J)^-1 of level, slope and, as the third, x_r: W of trace 1, s^2 what is left over the degrees of freedom.
Eigen::MatrixXd covariance_of(const Rows& rows, const Broken& fit, int parameters) {
  const Eigen::Index n = rows.size();
  Eigen::MatrixXd jacobian(n, parameters);
  jacobian.col(0).setOnes();
  jacobian.col(1) = (rows.x - fit.x_r).max(0).matrix();
  if (parameters == 3)
    jacobian.col(2) = (rows.x > fit.x_r).select(Eigen::ArrayXd::Constant(n, -fit.slope), 0.0).matrix();
  const double scatter = fit.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(1, n - parameters));
  return scatter * (jacobian.transpose() * rows.w.matrix().asDiagonal() * jacobian)
                       .completeOrthogonalDecomposition()
                       .pseudoInverse();
}

void check(const FitOptions& options) {
  if (options.q_min) require_positive("q_min", *options.q_min);
  if (options.q_max) require_positive("q_max", *options.q_max);
  if (options.q_min && options.q_max && !(*options.q_max > *options.q_min))
    refuse("q_max", *options.q_max, "above q_min = " + show(*options.q_min));
  if (options.method == FitMethod::slope && options.rolloff == Rolloff::require)
    throw InvalidInput("rolloff: cannot be required of method \"slope\", which is a straight line");
}

}  // namespace

// Weighted least squares in ln C. H = -slope / 2 - 1 (Eq. 28), held at 1 where it lies above by less than three of its
// errors. The error of h_rms follows from its derivatives after the parameters.
SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, const FitOptions& options) {
  check(options);
  const auto& q = spectrum.wavenumber();
  const std::vector<std::size_t> chosen = chosen_rows(spectrum, options);
  if (chosen.size() < 3) {
    const std::string found = std::to_string(chosen.size());
    if (options.q_min || options.q_max || spectrum.quality().flag.empty())
      throw InvalidInput("q_min, q_max: " + found + " rows of the spectrum in [" +
                         show(options.q_min.value_or(q.front())) + ", " + show(options.q_max.value_or(q.back())) +
                         "] 1/m: must be 3 or more for a fit");
    throw InvalidInput("spectrum: " + found +
                       " reliable rows, must be 3 or more for a fit: the map is too small against its wavelengths, or "
                       "too coarse; q_min and q_max take rows on trust");
  }
  const Rows rows = gather(spectrum, chosen, options.method);
  const Eigen::Index n = rows.size();
  const double x0 = rows.x[0], x1 = rows.x[n - 1];

  Broken fit(rows, x0);
  bool broken = false;
  if (options.rolloff != Rolloff::none && options.method == FitMethod::least_squares) {
    const std::optional<Broken> found = best_break(rows);
    broken = found && convincing(rows, fit, *found);
    if (broken) fit = *found;
    if (!broken && options.rolloff == Rolloff::require)
      throw InvalidInput("spectrum: has no roll-off between " + show(q[chosen.front()]) + " and " +
                         show(q[chosen.back()]) +
                         " 1/m (rolloff = \"require\"): a scan smaller than lambda_0 does not reach it");
  }
  const int parameters = broken ? 3 : 2;
  const Eigen::MatrixXd covariance = covariance_of(rows, fit, parameters);
  const double hurst_error = std::sqrt(covariance(1, 1)) / 2;
  double hurst = -fit.slope / 2 - 1;
  if (hurst > 1 && hurst - 1 < 3 * hurst_error) {
    fit = Broken(rows, fit.x_r, -4);
    hurst = 1;
  }
  if (!(hurst > 0 && hurst <= 1))
    throw InvalidInput("spectrum: falls as q^" + show(fit.slope, 4) + " between " +
                       show(std::exp(broken ? fit.x_r : x0)) + " and " + show(q[chosen.back()]) +
                       " 1/m, hurst = " + show(hurst, 4) + ": must be in (0, 1]");

  const auto log_rms = [&](double level, double slope, double x_r) {
    return Broken::log_rms(fit.level + level, fit.slope + slope, fit.x_r + x_r, x0, x1);
  };
  constexpr double h = 1e-5;
  Eigen::VectorXd gradient(parameters);
  gradient[0] = 0.5;
  gradient[1] = (log_rms(0, h, 0) - log_rms(0, -h, 0)) / (2 * h);
  if (broken) gradient[2] = (log_rms(0, 0, h) - log_rms(0, 0, -h)) / (2 * h);

  const double rms = std::exp(log_rms(0, 0, 0));
  // of rms height, H and roll-off after level, slope and x_r
  Eigen::MatrixXd transform = Eigen::MatrixXd::Zero(3, parameters);
  transform.row(0) = rms * gradient.transpose();
  transform(1, 1) = -0.5;
  if (broken) transform(2, 2) = std::exp(fit.x_r);
  const Eigen::Matrix3d spread = transform * covariance * transform.transpose();
  SelfAffineFit result{{.rms_height = rms, .hurst = hurst, .q0 = q[chosen.front()], .q1 = q[chosen.back()]},
                       {},
                       std::sqrt(fit.sum_of_squares),
                       chosen.size()};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result.covariance[i][j] = spread(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  if (broken) result.spectrum.rolloff = std::exp(fit.x_r);
  return result;
}

}  // namespace asperity
