// Shift factors over temperature, and the laws through them: WLF (M. L. Williams, R. F. Landel, J. D. Ferry, J. Am.
// Chem. Soc. 77, 3701 (1955)) and Arrhenius.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/dense.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/roots.hpp"
#include "numerics/visit.hpp"

namespace asperity {

namespace {

/// log10 a_T against the reference from log10 a_T against an isotherm: less the value there, which is interpolated.
Eigen::MatrixXd about_reference(std::span<const double> covariance, const ShiftTable& shifts) {
  const std::vector<double>& t = shifts.temperature();
  require_same_size("covariance", covariance.size(), "temperature squared", t.size() * t.size());
  const auto n = static_cast<Eigen::Index>(t.size());
  const std::size_t i = interval_of(t, shifts.reference());
  const auto k = static_cast<Eigen::Index>(i);
  const double share = std::clamp((shifts.reference() - t[i]) / (t[i + 1] - t[i]), 0.0, 1.0);
  Eigen::MatrixXd less = Eigen::MatrixXd::Identity(n, n);
  less.col(k).array() -= 1 - share;
  less.col(k + 1).array() -= share;
  return congruence(less, Eigen::Map<const Eigen::MatrixXd>(covariance.data(), n, n));
}

/// The covariance of least-squares parameters, G C G^T, G = (J^T J)^-1 J^T, J the slopes of the law in them. C is
/// given, or s^2 for every row but one at the reference; where the residuals r are larger than C makes them, tr((I - J
/// G) C (I - J G)^T), as much larger.
Eigen::MatrixXd parameter_covariance(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& left,
                                     std::span<const double> covariance, const ShiftTable& shifts) {
  const Eigen::MatrixXd inverse = inverse_normal(slopes, Eigen::VectorXd::Ones(slopes.rows()));
  const double sum = left.squaredNorm();
  if (std::ranges::all_of(covariance, [](double c) { return c == 0; })) {  // none, or a_T was given
    const bool given = std::ranges::find(shifts.temperature(), shifts.reference()) != shifts.temperature().end();
    const Eigen::Index freedom = slopes.rows() - slopes.cols() - (given ? 1 : 0);
    // as many rows as parameters: the law goes through them all, and how far it is off they do not say
    if (freedom < 1) return Eigen::MatrixXd::Constant(slopes.cols(), slopes.cols(), HUGE_VAL);
    return sum / static_cast<double>(freedom) * inverse;
  }
  const Eigen::MatrixXd of_rows = about_reference(covariance, shifts);
  const Eigen::MatrixXd onto = inverse * slopes.transpose();
  const Eigen::MatrixXd off = Eigen::MatrixXd::Identity(left.size(), left.size()) - slopes * onto;
  const double expected = congruence(off, of_rows).trace();
  const double excess = expected > 0 ? std::max(1.0, sum / expected) : 1;
  return excess * congruence(onto, of_rows);
}

}  // namespace

ShiftTable::ShiftTable(double reference, std::vector<double> temperature, std::vector<double> log10_a_T,
                       std::vector<double> standard_deviation)
    : reference_(reference),
      temperature_(std::move(temperature)),
      log10_a_T_(std::move(log10_a_T)),
      deviation_(std::move(standard_deviation)) {
  require_positive("reference_temperature", reference_);
  require_same_size("log10_a_T", log10_a_T_.size(), "temperature", temperature_.size());
  require_size("temperature", temperature_.size(), 2, " for shift factors");
  require_each_positive("temperature", temperature_);
  require_rising("temperature", temperature_);
  require_each_finite("log10_a_T", log10_a_T_);
  if (!deviation_.empty()) {
    require_same_size("standard_deviation", deviation_.size(), "temperature", temperature_.size());
    for (std::size_t i = 0; i < deviation_.size(); ++i)
      require_not_negative("standard_deviation[" + std::to_string(i) + "]", deviation_[i]);
  }
  const Steffen through(temperature_, log10_a_T_);
  for (std::size_t i = 0; i < temperature_.size(); ++i) slope_.push_back(through.slope(i));
}

double ShiftTable::shift_factor(double temperature) const { return std::pow(10, shift_at(temperature).log10_a_T); }

ShiftValue ShiftTable::shift_at(double temperature) const {
  require_finite("temperature", temperature);
  if (!(temperature >= temperature_.front() && temperature <= temperature_.back()))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) + ": shift factors are known in [" +
                         in_kelvin(temperature_.front()) + ", " + in_kelvin(temperature_.back()) + "]" + unit("K"),
                     "unknown-shift");
  const std::size_t i = interval_of(temperature_, temperature);
  const double from = temperature_[i], step = temperature_[i + 1] - from;
  const auto [value, slope] =
      hermite(log10_a_T_[i], slope_[i], log10_a_T_[i + 1], slope_[i + 1], step, (temperature - from) / step);
  return {value, slope};
}

