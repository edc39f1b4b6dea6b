#include <algorithm>
#include <cmath>
#include <numbers>

#include "angular_cache.hpp"
#include "asperity/rubber.hpp"
#include "checks.hpp"
#include "integrate.hpp"
#include "interpolate.hpp"

namespace asperity {

namespace {

constexpr double rounding = 1e-12;  // how far v q0 may miss the end of a table by its own rounding

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> result(values.size());
  std::ranges::transform(values, result.begin(), [](double v) { return std::log(v); });
  return result;
}

/// asin(c) - c sqrt(1 - c^2) for 0 <= c <= 1; it is x - sin x over 2 at x = 2 asin c and cancels for small x.
double segment(double c) {
  const double x = 2 * std::asin(std::fmin(c, 1));
  if (x > 0.6) return (x - std::sin(x)) / 2;
  double term = x * x * x / 6, sum = 0;
  for (int n = 4; std::fabs(term) > 1e-18 * sum; n += 2) {
    sum += term;
    term *= -x * x / (n * (n + 1));
  }
  return sum / 2;
}

/// z >= 0 with ln cosh z = u.
double acosh_exp(double u) { return u <= 0 ? 0 : u + std::log1p(std::sqrt(-std::expm1(-2 * u))); }

}  // namespace

/// The interpolant over ln w with its extrapolation, if any, as one more interval at either end.
struct MasterCurve::Table {
  std::vector<double> frequency, storage, loss;
  std::optional<Extrapolation> extrapolation;
  Steffen log_storage, log_loss;
  std::vector<double> knots;      // [rad/s], rising
  std::vector<double> log_knots;  // ln of them
  LazyPieces<4> cache;            // ln I1, ln I2 and the shares of both that come from outside

  Table(std::vector<double> w, std::vector<double> e1, std::vector<double> e2, std::optional<Extrapolation> beyond)
      : frequency(std::move(w)),
        storage(std::move(e1)),
        loss(std::move(e2)),
        extrapolation(beyond),
        log_storage(logarithms(frequency), logarithms(storage)),
        log_loss(logarithms(frequency), logarithms(loss)),
        knots(frequency),
        cache(frequency.size() + 1) {
    if (extrapolation) {
      knots.insert(knots.begin(), frequency.front() / 10);
      knots.push_back(frequency.back() * 10);
    }
    log_knots = logarithms(knots);
  }

  [[nodiscard]] bool measured(double x) const { return x >= log_storage.x().front() && x <= log_storage.x().back(); }

  /// ln E' or ln E'' at x = ln w.
  [[nodiscard]] double beyond(const Steffen& log_modulus, double x) const {
    const double lowest = log_modulus.x().front(), highest = log_modulus.x().back();
    const double end = std::clamp(x, lowest, highest);
    double value = log_modulus(end);
    if (x != end && extrapolation == Extrapolation::power_law) value += log_modulus.end_slope_at(end) * (x - end);
    return value;
  }
  [[nodiscard]] std::complex<double> modulus(double x) const {
    return {std::exp(beyond(log_storage, x)), std::exp(beyond(log_loss, x))};
  }

  /// From the definition. With cos(phi) = sech(z) and dphi = sech(z) dz the integrals over a quadrant run over
  /// all z > 0; the interpolant's knots are at z_k = acosh(w / w_k) and between them everything is analytic.
  [[nodiscard]] AngularIntegrals integrate_angle(double x) const {
    AngularIntegrals sum{0, 0};
    const GaussRule& rule = gauss_rule();
    const auto top = static_cast<std::size_t>(std::ranges::upper_bound(log_knots, x) - log_knots.begin());
    for (std::size_t k = top; k-- > 0;) {  // from interval [x_k, x_k+1] down to the first
      const double near = k + 1 < log_knots.size() ? acosh_exp(x - log_knots[k + 1]) : 0;
      const double far = acosh_exp(x - log_knots[k]);
      // short enough for the rule in z, and in the change of ln E' and ln E'' between two knots
      const std::complex<double> low = modulus(log_knots[k]),
                                 high = modulus(k + 1 < log_knots.size() ? std::min(x, log_knots[k + 1]) : x);
      const double change =
          std::fabs(std::log(high.real() / low.real())) + std::fabs(std::log(high.imag() / low.imag()));
      const int parts = 1 + static_cast<int>(std::fmax((far - near) / 0.25, change));
      const double half = (far - near) / (2 * parts);
      for (int part = 0; part < parts; ++part)
        for (std::size_t i = 0; i < GaussRule::size; ++i) {
          const double z = near + half * (2 * part + 1 + rule.node[i]);
          const double sech = 1 / std::cosh(z), at = x + std::log(sech);
          const std::complex<double> e = modulus(at);
          const double weight = 4 * half * rule.weight[i] * sech;
          const double i1 = weight * sech * e.imag(), i2 = weight * std::norm(e);
          sum.i1 += i1;
          sum.i2 += i2;
          if (!measured(at)) {
            sum.i1_outside += i1;
            sum.i2_outside += i2;
          }
        }
    }
    // Below the lowest knot E' is constant and E'' proportional to w; with c = w_0 / w
    // I1 gets 2 E''_0 / c (asin c - c sqrt(1 - c^2)), I2 the same times E''_0 / c, and 4 E'_0^2 asin c.
    const double c = std::fmin(std::exp(log_knots.front() - x), 1);
    const std::complex<double> lowest = modulus(log_knots.front());
    const double tail1 = 2 * lowest.imag() / c * segment(c);
    const double tail2 = tail1 * lowest.imag() / c + 4 * lowest.real() * lowest.real() * std::asin(c);
    sum.i1 += tail1;
    sum.i2 += tail2;
    sum.i1_outside += tail1;
    sum.i2_outside += tail2;
    return sum;
  }

