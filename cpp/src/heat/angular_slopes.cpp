// With x_k = (w tau_k)^2 and r_k = sqrt(1 + x_k), the integrals of a Prony series are I1 = 2 pi sum_k E_k s_k / (w
// tau_k) and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), s_k = 1 - 1 / r_k, and ds_k/dln w = x_k / r_k^3. Those of a master
// curve are differentiated by central differences.
#include "heat/angular_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/kernels.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

void AngularColumns::resize(std::size_t n) {
  for (auto* column : {&i1, &i2, &slope1, &slope2}) column->resize(n);
}

AngularSlopes::AngularSlopes(const Rubber& rubber, std::vector<ModulusFactors> factors)
    : rubber_(rubber), factors_(std::move(factors)) {}

void AngularSlopes::operator()(std::span<const double> w, AngularColumns& result) {
  if (const auto* curve = std::get_if<MasterCurve>(&rubber_))
    of_curve(*curve, w, result);
  else
    of_series(w, true, result);
}

void AngularSlopes::values(std::span<const double> w, AngularColumns& result) {
  const auto* const curve = std::get_if<MasterCurve>(&rubber_);
  if (!curve) return of_series(w, false, result);
  result.resize(w.size());
  held_.assign(w.begin(), w.end());
  for (double& one : held_) one = std::clamp(one, curve->lowest_frequency(), curve->highest_frequency());
  (void)curve->angular_integrals(held_, result.i1, result.i2);
  if (factors_.empty()) return;
  of_loss_.resize(w.size());
  curve->loss_part(held_, of_loss_);
  soften(factors_, of_loss_, result.i1, result.i2, {});
}

/// The loops take a multiple of `lanes`.
void AngularSlopes::of_series(std::span<const double> w, bool sloped, AngularColumns& result) {
  const auto& series = std::get<PronySeries>(rubber_);
  const std::size_t n = w.size(), padded = (n + lanes - 1) / lanes * lanes;
  held_.assign(w.begin(), w.end());
  held_.resize(padded, 1.0);
  result.resize(padded);
  const PronyTerms terms{series.moduli().data(), series.weights().data(), series.relaxation_times().data(),
                         series.moduli().size(), series.equilibrium_modulus()};
  double *const i1 = result.i1.data(), *const i2 = result.i2.data();
  if (sloped)
    kernels().prony_slopes(terms, held_.data(), padded, i1, i2, result.slope1.data(), result.slope2.data());
  else
    kernels().prony(terms, held_.data(), padded, i1, i2);
  result.resize(n);
  if (factors_.empty()) return;
  for (auto* const row : {&of_loss_, &loss_slope_}) row->resize(n);
  loss_part(series, w, of_loss_, sloped ? std::span<double>(loss_slope_) : std::span<double>());
  if (sloped) soften(factors_, loss_slope_, result.slope1, result.slope2, {});
  soften(factors_, of_loss_, result.i1, result.i2, {});
}

void AngularSlopes::of_curve(const MasterCurve& curve, std::span<const double> w, AngularColumns& result) {
  constexpr double step = 1e-4;  // in ln w: errors of 1e-9 by the step and 1e-8 by the table's 1e-12
  const std::size_t n = w.size();
  result.resize(n);
  const double lowest = curve.lowest_frequency(), highest = curve.highest_frequency();
  const auto inside = [&](double at) { return std::clamp(at, lowest, highest); };
  for (const std::size_t side : {0, 1}) {
    for (auto* column : {&around_[side], &i1_[side], &i2_[side]}) column->resize(n);
    const double factor = side == 0 ? 1 - step : 1 + step;
    for (std::size_t i = 0; i < n; ++i) around_[side][i] = inside(w[i] * factor);
    (void)curve.angular_integrals(around_[side], i1_[side], i2_[side]);
  }
  std::vector<double> held(n);
  for (std::size_t i = 0; i < n; ++i) held[i] = inside(w[i]);
  (void)curve.angular_integrals(held, result.i1, result.i2);
  for (std::size_t i = 0; i < n; ++i) {
    const double apart = std::log(around_[1][i] / around_[0][i]);
    const bool known = w[i] >= lowest && w[i] <= highest;
    result.slope1[i] = known ? (i1_[1][i] - i1_[0][i]) / apart : 0;
    result.slope2[i] = known ? (i2_[1][i] - i2_[0][i]) / apart : 0;
  }
  if (factors_.empty()) return;
  for (const std::size_t side : {0, 1}) curve.loss_part(around_[side], i2_[side]);
  loss_slope_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool known = w[i] >= lowest && w[i] <= highest;
    loss_slope_[i] = known ? (i2_[1][i] - i2_[0][i]) / std::log(around_[1][i] / around_[0][i]) : 0;
  }
  of_loss_.resize(n);
  curve.loss_part(held, of_loss_);
  soften(factors_, loss_slope_, result.slope1, result.slope2, {});
  soften(factors_, of_loss_, result.i1, result.i2, {});
}

}  // namespace asperity
