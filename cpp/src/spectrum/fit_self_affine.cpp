// A self-affine law through a measured spectrum: weighted least squares of ln C over ln q with a break at the roll-off,
// H = -slope / 2 - 1 (Eq. 28).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "numerics/dense.hpp"
#include "numerics/differences.hpp"
#include "numerics/roots.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Rows that are fitted: x = ln q, y = ln C, w the weights, of sum 1; their places in the spectrum and what that knows
/// of them.
struct Rows {
  Eigen::ArrayXd x, y, w;
  std::vector<std::size_t> place;
  const RowQuality& quality;
};

bool flagged(const TabulatedSpectrum& spectrum, std::size_t row, int flags) {
  return !spectrum.quality().flag.empty() && (spectrum.quality().flag[row] & flags) != 0;
}

/// Places in the spectrum of the rows that a fit takes: a straight line those from `reliable` on, a flat part also
/// those before, which a window smears only where longer waves are higher.
struct Chosen {
  std::vector<std::size_t> below, reliable;
};

/// Without q_min (q_max) rows start (end) with the reliable ones; those of a scan start where its band does: what lies
/// below has less than 0.4 of the highest density.
Chosen chosen_rows(const TabulatedSpectrum& spectrum, const FitOptions& options) {
  const auto& q = spectrum.wavenumber();
  const auto& c = spectrum.density();
  std::size_t reliable = 0, last = q.size();
  if (!options.q_min)
    while (reliable < last && flagged(spectrum, reliable, few_periods | few_modes)) ++reliable;
  if (!options.q_max)
    while (last > reliable && flagged(spectrum, last - 1, near_nyquist)) --last;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < last; ++i) {
    const bool counts = spectrum.quality().count.empty() || spectrum.quality().count[i] > 0;
    if (counts && (!options.q_min || q[i] >= *options.q_min) && (!options.q_max || q[i] <= *options.q_max))
      rows.push_back(i);
  }
  if (!options.q_min && !rows.empty() && !spectrum.quality().flag.empty()) {
    const double highest = c[*std::ranges::max_element(rows, {}, [&](std::size_t i) { return c[i]; })];
    rows.erase(rows.begin(), std::ranges::find_if(rows, [&](std::size_t i) { return c[i] >= 0.4 * highest; }));
  }
  const auto middle = std::ranges::lower_bound(rows, reliable);
  return {{rows.begin(), middle}, {middle, rows.end()}};
}

Rows gather(const TabulatedSpectrum& spectrum, const std::vector<std::size_t>& rows, FitMethod method) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Rows result{Eigen::ArrayXd(n), Eigen::ArrayXd(n), Eigen::ArrayXd::Ones(n), rows, spectrum.quality()};
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    if (spectrum.density()[row] == 0)
      refuse("density", row, 0, "positive for a fit in the logarithm; q_min, q_max may leave it out");
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
    const Eigen::ArrayXd apart = rows.w * (above - mean);
    slope = held ? *held : (apart * (rows.y - mean_y)).sum() / (apart * (above - mean)).sum();
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

/// The break in [lower, upper] that leaves least.
Broken best_break(const Rows& rows, double lower, double upper) {
  constexpr int places = 64;
  return {rows, least_of([&](double at) { return Broken(rows, at).sum_of_squares; }, lower, upper, places, 1e-9)};
}

/// The slope of the rows below x_r by themselves, and the weighted sum of squares of their distances to their middle.
std::array<double, 2> slope_below(const Rows& rows, double x_r) {
  const Eigen::ArrayXd w = (rows.x < x_r).select(rows.w, 0);
  const double mean_x = (w * rows.x).sum() / w.sum(), mean_y = (w * rows.y).sum() / w.sum();
  const Eigen::ArrayXd apart = w * (rows.x - mean_x);
  const double square = (apart * (rows.x - mean_x)).sum();
  return {(apart * (rows.y - mean_y)).sum() / square, square};
}

/// A fit to rows with its covariance, of level, slope and, where x_r is a parameter too, x_r.
struct Model {
  Rows rows;
  Broken fit;
  Eigen::MatrixXd covariance;
  double scatter;  // of a row of weight 1
  double freedom;  // what the fit takes out of the rows, in rows: more than its parameters where rows are alike

  Model(Rows of, double x_r, Eigen::Index parameters);
  [[nodiscard]] double probability(double x0) const;
};