  [[nodiscard]] double checked_logarithm(double w) const {
    require_positive("angular_frequency", w);
    if (w < knots.front() * (1 - rounding) || w > knots.back() * (1 + rounding))
      throw OutOfRange("angular_frequency = " + show(w) + " rad/s: the master curve is known in [" +
                       show(knots.front()) + ", " + show(knots.back()) + "] rad/s" +
                       (extrapolation ? " with its extrapolation of one decade" : ""));
    return std::clamp(std::log(w), log_knots.front(), log_knots.back());
  }
};

MasterCurve::MasterCurve(std::vector<double> angular_frequency, std::vector<double> storage_modulus,
                         std::vector<double> loss_modulus, std::optional<Extrapolation> extrapolation) {
  require_same_size("storage_modulus", storage_modulus.size(), "angular_frequency", angular_frequency.size());
  require_same_size("loss_modulus", loss_modulus.size(), "angular_frequency", angular_frequency.size());
  if (angular_frequency.size() < 2)
    throw InvalidInput("angular_frequency has " + std::to_string(angular_frequency.size()) +
                       " entries: must be 2 or more");
  require_each_positive("angular_frequency", angular_frequency);
  require_each_positive("storage_modulus", storage_modulus);
  require_each_positive("loss_modulus", loss_modulus);
  require_rising("angular_frequency", angular_frequency);
  for (std::size_t i = 1; i < angular_frequency.size(); ++i)
    if (!(std::log(angular_frequency[i]) > std::log(angular_frequency[i - 1])))
      refuse("angular_frequency[" + std::to_string(i) + "]", angular_frequency[i],
             "further from the entry before it: their logarithms are the same number");
  table_ = std::make_shared<const Table>(std::move(angular_frequency), std::move(storage_modulus),
                                         std::move(loss_modulus), extrapolation);
}

const std::vector<double>& MasterCurve::angular_frequency() const { return table_->frequency; }
const std::vector<double>& MasterCurve::storage_modulus() const { return table_->storage; }
const std::vector<double>& MasterCurve::loss_modulus() const { return table_->loss; }
std::optional<Extrapolation> MasterCurve::extrapolation() const { return table_->extrapolation; }
double MasterCurve::lowest_frequency() const { return table_->knots.front(); }
double MasterCurve::highest_frequency() const { return table_->knots.back(); }
std::span<const double> MasterCurve::knots() const { return table_->knots; }

std::complex<double> MasterCurve::modulus(double angular_frequency) const {
  return table_->modulus(table_->checked_logarithm(angular_frequency));
}

AngularIntegrals MasterCurve::angular_integrals(double angular_frequency) const {
  const Table& table = *table_;
  const double x = table.checked_logarithm(angular_frequency);
  const auto above = std::upper_bound(table.log_knots.begin() + 1, table.log_knots.end() - 1, x);
  const auto interval = static_cast<std::size_t>(above - table.log_knots.begin()) - 1;
  const double lower = table.log_knots[interval], upper = table.log_knots[interval + 1];
  // of ln I1 and ln I2, and of the shares, which are told to a few digits only
  constexpr std::array tolerance{1e-12, 1e-12, 1e-7, 1e-7};
  const auto& pieces = table.cache.get(interval, lower, upper, tolerance, [&](double at) {
    const AngularIntegrals exact = table.integrate_angle(at);
    return std::array{std::log(exact.i1), std::log(exact.i2), exact.i1_outside / exact.i1, exact.i2_outside / exact.i2};
  });
  const auto [log_i1, log_i2, share1, share2] = pieces((x - lower) / (upper - lower));
  const double i1 = std::exp(log_i1), i2 = std::exp(log_i2);
  return {i1, i2, i1 * std::clamp(share1, 0.0, 1.0), i2 * std::clamp(share2, 0.0, 1.0)};
}

MasterCurve MasterCurve::with_shifts(std::shared_ptr<const ShiftTable> shifts) const {
  MasterCurve result = *this;
  result.shifts_ = std::move(shifts);
  return result;
}

MasterCurve MasterCurve::shifted(double a_T) const {
  require_positive("a_T", a_T);
  std::vector<double> frequency = table_->frequency;
  for (double& w : frequency) w /= a_T;
  return {std::move(frequency), table_->storage, table_->loss, table_->extrapolation};
}

}  // namespace asperity
