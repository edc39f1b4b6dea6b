// With x_k = (w tau_k)^2 and r_k = sqrt(1 + x_k), the integrals of a Prony series are I1 = 2 pi sum_k E_k s_k / (w
// tau_k) and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), s_k = 1 - 1 / r_k, and ds_k/dln w = x_k / r_k^3. Those of a master
// curve are differentiated by central differences. Of harmonics F_n = int cos(n phi) f(w cos phi) dphi slopes follow
// from those before: dF_n+2/dln w = dF_n/dln w - n F_n - (n + 2) F_n+2.
#include "heat/angular_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/kernels.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

void AngularColumns::resize(std::size_t n) {
  for (auto* column : {&i1, &i2, &slope1, &slope2}) column->resize(n);
}

AngularSlopes::AngularSlopes(const Rubber& rubber, std::vector<ModulusFactors> factors, Rings rings)
    : rubber_(unlimited(rubber).value_or(rubber)), factors_(std::move(factors)), rings_(std::move(rings)) {}

void AngularSlopes::operator()(FeltModulus& felt) {
  constexpr double apart = 0.02;  // of ln w
  const bool measured = std::holds_alternative<MasterCurve>(rubber_);
  if (measured) solve(felt.frequency, true, felt.columns, apart);
  solve(felt.frequency, true, measured ? felt.beside : felt.columns);
  take_rows(felt);
}

void AngularSlopes::operator()(FeltModulus& felt, const PanelSlopes* panels, double velocity) {
  panels_ = panels;
  velocity_ = velocity;
  solve(felt.frequency, true, felt.columns);
  panels_ = nullptr;
  take_rows(felt);
}

void AngularSlopes::take_rows(FeltModulus& felt) const {
  const auto n = std::ssize(felt.frequency), parted = factors_.empty() ? 0 : n;
  felt.loss_part.assign(of_loss_.begin(), of_loss_.begin() + parted);
  if (harmonics_ == 0) return;
  felt.loss_rows = whole_;
  felt.loss_rows.insert(felt.loss_rows.end(), loss_.begin(), loss_.end());
  felt.square_rows = square_;
  felt.loss_part_rows.assign(of_loss_.begin() + parted, of_loss_.end());
}

void AngularSlopes::solve(std::span<const double> w, bool sloped, AngularColumns& result, double step) {
  const std::size_t n = w.size();
  if (!factors_.empty()) {
    of_loss_.resize((harmonics_ + 1) * n);
    loss_slope_.resize(n);
  }
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber_))
    of_curve(*curve, w, sloped, step, result);
  else
    of_series(w, sloped, result);
  result.across.assign(rings_.count > 0 ? n : 0, 0.0);
  if (harmonics_ > 0) add_rings(w, sloped, result);
  if (factors_.empty()) return;
  const auto of_loss = std::span(of_loss_).first(n);
  if (sloped) soften(factors_, loss_slope_, result.slope1, result.slope2, {});
  soften(factors_, of_loss, result.i1, result.i2, {});
  for (std::size_t i = 0; i < result.across.size(); ++i) result.across[i] *= factors_[i].loss;
}