// With d = T - T_ref and a given c2, log10 a_T = c1 u, u = -d / (c2 + d), is linear in c1: c2 is searched for alone, in
// ln(c2 + lowest d), from where c2 + T - T_ref vanishes at the lowest temperature to where the law is a straight line.
WlfFit ShiftTable::fit_wlf(std::span<const double> covariance) const {
  const std::size_t n = temperature_.size();
  require_size("temperature", n, 4, " for a WLF fit");
  const auto rows = static_cast<Eigen::Index>(n);
  const Eigen::ArrayXd d = Eigen::Map<const Eigen::ArrayXd>(temperature_.data(), rows) - reference_;
  const Eigen::ArrayXd shift = Eigen::Map<const Eigen::ArrayXd>(log10_a_T_.data(), rows);
  const auto best_c1 = [&](const Eigen::ArrayXd& u) { return (u * shift).sum() / u.square().sum(); };
  const auto left = [&](double x) {
    const Eigen::ArrayXd u = -d / (std::exp(x) - d[0] + d);
    return (shift - best_c1(u) * u).square().sum();
  };
  const double c2 = std::exp(least_of(left, 0, std::log(1e5), 115, 1e-10)) - d[0];  // from 1 K to 1e5 K
  const Eigen::ArrayXd u = -d / (c2 + d);
  const double c1 = best_c1(u);
  Eigen::MatrixXd slopes(n, 2);
  slopes.col(0) = u;
  slopes.col(1) = c1 * d / (c2 + d).square();
  const Eigen::VectorXd residual = shift - c1 * u;
  const Eigen::MatrixXd variance = parameter_covariance(slopes, residual, covariance, *this);
  return {c1,
          c2,
          reference_,
          std::sqrt(variance(0, 0)),
          std::sqrt(variance(1, 1)),
          std::sqrt(residual.squaredNorm() / static_cast<double>(n))};
}

ArrheniusFit ShiftTable::fit_arrhenius(std::span<const double> covariance) const {
  const std::size_t n = temperature_.size();
  Eigen::MatrixXd slopes(n, 1);  // of log10 a_T in E_a / (R ln 10)
  for (std::size_t i = 0; i < n; ++i) slopes(static_cast<Eigen::Index>(i), 0) = 1 / temperature_[i] - 1 / reference_;
  const double square = slopes.squaredNorm();
  if (square == 0)
    throw InvalidInput(argument("temperature") + ": is the reference throughout" + must(", must differ ") +
                       "for an Arrhenius fit");
  const auto shift = Eigen::Map<const Eigen::VectorXd>(log10_a_T_.data(), static_cast<Eigen::Index>(n));
  const double slope = slopes.col(0).dot(shift) / square;
  const Eigen::VectorXd residual = shift - slope * slopes.col(0);
  const double unit = gas_constant * std::numbers::ln10;
  return {unit * slope, reference_, unit * std::sqrt(parameter_covariance(slopes, residual, covariance, *this)(0, 0)),
          std::sqrt(residual.squaredNorm() / static_cast<double>(n))};
}

// The time-temperature shift a_T and its slope over temperature, by the law of Williams, Landel and Ferry,
// log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) (J. Am. Chem. Soc. 77, 3701 (1955)), that of Arrhenius,
// ln a_T = (E_a / R) (1 / T - 1 / T_ref), or measured shift factors.

namespace {

constexpr double lowest_temperature = 150;  // [K]: rubber is glass far above it, and a temperature in Celsius below

ShiftValue wlf(double c1, double c2, double reference, double temperature) {
  const double distance = c2 + (temperature - reference);
  if (!(distance > 0))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) +
                         ": the WLF law has no a_T at or below reference_temperature - c2 = " +
                         in_kelvin(reference - c2) + unit("K"),
                     "unknown-shift");
  return {-c1 * (temperature - reference) / distance, -c1 * (c2 / distance / distance)};
}

void require_kelvin(std::string_view name, double temperature) {
  if (!(temperature >= lowest_temperature) || !std::isfinite(temperature))
    throw InvalidInput(argument(name) + " = " + value(temperature, 12, "K") + must_be() + "finite and at least " +
                           value(lowest_temperature, 12, "K") +
                           Phrase(Phrase::Kind::unit, "; its unit is kelvin", {}, "K"),
                       "invalid-value");
}

}  // namespace

void validate(const WLF& law) {
  require_positive("c1", law.c1);
  require_positive("c2", law.c2);
  require_kelvin("reference_temperature", law.reference);
}

void require_temperature(double temperature) { require_kelvin("temperature", temperature); }

ShiftValue shift_at(const TemperatureShift& shift, double temperature) {
  require_temperature(temperature);
  const ShiftValue value = std::visit(
      Overloaded{[&](const WLF& law) { return wlf(law.c1, law.c2, law.reference, temperature); },
                 [&](const WlfFit& fit) { return wlf(fit.c1, fit.c2, fit.reference, temperature); },
                 [&](const ArrheniusFit& fit) {
                   const double scale = fit.activation_energy / (gas_constant * std::numbers::ln10);
                   return ShiftValue{scale * (1 / temperature - 1 / fit.reference), -scale / temperature / temperature};
                 },
                 [&](const ShiftTable& table) { return table.shift_at(temperature); }},
      shift);
  if (!(std::fabs(value.log10_a_T) <= 200))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) +
                     ": log10 a_T = " + show(value.log10_a_T, 6) + must(", must be ") + "in [-200, 200]");
  if (!(std::fabs(value.slope) <= 1e6))
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(temperature) + ": log10 a_T changes by " +
                     show(value.slope, 6) + " per kelvin" + must(", must be ") + "at most 1e6");
  return value;
}

Rubber shifted(const Rubber& rubber, const TemperatureShift& shift, double temperature) {
  const double a_T = std::pow(10.0, shift_at(shift, temperature).log10_a_T);
  return std::visit([&](const auto& one) { return Rubber(one.shifted(a_T)); }, rubber);
}

}  // namespace asperity