/// Rows have the covariance V = s^2 W^-1/2 R W^-1/2, W of trace 1 and R their correlation: with A = (J^T W J)^-1 that
/// of the parameters is A J^T W V W J A. What is left has the mean s^2 (n - t), t the trace of A J^T W^1/2 R W^1/2 J.
Model::Model(Rows of, double x_r, Eigen::Index parameters) : rows(std::move(of)), fit(rows, x_r) {
  const Eigen::Index n = rows.x.size();
  const Eigen::ArrayXd above = rows.x - fit.x_r;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(n, parameters);
  jacobian.col(1) = above.max(0);
  if (parameters == 3) jacobian.col(2) = (above > 0).select(Eigen::ArrayXd::Constant(n, -fit.slope), 0);
  const Eigen::VectorXd w = rows.w;
  const Eigen::MatrixXd inverse = inverse_normal(jacobian, w), scaled = w.cwiseSqrt().asDiagonal() * jacobian;
  Eigen::MatrixXd correlated = scaled;  // R W^1/2 J
  for (std::size_t i = 0; i < rows.place.size(); ++i)
    for (std::size_t j = i + 1; j < rows.place.size() && rows.place[j] - rows.place[i] <= rows.quality.lags(); ++j) {
      const double correlation = rows.quality.correlation_of(rows.place[i], rows.place[j]);
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      correlated.row(a) += correlation * scaled.row(b);
      correlated.row(b) += correlation * scaled.row(a);
    }
  const Eigen::MatrixXd inner = scaled.transpose() * correlated;
  freedom = inverse.cwiseProduct(inner).sum();  // both symmetric
  scatter = fit.sum_of_squares / (static_cast<double>(n) - freedom);
  covariance = scatter * inverse * inner * inverse;
}

/// How probable the roll-off is against none above x0, by Schwarz's criterion for one parameter more (Ann. Stat. 6, 461
/// (1978)), rows that are alike counting as fewer. A mere bend is none: there what lies below falls, by more than two
/// of its errors, more than a quarter as steeply as what lies above.
double Model::probability(double x0) const {
  const double without = best_break(rows, rows.x[0], x0).sum_of_squares, alike = freedom / 3;
  if (!(fit.slope < 0 && without > fit.sum_of_squares)) return 0;
  const auto [slope, square] = slope_below(rows, fit.x_r);
  if (slope + 2 * std::sqrt(scatter * alike / square) < fit.slope / 4) return 0;
  const double independent = static_cast<double>(rows.x.size()) / alike;
  const double odds = independent * std::log(without / fit.sum_of_squares) - std::log(independent);
  return 1 / (1 + std::exp(-odds / 2));
}

/// The best roll-off above x0, at least three rows on either side of it.
std::optional<Model> rolled_off(Rows rows, double x0) {
  const Eigen::Index n = rows.x.size();
  if (n < 7) return std::nullopt;
  const double lower = std::max(x0, rows.x[2]), upper = rows.x[n - 4];
  if (!(upper > lower)) return std::nullopt;
  const double x_r = best_break(rows, lower, upper).x_r;
  return Model(std::move(rows), x_r, 3);
}

/// Rms height of the band [x0, x1], H and roll-off of a fit, and their covariance T C T^T, T their derivatives after
/// the parameters of its model.
struct Estimate {
  Eigen::Vector3d value;
  Eigen::Matrix3d covariance;

  Estimate(const Model& model, const Broken& fit, double x0, double x1) {
    const auto log_rms = [&](double slope, double x_r) {
      return Broken::log_rms(fit.level, fit.slope + slope, fit.x_r + x_r, x0, x1);
    };
    const double rms = std::exp(log_rms(0, 0)), rolloff = std::exp(fit.x_r);
    value = {rms, -fit.slope / 2 - 1, rolloff};
    Eigen::Matrix3d after;
    after << rms / 2, rms * slope_at_0([&](double t) { return log_rms(t, 0); }),
        rms * slope_at_0([&](double t) { return log_rms(0, t); }), 0, -0.5, 0, 0, 0, rolloff;
    covariance = congruence(after.leftCols(model.covariance.cols()), model.covariance);
  }

  /// The covariance about this estimate where another one has the probability `share`.
  void add(const Estimate& other, double share) {
    const Eigen::Vector3d apart = other.value - value;
    covariance += share * (other.covariance + apart * apart.transpose() - covariance);
  }
};

