// The generalised Maxwell model, E(w) = E_inf + sum_k E_k i w tau_k / (1 + i w tau_k), and its angular integrals in
// closed form. A series that was fitted tells which parts of them come from beyond the frequencies it was fitted on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "asperity/rubber.hpp"
#include "numerics/arguments.hpp"
#include "numerics/kernels.hpp"
#include "numerics/rounding.hpp"
#include "rubber/angular_harmonics.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

using std::numbers::pi;

PronySeries::PronySeries(double equilibrium_modulus, std::vector<double> moduli, std::vector<double> relaxation_times)
    : equilibrium_(equilibrium_modulus), moduli_(std::move(moduli)), times_(std::move(relaxation_times)) {
  require_not_negative("equilibrium_modulus", equilibrium_);
  require_same_size("moduli", moduli_.size(), "relaxation_times", times_.size());
  require_each_positive("moduli", moduli_);
  require_each_positive("relaxation_times", times_);
  if (moduli_.empty() && equilibrium_ == 0) refuse("equilibrium_modulus", 0, "positive where there are no moduli");
  longest_ = times_.empty() ? 0 : std::ranges::max(times_);
  const double glassy = std::accumulate(moduli_.begin(), moduli_.end(), equilibrium_);
  if (!(glassy >= 1e-140 && glassy <= 1e140))
    refuse(moduli_.empty() ? Sentence{argument("equilibrium_modulus")}
                           : argument("moduli") + ": their sum with " + argument("equilibrium_modulus"),
           glassy, "in [1e-140, 1e140] Pa, so that its square is in the range of a double");
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    double sum = equilibrium_;
    // tau_l / (tau_k + tau_l) as 1 / (1 + tau_k / tau_l): no overflow for far modes
    for (std::size_t l = 0; l < moduli_.size(); ++l) sum += moduli_[l] / (1 + times_[k] / times_[l]);
    weights_.push_back(2 * moduli_[k] * sum);
  }
}

std::complex<double> PronySeries::modulus(double w) const {
  require_not_negative("angular_frequency", w);
  check_fitted(w);
  double storage = equilibrium_, loss = 0;
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    // x^2 / (1 + x^2) and x / (1 + x^2) in the form that neither overflows nor cancels for any x
    const double x = w * times_[k];
    if (x < 1) {
      storage += moduli_[k] * x * x / (1 + x * x);
      loss += moduli_[k] * x / (1 + x * x);
    } else {
      const double inverse = 1 / x;
      storage += moduli_[k] / (1 + inverse * inverse);
      loss += moduli_[k] * inverse / (1 + inverse * inverse);
    }
  }
  return {storage, loss};
}

// With x_k = (w tau_k)^2, r_k = sqrt(1 + x_k), s_k = 1 - 1 / r_k = x_k / (r_k (r_k + 1)):
//   I1 = 2 pi sum_k E_k s_k / (w tau_k),   I2 = 2 pi (E_inf^2 + sum_k w_k s_k).
// All terms are positive and s_k in its second form does not cancel.
AngularIntegrals PronySeries::angular_integrals(double w) const {
  check_frequency(w);
  check_fitted(w);
  double i1 = 0, i2 = equilibrium_ * equilibrium_;
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    const double t = w * times_[k];
    const double r = t < largest_x ? std::sqrt(1 + t * t) : t;
    const double s_over_t = (t / r) / (r + 1);
    i1 += moduli_[k] * s_over_t;
    i2 += weights_[k] * t * s_over_t;
  }
  return outside(w, {2 * pi * i1, 2 * pi * i2});
}

// With t = w tau_k, r = sqrt(1 + t^2) and sin(psi) = w_low / w, the part of a term below w_low is 4 E_k g in I1 and
// 4 w_k t g in I2,
//   g = int_0^psi t sin^2 / (1 + t^2 sin^2) = {psi - atan(r tan psi) / r} / t,
// here with the difference of arctangents as one. What lies beyond w_high is the whole less what lies below it.
AngularIntegrals PronySeries::outside(double w, const AngularIntegrals& whole) const {
  if (!fit_) return whole;
  AngularIntegrals result = whole;
  const auto below = [&](double end) {
    const double sine = end / w, psi = std::asin(sine), cosine = std::sqrt((1 - sine) * (1 + sine));
    AngularIntegrals sum{0, psi * equilibrium_ * equilibrium_};
    for (std::size_t k = 0; k < moduli_.size(); ++k) {
      const double t = w * times_[k];
      if (t < 1 / largest_x) continue;
      const double r = t < largest_x ? std::sqrt(1 + t * t) : t, a = t / (r + 1);
      const double g = a / r * psi - std::atan(t * a * sine * cosine / (cosine * cosine + r * sine * sine)) / r / t;
      sum.i1 += moduli_[k] * g;
      sum.i2 += weights_[k] * t * g;
    }
    return sum;
  };
  if (w <= fit_->range.lowest) {
    result.i1_outside = whole.i1;
    result.i2_outside = whole.i2;
    return result;
  }
  const AngularIntegrals low = below(fit_->range.lowest);
  result.i1_outside = 4 * low.i1;
  result.i2_outside = 4 * low.i2;
  if (w > fit_->range.highest) {
    const AngularIntegrals high = below(fit_->range.highest);
    result.i1_outside += std::fmax(0, whole.i1 - 4 * high.i1);
    result.i2_outside += std::fmax(0, whole.i2 - 4 * high.i2);
  }
  return result;
}