/// `held_` has the frequencies as the rubber knows them; where they are not those of `w`, nothing changes with these.
void AngularSlopes::add_rings(std::span<const double> w, bool sloped, AngularColumns& result) {
  const std::size_t n = w.size(), rows = harmonics_;
  for (auto* const row : {&loss_, &square_, &slopes_}) row->resize(rows * n);
  whole_.assign(result.i1.begin(), result.i1.begin() + static_cast<std::ptrdiff_t>(n));
  const std::span<const double> at(held_.data(), n);
  for (auto* const row : {&i1_[0], &i2_[0]}) row->resize(n);
  (void)angular_integrals(rubber_, at, i1_[0], i2_[0], {}, loss_, square_);
  // `order`: n of the row before the first
  const auto take_slopes = [&](std::span<const double> first, std::span<const double> slope,
                               std::span<const double> others, std::size_t order) {
    for (std::size_t m = 0; m < rows; ++m) {
      const double before = static_cast<double>(order + 2 * m);
      const double *const value = m == 0 ? first.data() : &others[(m - 1) * n], *const rise =
                                                                                    m == 0 ? slope.data()
                                                                                           : &slopes_[(m - 1) * n];
      for (std::size_t i = 0; i < n; ++i)
        slopes_[m * n + i] = at[i] == w[i] ? rise[i] - before * value[i] - (before + 2) * others[m * n + i] : 0;
    }
  };
  const auto of_loss = std::span(of_loss_), of_loss_rows = of_loss.subspan(of_loss.empty() ? 0 : n);
  if (sloped) {
    take_slopes(result.i1, result.slope1, loss_, 1);
    add_directions(rings_, {rows, n, slopes_, {}}, result.slope1, {});
    take_slopes(result.i2, result.slope2, square_, 0);
    add_directions(rings_, {rows, n, {}, slopes_}, result.slope2);
    if (!of_loss.empty()) {
      take_slopes(of_loss.first(n), loss_slope_, of_loss_rows, 0);
      add_directions(rings_, {rows, n, {}, slopes_}, loss_slope_);
    }
  }
  add_directions(rings_, {rows, n, loss_, {}}, result.i1, result.across);
  add_directions(rings_, {rows, n, {}, square_}, result.i2);
  if (!of_loss.empty()) add_directions(rings_, {rows, n, {}, of_loss_rows}, of_loss.first(n));
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
  if (!factors_.empty()) loss_part(series, w, of_loss_, sloped ? std::span<double>(loss_slope_) : std::span<double>());
}

void AngularSlopes::of_curve(const MasterCurve& curve, std::span<const double> w, bool sloped, double step,
                             AngularColumns& result) {
  const std::size_t n = w.size();
  result.resize(n);
  const double lowest = curve.lowest_frequency(), highest = curve.highest_frequency();
  const auto inside = [&](double at) { return std::clamp(at, lowest, highest); };
  held_.resize(n);
  for (std::size_t i = 0; i < n; ++i) held_[i] = inside(w[i]);
  (void)curve.angular_integrals(held_, result.i1, result.i2);
  if (!factors_.empty()) curve.loss_part(held_, of_loss_);
  if (!sloped) return;
  if (panels_) {
    on_panels(curve, result);
    return;
  }
  for (const std::size_t side : {0, 1}) {
    for (auto* column : {&around_[side], &i1_[side], &i2_[side]}) column->resize(n);
    const double factor = std::exp(side == 0 ? -step : step);
    for (std::size_t i = 0; i < n; ++i) around_[side][i] = inside(w[i] * factor);
    (void)curve.angular_integrals(around_[side], i1_[side], i2_[side]);
  }
  const auto difference = [&](const std::vector<double>(&values)[2], std::vector<double>& slope) {
    for (std::size_t i = 0; i < n; ++i)
      slope[i] = held_[i] == w[i] ? (values[1][i] - values[0][i]) / std::log(around_[1][i] / around_[0][i]) : 0;
  };
  difference(i1_, result.slope1);
  difference(i2_, result.slope2);
  if (factors_.empty()) return;
  for (const std::size_t side : {0, 1}) curve.loss_part(around_[side], i2_[side]);
  difference(i2_, loss_slope_);
}

void AngularSlopes::on_panels(const MasterCurve& curve, AngularColumns& result) {
  std::vector<double>&at = around_[0], &i1 = i1_[0], &i2 = i2_[0];
  at.clear();
  for (const double q : panels_->wavenumber())
    at.push_back(std::clamp(velocity_ * q, curve.lowest_frequency(), curve.highest_frequency()));
  for (auto* const column : {&i1, &i2}) column->resize(at.size());
  (void)curve.angular_integrals(at, i1, i2);
  (*panels_)(result.i1, i1, result.slope1);
  (*panels_)(result.i2, i2, result.slope2);
  if (factors_.empty()) return;
  curve.loss_part(at, i2);
  (*panels_)(of_loss_, i2, loss_slope_);
}

}  // namespace asperity
