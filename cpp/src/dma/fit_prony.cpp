// A Prony series through a measured modulus: non-negative least squares with relative weights over a grid of relaxation
// times, as few of them as Schwarz's criterion allows, then as smooth as the noise does (Tikhonov's regularisation).
// M. Baumgaertel and H. H. Winter, Rheol. Acta 28, 511 (1989).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/dense.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::ln10;
using std::numbers::pi;

namespace {

constexpr double most_modes = 16;  // per decade, of a search
constexpr double padding = 1;      // decades of relaxation times beyond the measured ones
constexpr double exact = 1e-4;     // relative rms residual below which no fit is better than another
// E' and E'' contradict each other where what the best of series leaves is above this, and this many times the scatter
// of the data; or where half of the rows are off by more than any scatter that is meant.
constexpr double contradiction = 0.03, above_scatter = 3, hopeless = 0.3;
// Published sweeps of four laboratories leave up to 0.17 (an interlayer over 26 decades); swapped columns leave 0.47
// and more, 0.18 where both moduli are alike, and a modulus in MPa for kPa or Pa 0.28 and more over a whole curve.
constexpr double mistaken = 0.2;

struct Fit {
  VectorXd times, moduli;  // moduli: of the modes, then E_inf
  VectorXd residual;       // (E'_fit - E') / E', then that of E''
  Index modes;             // unknowns that are not zero, E_inf among them
  [[nodiscard]] double sum_of_squares() const { return residual.squaredNorm(); }
  [[nodiscard]] double rms() const { return std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size())); }
};

class Measured {
 public:
  Measured(std::span<const double> w, std::span<const double> storage, std::span<const double> loss)
      : w_(w), storage_(storage), loss_(loss), n_(static_cast<Index>(w.size())), unit_(storage.back()) {}

  /// Modes of a grid: log-spaced from `pad` decades below 1 / w_max to as many above 1 / w_min, both included.
  [[nodiscard]] Index grid(double modes_per_decade, double pad) const {
    return std::max<Index>(2, std::lround(modes_per_decade * (decades() + 2 * pad)) + 1);
  }

  /// The number of values of E' and E'' together.
  [[nodiscard]] Index values() const { return 2 * n_; }

  [[nodiscard]] Fit solve(Index modes, double smoothing, double pad = padding) const;

 private:
  [[nodiscard]] double decades() const { return std::log10(w_.back()) - std::log10(w_.front()); }

  std::span<const double> w_, storage_, loss_;
  Index n_;
  double unit_;  // of modulus, where numbers near 1 are wanted
};

// Rows of A x = 1, x = (E_1 ... E_M, E_inf), each divided by its measured value:
//   E'_i:  sum_k E_k t^2 / (1 + t^2) + E_inf,   E''_i:  sum_k E_k t / (1 + t^2),   t = w_i tau_k.
// Below them Tikhonov's: smoothing times the second derivative, per decade squared, of z_k = E_k / S_k over log tau,
// where S_k is what E_k is if E'' = pi / 2 H: a modulus that runs as E'' does has z = 1 all along. By the second
// derivative noise is seen best (it makes neighbours alternate) and a plateau, a slope or E_inf not at all.
Fit Measured::solve(Index modes, double smoothing, double pad) const {
  const double step = (decades() + 2 * pad) / static_cast<double>(modes - 1);
  Fit fit{VectorXd(modes), {}, {}, 0};
  for (Index k = 0; k < modes; ++k) fit.times[k] = std::pow(10, step * static_cast<double>(k) - pad) / w_.back();

  const Index smoothing_rows = smoothing > 0 ? modes - 2 : 0;
  MatrixXd a = MatrixXd::Zero(2 * n_ + smoothing_rows, modes + 1);
  VectorXd b = VectorXd::Zero(a.rows());
  b.head(2 * n_).setOnes();
  for (Index i = 0; i < n_; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const double storage = storage_[row] / unit_, loss = loss_[row] / unit_;
    for (Index k = 0; k < modes; ++k) {
      const double t = w_[row] * fit.times[k], inverse = 1 / t;
      a(i, k) = (t < 1 ? t * t / (1 + t * t) : 1 / (1 + inverse * inverse)) / storage;
      a(n_ + i, k) = 1 / (t + inverse) / loss;
    }
    a(i, modes) = 1 / storage;
  }
  // H step ln 10 = E_k and E'' = pi / 2 H. A column's norm over the rows of E'' averages E'' about 1 / tau_k, as
  // int t^2 / (1 + t^2)^2 dln t = 1 / 2: norm^2 = points per decade / (2 ln 10) / E''^2.
  const double density = static_cast<double>(n_ - 1) / decades();
  const double scale = std::sqrt(2 * ln10 / density) * pi / (2 * ln10 * step);
  for (Index j = 0; j < smoothing_rows; ++j)
    for (Index k = j; k < j + 3; ++k)
      a(2 * n_ + j, k) = smoothing / (step * step) * (k == j + 1 ? -2 : 1) * scale * a.col(k).segment(n_, n_).norm();

  fit.moduli = nnls(a, b);
  fit.residual = a.topRows(2 * n_) * fit.moduli - b.head(2 * n_);
  fit.modes = (fit.moduli.array() > 0).count();
  fit.moduli *= unit_;
  return fit;
}

