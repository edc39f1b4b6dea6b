// A self-affine law through a measured spectrum: weighted least squares of ln C over ln q with a break at the roll-off,
// H = -slope / 2 - 1 (Eq. 28).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "numerics/least_squares.hpp"
#include "numerics/roots.hpp"
#include "numerics/sum.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Rows that are fitted: x = ln q, y = ln C, w the weights, of sum 1; their places in the spectrum and what that knows
/// of them.
struct Rows {
  std::vector<double> x, y, w;
  const std::vector<std::size_t>& place;
  const RowQuality& quality;
  [[nodiscard]] std::size_t size() const { return x.size(); }
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
  Rows result{{}, {}, {}, rows, spectrum.quality()};
  for (const std::size_t row : rows) {
    if (spectrum.density()[row] == 0)
      refuse("density", row, 0, "positive for a fit in the logarithm; q_min, q_max may leave it out");
    result.x.push_back(std::log(spectrum.wavenumber()[row]));
    result.y.push_back(std::log(spectrum.density()[row]));
    const bool counted = method == FitMethod::least_squares && !spectrum.quality().count.empty();
    result.w.push_back(counted ? spectrum.quality().count[row] : 1);
  }
  const double total = sum(result.size(), [&](std::size_t i) { return result.w[i]; });
  for (double& weight : result.w) weight /= total;
  return result;
}

/// y = level below x_r, level + slope (x - x_r) above it.
struct Broken {
  double level, slope, x_r;
  double sum_of_squares;  // weighted, of what is left

  /// The best line for a given x_r, and slope where that is given too.
  Broken(const Rows& rows, double at, std::optional<double> held = std::nullopt) : x_r(at) {
    const auto weighted = [&](auto term) {
      return sum(rows.size(), [&](std::size_t i) { return term(rows.w[i], std::max(rows.x[i] - at, 0.0), rows.y[i]); });
    };
    const double mean = weighted([](double w, double above, double) { return w * above; });
    const double mean_y = weighted([](double w, double, double y) { return w * y; });
    slope = held ? *held
                 : weighted([&](double w, double above, double y) { return w * (above - mean) * (y - mean_y); }) /
                       weighted([&](double w, double above, double) { return w * ((above - mean) * (above - mean)); });
    level = mean_y - slope * mean;
    sum_of_squares = weighted([&](double w, double above, double y) {
      const double left = y - level - slope * above;
      return w * (left * left);
    });
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
  const std::size_t n = rows.size();
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
  const auto weighted = [&](auto term) {
    return sum(rows.size(), [&](std::size_t i) { return term(rows.x[i] < x_r ? rows.w[i] : 0, rows.x[i], rows.y[i]); });
  };
  const double total = weighted([](double w, double, double) { return w; });
  const double mean_x = weighted([](double w, double x, double) { return w * x; }) / total;
  const double mean_y = weighted([](double w, double, double y) { return w * y; }) / total;
  return weighted([&](double w, double x, double y) { return w * (x - mean_x) * (y - mean_y); }) /
         weighted([&](double w, double x, double) { return w * ((x - mean_x) * (x - mean_x)); });
}

/// Whether the roll-off is more than chance, by Schwarz's criterion (Ann. Stat. 6, 461 (1978)) with some to spare, and
/// more than a bend: what lies below it is flat, or falls less than a quarter as steeply as what lies above.
bool convincing(const Rows& rows, const Broken& line, const Broken& broken) {
  const auto n = static_cast<double>(rows.size());
  return broken.slope < 0 && n * std::log(line.sum_of_squares / broken.sum_of_squares) > std::log(n) + 10 &&
         slope_below(rows, broken.x_r) > broken.slope / 4;
}

/// Of level, slope and, as the third, x_r, from rows of covariance V = s^2 W^-1/2 R W^-1/2, W of trace 1 and R their
/// correlation: with A = (J^T W J)^-1 it is A J^T W V W J A. What is left has the mean s^2 (n - t), t the trace of
/// A J^T W^1/2 R W^1/2 J.
std::vector<double> covariance_of(const Rows& rows, const Broken& fit, std::size_t parameters) {
  const std::size_t n = rows.size();
  std::vector<double> jacobian(n * parameters, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    jacobian[n + i] = std::max(rows.x[i] - fit.x_r, 0.0);
    if (parameters == 3) jacobian[2 * n + i] = rows.x[i] > fit.x_r ? -fit.slope : 0;
  }
  const std::vector<double> inverse = inverse_normal(jacobian, rows.w);
  const std::size_t size = parameters * parameters;
  std::vector<double> inner(size);  // J^T W^1/2 R W^1/2 J
  const auto add_pair = [&](std::size_t i, std::size_t j, double correlation) {
    for (std::size_t k = 0; k < size; ++k)
      inner[k] += correlation * std::sqrt(rows.w[i] * rows.w[j]) * jacobian[k % parameters * n + i] *
                  jacobian[k / parameters * n + j];
  };
  for (std::size_t i = 0; i < n; ++i) {
    add_pair(i, i, 1);
    for (std::size_t j = i + 1; j < n && rows.place[j] - rows.place[i] <= rows.quality.lags(); ++j)
      for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}})
        add_pair(a, b, rows.quality.correlation_of(rows.place[i], rows.place[j]));
  }
  const double trace = std::inner_product(inverse.begin(), inverse.end(), inner.begin(), 0.0);  // both symmetric
  const double scatter = fit.sum_of_squares / (static_cast<double>(n) - trace);
  std::vector<double> result(size);
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t l = 0; l < size; ++l)
      result[k] += scatter * inverse[k % parameters * parameters + l % parameters] * inner[l] *
                   inverse[l / parameters * parameters + k / parameters];
  return result;
}