void check(const FitOptions& options) {
  if (options.q_min) require_positive("q_min", *options.q_min);
  if (options.q_max) require_positive("q_max", *options.q_max);
  if (options.q_min && options.q_max && !(*options.q_max > *options.q_min))
    refuse("q_max", *options.q_max, "above " + argument("q_min") + " = " + value(*options.q_min));
  if (options.method == FitMethod::slope && options.rolloff == Rolloff::require)
    throw InvalidInput(argument("rolloff") + ": cannot be required of method \"slope\", which is a straight line");
}

}  // namespace

// Weighted least squares in ln C. H = -slope / 2 - 1 (Eq. 28), held at 1 where it lies above by less than three of its
// errors. A line and a roll-off are compared on the same rows, those below the reliable ones too; the less probable of
// the two adds its distance to the errors (K. P. Burnham and D. R. Anderson, Sociol. Methods Res. 33, 261 (2004)).
SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, const FitOptions& options) {
  check(options);
  const auto& q = spectrum.wavenumber();
  const auto [below, reliable] = chosen_rows(spectrum, options);
  if (reliable.size() < 3) {
    const std::string found = std::to_string(reliable.size());
    if (options.q_min || options.q_max || spectrum.quality().flag.empty())
      throw InvalidInput(argument("q_min") + ", " + argument("q_max") + ": " + found + " rows of the spectrum in [" +
                         show(options.q_min.value_or(q.front())) + ", " + show(options.q_max.value_or(q.back())) +
                         "] 1/m" + must_be() + "3 or more for a fit");
    throw InvalidInput(argument("spectrum") + ": " + found + " reliable rows" + must(", must be ") +
                       "3 or more for a fit: the map is too small against its wavelengths, or too coarse; q_min and "
                       "q_max take rows on trust");
  }
  const double x0 = std::log(q[reliable.front()]), x1 = std::log(q[reliable.back()]);
  const Model line(gather(spectrum, reliable, options.method), x0, 2);
  std::vector<std::size_t> all = below;
  all.insert(all.end(), reliable.begin(), reliable.end());
  const bool straight = options.rolloff == Rolloff::none || options.method == FitMethod::slope;
  const std::optional<Model> rolled = straight ? std::nullopt : rolled_off(gather(spectrum, all, options.method), x0);
  const double probability = rolled ? rolled->probability(x0) : 0;
  if (options.rolloff == Rolloff::require && !(probability > 0.5))
    throw InvalidInput(argument("spectrum") + ": has no roll-off between " + show(q[reliable.front()], 6) + " and " +
                       show(q[reliable.back()], 6) +
                       " 1/m (rolloff = \"require\"): a scan smaller than lambda_0 does not reach it");
  const bool broken = probability > 0.5;
  const Model& likelier = broken ? *rolled : line;
  Broken fit = likelier.fit;
  double hurst = -fit.slope / 2 - 1;
  if (hurst > 1 && hurst - 1 < 3 * std::sqrt(Estimate(likelier, fit, x0, x1).covariance(1, 1))) {
    fit = Broken(likelier.rows, fit.x_r, -4);
    hurst = 1;
  }
  if (!(hurst > 0 && hurst <= 1))
    throw InvalidInput(argument("spectrum") + ": falls as q^" + show(fit.slope, 4) + " between " +
                       show(std::exp(fit.x_r), 6) + " and " + show(q[reliable.back()], 6) +
                       " 1/m, hurst = " + show(hurst, 4) + must_be() + "in (0, 1]");

  Estimate estimate(likelier, fit, x0, x1);
  if (rolled && options.rolloff == Rolloff::find) {
    const Model& other = broken ? line : *rolled;
    estimate.add(Estimate(other, other.fit, x0, x1), broken ? 1 - probability : probability);
  }
  SelfAffineFit result{
      {.rms_height = estimate.value[0], .hurst = hurst, .q0 = q[reliable.front()], .q1 = q[reliable.back()]},
      {},
      std::sqrt(fit.sum_of_squares),
      likelier.rows.place.size()};
  if (broken) result.spectrum.rolloff = estimate.value[2];
  for (std::size_t i = 0; i < (broken ? 3 : 2); ++i)
    for (std::size_t j = 0; j < (broken ? 3 : 2); ++j)
      result.covariance[i][j] = estimate.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return result;
}

}  // namespace asperity
