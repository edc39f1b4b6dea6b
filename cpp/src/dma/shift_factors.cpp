// Shift factors a_T over temperature: interpolation of log10 a_T, and the fits of Williams, Landel and Ferry,
// log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref), J. Am. Chem. Soc. 77, 3701 (1955), and of Arrhenius.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/roots.hpp"

namespace asperity {

namespace {

constexpr double gas_constant = 8.31446261815324;  // [J/(mol K)], CODATA 2018, exact

struct Sums {
  double weight = 0, uu = 0, uy = 0;
};

}  // namespace

ShiftTable::ShiftTable(double reference, std::vector<double> temperature, std::vector<double> log10_a_T,
                       std::vector<double> standard_deviation)
    : reference_(reference),
      temperature_(std::move(temperature)),
      log10_a_T_(std::move(log10_a_T)),
      deviation_(std::move(standard_deviation)) {
  require_positive("reference_temperature", reference_);
  require_same_size("log10_a_T", log10_a_T_.size(), "temperature", temperature_.size());
  if (temperature_.size() < 2)
    throw InvalidInput("temperature has " + std::to_string(temperature_.size()) +
                       " entries: must be 2 or more for shift factors");
  require_each_positive("temperature", temperature_);
  require_rising("temperature", temperature_);
  for (std::size_t i = 0; i < log10_a_T_.size(); ++i)
    require_finite("log10_a_T[" + std::to_string(i) + "]", log10_a_T_[i]);
  if (!deviation_.empty()) {
    require_same_size("standard_deviation", deviation_.size(), "temperature", temperature_.size());
    for (std::size_t i = 0; i < deviation_.size(); ++i)
      require_not_negative("standard_deviation[" + std::to_string(i) + "]", deviation_[i]);
  }
}

double ShiftTable::shift_factor(double temperature) const {
  require_finite("temperature", temperature);
  if (!(temperature >= temperature_.front() && temperature <= temperature_.back()))
    throw OutOfRange("temperature = " + show(temperature, 6) + ": shift factors are known in [" +
                     show(temperature_.front(), 6) + ", " + show(temperature_.back(), 6) + "] K");
  return std::pow(10, Steffen(temperature_, log10_a_T_)(temperature));
}

// With d = T - T_ref and a given c2, log10 a_T = c1 u, u = -d / (c2 + d), is linear in c1: c2 is searched for alone, in
// ln(c2 + lowest d), from where c2 + T - T_ref vanishes at the lowest temperature to where the law is a straight line.
WlfFit ShiftTable::fit_wlf() const {
  const std::size_t n = temperature_.size();
  if (n < 4) throw InvalidInput("temperature has " + std::to_string(n) + " entries: must be 4 or more for a WLF fit");
  const double lowest = temperature_.front() - reference_;
  const auto sums = [&](double c2) {
    Sums s;
    for (std::size_t i = 0; i < n; ++i) {
      const double d = temperature_[i] - reference_, u = -d / (c2 + d);
      s.uu += u * u;
      s.uy += u * log10_a_T_[i];
    }
    return s;
  };
  const auto left = [&](double x) {
    const double c2 = std::exp(x) - lowest;
    const Sums s = sums(c2);
    const double c1 = s.uy / s.uu;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double d = temperature_[i] - reference_;
      sum += std::pow(log10_a_T_[i] + c1 * d / (c2 + d), 2);
    }
    return sum;
  };
  double best = 0, least = std::numeric_limits<double>::infinity();
  constexpr double step = 0.1;
  for (double x = 0; x <= std::log(1e5); x += step)  // c2 + lowest d from 1 K to 1e5 K
    if (const double found = left(x); found < least) {
      least = found;
      best = x;
    }
  const double x = golden_section(left, best - step, best + step, 1e-10);
  const double c2 = std::exp(x) - lowest;
  const Sums s = sums(c2);
  const double c1 = s.uy / s.uu;

  // covariance s^2 (J^T J)^-1, J = (u, c1 d / (c2 + d)^2)
  double uv = 0, vv = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = temperature_[i] - reference_, u = -d / (c2 + d), v = c1 * d / std::pow(c2 + d, 2);
    uv += u * v;
    vv += v * v;
  }
  const double sum = left(x), variance = sum / static_cast<double>(n - 2);
  const double determinant = s.uu * vv - uv * uv;
  return {c1,
          c2,
          reference_,
          std::sqrt(variance * vv / determinant),
          std::sqrt(variance * s.uu / determinant),
          std::sqrt(sum / static_cast<double>(n))};
}

ArrheniusFit ShiftTable::fit_arrhenius() const {
  const std::size_t n = temperature_.size();
  Sums s;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = 1 / temperature_[i] - 1 / reference_;
    s.uu += u * u;
    s.uy += u * std::numbers::ln10 * log10_a_T_[i];
  }
  if (s.uu == 0) throw InvalidInput("temperature: must differ from the reference for an Arrhenius fit");
  const double slope = s.uy / s.uu;  // E_a / R
  double left = 0;
  for (std::size_t i = 0; i < n; ++i)
    left += std::pow(log10_a_T_[i] - slope * (1 / temperature_[i] - 1 / reference_) / std::numbers::ln10, 2);
  const double variance = left * std::pow(std::numbers::ln10, 2) / static_cast<double>(n - 1);
  return {gas_constant * slope, reference_, gas_constant * std::sqrt(variance / s.uu),
          std::sqrt(left / static_cast<double>(n))};
}

}  // namespace asperity