// Beyond 1e300 w tau itself overflows.
void PronySeries::check_frequency(double w) const {
  require_not_negative("angular_frequency", w);
  if (!(w * longest_ < 1e300))
    refuse("angular_frequency", w, "below 1e300 / relaxation_times, " + show(1e300 / longest_) + " rad/s");
}

void PronySeries::check_fitted(double w) const {
  if (!fit_ || fit_->extrapolated) return;
  const auto [lowest, highest] = fit_->range;
  if (is_within(w, lowest, highest)) return;
  const ShownRange known(lowest, highest);
  throw OutOfRange(argument("angular_frequency") + " = " + known.value(w) + " rad/s: the Prony series was fitted on " +
                   known.text() + " rad/s; " + advice("extrapolate-series", "extrapolation=\"prony\" of fit_prony") +
                   " goes on beyond them");
}

bool PronySeries::angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                    std::span<double> i1_outside) const {
  require_room(w, i1, i2);
  if (!i1_outside.empty()) require_same_size("i1_outside", i1_outside.size(), "angular_frequency", w.size());
  const std::size_t n = w.size();
  const double fastest = n == 0 ? 0 : std::ranges::max(w);
  const bool limited = fit_ && !fit_->extrapolated;
  const double lowest = limited ? fit_->range.lowest : 0, highest = limited ? fit_->range.highest : HUGE_VAL;
  std::size_t known = 0;
  for (const double one : w) known += static_cast<std::size_t>((one >= lowest) & (one <= highest));
  for (std::size_t i = 0; known < n && i < n; ++i) {
    require_not_negative("angular_frequency", w[i]);
    check_fitted(w[i]);
  }
  check_frequency(fastest);
  // in lanes but for a rest, and for frequencies whose squares overflow
  const std::size_t whole = fastest * longest_ < largest_x ? n - n % lanes : 0;
  kernels().prony({moduli_.data(), weights_.data(), times_.data(), moduli_.size(), equilibrium_}, w.data(), whole,
                  i1.data(), i2.data());
  for (std::size_t i = whole; i < n; ++i) {
    const AngularIntegrals one = angular_integrals(w[i]);
    i1[i] = one.i1;
    i2[i] = one.i2;
  }
  return outside(w, i1, i2, i1_outside);
}

bool PronySeries::outside(std::span<const double> w, std::span<const double> i1, std::span<const double> i2,
                          std::span<double> i1_outside) const {
  if (!fit_) return false;
  bool any = false;
  for (std::size_t i = 0; i < w.size(); ++i) {
    // int_0^psi 4 sin E''(w sin) <= 4 (1 - cos psi) E''_max, and 1 - cos psi <= 0.51 sin^2 psi up to 0.2
    const double sine = fit_->range.lowest / w[i];
    double outside_i = 0;
    if (!(sine < 0.2 && 2.1 * sine * sine * fit_->loss_below <= AngularTable::least_outside * i1[i]) ||
        w[i] > fit_->range.highest)
      outside_i = outside(w[i], {i1[i], i2[i]}).i1_outside;
    if (!i1_outside.empty()) i1_outside[i] = outside_i;
    any |= outside_i > AngularTable::least_outside * i1[i];
  }
  return any;
}