/// T C T^T, the covariance of three quantities whose derivatives are the rows of T.
std::array<std::array<double, 3>, 3> propagated(const std::array<std::vector<double>, 3>& transform,
                                                const std::vector<double>& covariance) {
  const std::size_t n = transform[0].size();
  std::array<std::array<double, 3>, 3> result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t l = 0; l < n; ++l) {
      double row = 0;
      for (std::size_t k = 0; k < n; ++k) row += transform[i][k] * covariance[n * l + k];
      for (std::size_t j = 0; j < 3; ++j) result[i][j] += row * transform[j][l];
    }
  return result;
}

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
// errors. The error of h_rms follows from its derivatives after the parameters.
SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, const FitOptions& options) {
  check(options);
  const auto& q = spectrum.wavenumber();
  const std::vector<std::size_t> chosen = chosen_rows(spectrum, options);
  if (chosen.size() < 3) {
    const std::string found = std::to_string(chosen.size());
    if (options.q_min || options.q_max || spectrum.quality().flag.empty())
      throw InvalidInput(argument("q_min") + ", " + argument("q_max") + ": " + found + " rows of the spectrum in [" +
                         show(options.q_min.value_or(q.front())) + ", " + show(options.q_max.value_or(q.back())) +
                         "] 1/m" + must_be() + "3 or more for a fit");
    throw InvalidInput(argument("spectrum") + ": " + found + " reliable rows" + must(", must be ") +
                       "3 or more for a fit: the map is too small against its wavelengths, or too coarse; q_min and "
                       "q_max take rows on trust");
  }
  const Rows rows = gather(spectrum, chosen, options.method);
  const double x0 = rows.x.front(), x1 = rows.x.back();

  Broken fit(rows, x0);
  bool broken = false;
  if (options.rolloff != Rolloff::none && options.method == FitMethod::least_squares) {
    const std::optional<Broken> found = best_break(rows);
    broken = found && convincing(rows, fit, *found);
    if (broken) fit = *found;
    if (!broken && options.rolloff == Rolloff::require)
      throw InvalidInput(argument("spectrum") + ": has no roll-off between " + show(q[chosen.front()], 6) + " and " +
                         show(q[chosen.back()], 6) +
                         " 1/m (rolloff = \"require\"): a scan smaller than lambda_0 does not reach it");
  }
  const std::size_t parameters = broken ? 3 : 2;
  const std::vector<double> covariance = covariance_of(rows, fit, parameters);
  const double hurst_error = std::sqrt(covariance[parameters + 1]) / 2;
  double hurst = -fit.slope / 2 - 1;
  if (hurst > 1 && hurst - 1 < 3 * hurst_error) {
    fit = Broken(rows, fit.x_r, -4);
    hurst = 1;
  }
  if (!(hurst > 0 && hurst <= 1))
    throw InvalidInput(argument("spectrum") + ": falls as q^" + show(fit.slope, 4) + " between " +
                       show(std::exp(broken ? fit.x_r : x0), 6) + " and " + show(q[chosen.back()], 6) +
                       " 1/m, hurst = " + show(hurst, 4) + must_be() + "in (0, 1]");

  const auto log_rms = [&](double level, double slope, double x_r) {
    return Broken::log_rms(fit.level + level, fit.slope + slope, fit.x_r + x_r, x0, x1);
  };
  constexpr double h = 1e-5;
  const double rms = std::exp(log_rms(0, 0, 0));
  // of rms height, H and roll-off after level, slope and x_r
  std::array<std::vector<double>, 3> transform;
  for (std::vector<double>& row : transform) row.resize(parameters);
  transform[0][0] = rms * 0.5;
  transform[0][1] = rms * ((log_rms(0, h, 0) - log_rms(0, -h, 0)) / (2 * h));
  transform[1][1] = -0.5;
  if (broken) {
    transform[0][2] = rms * ((log_rms(0, 0, h) - log_rms(0, 0, -h)) / (2 * h));
    transform[2][2] = std::exp(fit.x_r);
  }
  SelfAffineFit result{{.rms_height = rms, .hurst = hurst, .q0 = q[chosen.front()], .q1 = q[chosen.back()]},
                       {},
                       std::sqrt(fit.sum_of_squares),
                       chosen.size()};
  result.covariance = propagated(transform, covariance);
  if (broken) result.spectrum.rolloff = std::exp(fit.x_r);
  return result;
}

}  // namespace asperity