/// Schwarz's information criterion (Ann. Stat. 6, 461 (1978)) up to a constant: it falls as long as another mode takes
/// away clearly more than it would take from noise.
double criterion(const Fit& fit) {
  const auto m = static_cast<double>(fit.residual.size());
  return m * std::log(fit.sum_of_squares() / m + exact * exact) + std::log(m) * static_cast<double>(fit.modes);
}

/// The numbers of modes that a search tries: `start` per decade, times `factor` each. More than twice as many as there
/// are values say nothing new.
std::vector<Index> ladder(const Measured& data, double start, double factor) {
  std::vector<Index> modes{data.grid(start, padding)};
  for (double n = start * factor; n < most_modes * 1.01; n *= factor)
    if (const Index m = data.grid(n, padding); m > modes.back() && m <= 2 * data.values()) modes.push_back(m);
  return modes;
}

/// The fewest modes that Schwarz's criterion does not clearly prefer more to. Not below 2 a decade, where a smooth
/// modulus comes out with ripples (1.4: 2 to 4 % of E'' at steep places, 2: 0.3 %); the search ends where twice as many
/// gave nothing. Modes are not the only price of a finer grid, most of which is zero: hence a margin.
Fit fit_to_noise(const Measured& data) {
  constexpr double margin = 4;
  std::optional<Fit> best;
  int idle = 0;
  for (const Index modes : ladder(data, 2, std::numbers::sqrt2)) {
    Fit fit = data.solve(modes, 0);
    if (!best || criterion(fit) < criterion(*best) - margin) {
      best = std::move(fit);
      idle = 0;
    } else if (++idle == 2) {
      break;
    }
    if (best->rms() < exact) break;
  }
  return *best;
}

Fit fit_to_residual(const Measured& data, double residual) {
  double reached = std::numeric_limits<double>::infinity();
  for (const Index modes : ladder(data, 0.5, std::pow(2, 0.25))) {
    Fit fit = data.solve(modes, 0);
    if (fit.rms() <= residual) return fit;
    reached = std::min(reached, fit.rms());
  }
  throw NotConverged(argument("residual") + " = " + value(residual) + ": not reached with up to " + show(most_modes) +
                     " modes per decade, which leave " + show(reached, 4) + must("; must be ") +
                     "above the noise of the data");
}

/// As much smoothing as the noise allows: the sum of squares may rise to what the true modulus leaves. A fit of p
/// unknowns to m values leaves (m - p) sigma^2, the truth m sigma^2.
Fit smoothed(const Measured& data, const Fit& rough, double highest_rms) {
  const auto m = static_cast<double>(rough.residual.size()), p = static_cast<double>(rough.modes);
  const double variance = rough.sum_of_squares() / std::max(1.0, m - p);
  const double limit = std::min(rough.sum_of_squares() + p * variance, m * highest_rms * highest_rms);
  // second derivatives of z are about 1 per decade squared: weighed as values of that standard deviation are
  double smoothing = std::sqrt(variance);
  for (int i = 0; i < 5; ++i, smoothing /= std::sqrt(10)) {
    if (!(smoothing > 0)) break;
    Fit fit = data.solve(rough.times.size(), smoothing);
    if (fit.sum_of_squares() <= limit) return fit;
  }
  return rough;
}

/// Standard deviation of the noise, from second differences: of white noise they have 6 times its variance, and of
/// what a fit cannot follow, which changes slowly from row to row, they have next to nothing.
double scatter(const Fit& fit) {
  const Index n = fit.residual.size() / 2;
  double sum = 0;
  for (const Index start : {Index{0}, n}) {
    const auto r = fit.residual.segment(start, n).array();
    sum += (r.head(n - 2) - 2 * r.segment(1, n - 2) + r.tail(n - 2)).square().sum();
  }
  return std::sqrt(sum / static_cast<double>(12 * (n - 2)));
}