bool PronySeries::angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                    std::span<double> i1_outside, std::span<double> loss,
                                    std::span<double> square) const {
  const std::size_t count = harmonics_in(w, loss, square);
  if (count == 0) return angular_integrals(w, i1, i2, i1_outside);
  require_room(w, i1, i2);
  for (const double one : w) {
    require_not_negative("angular_frequency", one);
    check_fitted(one);
  }
  const double fastest = longest_ > 0 ? largest_x / longest_ : std::numeric_limits<double>::max();
  const PronyTerms terms{moduli_.data(), weights_.data(), times_.data(), moduli_.size(), equilibrium_};
  const std::size_t n = w.size(), whole = std::ranges::max(w) < fastest ? n - n % lanes : 0;
  kernels().prony_harmonics(terms, w.data(), whole, n, count, i1.data(), i2.data(), loss.data(), square.data());
  std::vector<double> rows(whole < n ? 2 * count * lanes : 0);
  for (std::size_t i = whole; i < n; i += lanes) {  // a rest, and frequencies whose squares overflow
    double at[lanes], of_i1[lanes], of_i2[lanes];
    for (std::size_t k = 0; k < lanes; ++k) at[k] = std::fmin(w[std::min(i + k, n - 1)], fastest);
    kernels().prony_harmonics(terms, at, lanes, lanes, count, of_i1, of_i2, rows.data(), rows.data() + count * lanes);
    for (std::size_t k = 0; k < std::min(lanes, n - i); ++k) {
      const AngularIntegrals here =
          w[i + k] > fastest ? angular_integrals(w[i + k]) : AngularIntegrals{of_i1[k], of_i2[k]};
      i1[i + k] = here.i1;
      i2[i + k] = here.i2;
      for (std::size_t j = 0; j < count; ++j) {
        loss[j * n + i + k] = rows[j * lanes + k];
        square[j * n + i + k] = rows[(count + j) * lanes + k];
      }
    }
  }
  return outside(w, i1, i2, i1_outside);
}

PronySeries PronySeries::shifted(double a_T) const {
  require_positive("a_T", a_T);
  std::vector<double> times = times_;
  for (double& tau : times) tau *= a_T;
  PronySeries result(equilibrium_, moduli_, std::move(times));
  return fit_ ? result.fitted_on({fit_->range.lowest / a_T, fit_->range.highest / a_T}, fit_->extrapolated) : result;
}

PronySeries PronySeries::fitted_on(const FrequencyRange& frequencies, bool extrapolated) const {
  require_positive("lowest frequency", frequencies.lowest);
  require_positive("highest frequency", frequencies.highest);
  if (!(frequencies.lowest < frequencies.highest))
    refuse("highest frequency", frequencies.highest, "above the lowest, " + show(frequencies.lowest) + " rad/s");
  Fit fit{frequencies, extrapolated, 0};
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    const double x = std::fmin(1, frequencies.lowest * times_[k]);  // E'' of a term is largest where w tau is 1
    fit.loss_below += moduli_[k] * x / (1 + x * x);
  }
  PronySeries result = *this;
  result.fit_ = fit;
  return result;
}

std::optional<FrequencyRange> PronySeries::fitted_range() const {
  if (!fit_) return std::nullopt;
  return fit_->range;
}

std::optional<FrequencyRange> known_range(const Rubber& rubber) {
  if (const auto* series = std::get_if<PronySeries>(&rubber))
    return series->extrapolated() ? std::nullopt : series->fitted_range();
  const auto& curve = std::get<MasterCurve>(rubber);
  return FrequencyRange{curve.lowest_frequency(), curve.highest_frequency()};
}

std::complex<double> modulus(const Rubber& rubber, double angular_frequency) {
  return std::visit([&](const auto& r) { return r.modulus(angular_frequency); }, rubber);
}

AngularIntegrals angular_integrals(const Rubber& rubber, double angular_frequency) {
  return std::visit([&](const auto& r) { return r.angular_integrals(angular_frequency); }, rubber);
}

AngularHarmonics angular_harmonics(const Rubber& rubber, std::span<const double> angular_frequency, std::size_t count) {
  const std::size_t n = angular_frequency.size();
  AngularHarmonics result{std::vector<double>((count + 1) * n), std::vector<double>((count + 1) * n)};
  const std::span<double> loss(result.loss), square(result.square);
  std::visit(
      [&](const auto& r) {
        (void)r.angular_integrals(angular_frequency, loss.first(n), square.first(n), {}, loss.subspan(n),
                                  square.subspan(n));
        (void)r.angular_integrals(angular_frequency, loss.first(n), square.first(n));  // bit by bit
      },
      rubber);
  return result;
}

bool angular_integrals(const Rubber& rubber, std::span<const double> angular_frequency, std::span<double> i1,
                       std::span<double> i2, std::span<double> i1_outside, std::span<double> loss,
                       std::span<double> square) {
  return std::visit(
      [&](const auto& r) { return r.angular_integrals(angular_frequency, i1, i2, i1_outside, loss, square); }, rubber);
}

double effective_modulus(double modulus, double poisson_ratio, double modulus_2, double poisson_ratio_2) {
  require_positive("modulus", modulus);
  require_poisson("poisson_ratio", poisson_ratio);
  require_poisson("poisson_ratio_2", poisson_ratio_2);
  if (!(modulus_2 > 0)) refuse("modulus_2", modulus_2, "positive (infinite for a rigid body)");
  return 1 / ((1 - poisson_ratio * poisson_ratio) / modulus + (1 - poisson_ratio_2 * poisson_ratio_2) / modulus_2);
}

}  // namespace asperity