bool contradicts(const Fit& fit) {
  std::vector<double> off(static_cast<std::size_t>(fit.residual.size()));
  std::ranges::transform(fit.residual, off.begin(), [](double r) { return std::abs(r); });
  std::ranges::nth_element(off, off.begin() + fit.residual.size() / 2);
  return fit.rms() > std::max(contradiction, above_scatter * scatter(fit)) || off[off.size() / 2] > hopeless;
}

double rms(const Eigen::Ref<const VectorXd>& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

std::string percent(double value) { return show(100 * value, 2) + " %"; }

void check(std::span<const double> w, std::span<const double> storage, std::span<const double> loss,
           const PronyFitOptions& options) {
  require_positive_columns({{"angular_frequency", w}, {"storage_modulus", storage}, {"loss_modulus", loss}});
  require_size("angular_frequency", w.size(), 4, " for a fit");
  require_rising("angular_frequency", w);
  if (const double decades = std::log10(w.back()) - std::log10(w.front()); decades > 100)
    throw InvalidInput(argument("angular_frequency") + " spans " + value(decades, 4) + " decades" + must_be() +
                       "100 or fewer");
  if (options.modes_per_decade && options.residual)
    throw InvalidInput(argument("modes_per_decade") + ", " + argument("residual") +
                       ": must not both be given, either settles the number of modes");
  if (options.modes_per_decade && !(*options.modes_per_decade >= 0.1 && *options.modes_per_decade <= 10))
    refuse("modes_per_decade", *options.modes_per_decade, "in [0.1, 10]");
  if (options.residual) require_positive("residual", *options.residual);
}

}  // namespace

PronyFit fit_prony(std::span<const double> w, std::span<const double> storage, std::span<const double> loss,
                   const PronyFitOptions& options) {
  check(w, storage, loss, options);
  const Measured data(w, storage, loss);
  const Fit rough = options.modes_per_decade ? data.solve(data.grid(*options.modes_per_decade, padding), 0)
                    : options.residual       ? fit_to_residual(data, *options.residual)
                                             : fit_to_noise(data);
  const Fit fit = smoothed(data, rough, options.residual.value_or(std::numeric_limits<double>::infinity()));

  const Index modes = fit.times.size(), n = fit.residual.size() / 2;
  std::vector<double> moduli, times;
  for (Index k = 0; k < modes; ++k)
    if (fit.moduli[k] > 0) {
      moduli.push_back(fit.moduli[k]);
      times.push_back(fit.times[k]);
    }
  const PronySeries series(fit.moduli[modes], std::move(moduli), std::move(times));
  PronyFit result{series.fitted_on({w.front(), w.back()}, options.extrapolated),
                  rms(fit.residual.head(n)),
                  rms(fit.residual.tail(n)),
                  true,
                  {}};
  if (!contradicts(fit)) return result;
  // Too few modes or too short a range of times do not make a contradiction: ask all that a series can do.
  const Fit best = data.solve(data.grid(8, 3), 0, 3);
  if (!contradicts(best)) return result;
  result.causal = false;
  const Sentence left = {"the best leaves " + percent(best.rms()) + " (E' " + percent(rms(best.residual.head(n))) +
                         ", E'' " + percent(rms(best.residual.tail(n))) + "), their scatter is " +
                         percent(scatter(best))};
  if (best.rms() < mistaken)
    result.notes.push_back(warning("moduli-disagree",
                                   "E' and E'' disagree: no Prony series follows both (Kramers-Kronig relations), " +
                                       left +
                                       ". Those of filled rubbers do whose moduli depend on the strain, and isotherms "
                                       "that want a vertical shift",
                                   {"check the units of both columns, measure at a smaller strain, or try a vertical "
                                    "shift"}));
  else
    result.notes.push_back(fatal(
        "moduli-contradict",
        "no Prony series follows E' and E'' together: " + left +
            ". They contradict each other (Kramers-Kronig relations): E' and E'' on different frequency axes or in "
            "different units (Hz and rad/s, MPa and Pa), columns swapped, or a wrong vertical shift",
        {"check the columns and units of the moduli"}));
  return result;
}

}  // namespace asperity
