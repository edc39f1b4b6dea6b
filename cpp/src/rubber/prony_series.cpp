#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "asperity/rubber.hpp"
#include "numerics/arguments.hpp"
#include "numerics/kernels.hpp"

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
    refuse(moduli_.empty() ? "equilibrium_modulus" : "moduli: their sum with equilibrium_modulus", glassy,
           "in [1e-140, 1e140] Pa, so that its square can be told");
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    double sum = equilibrium_;
    // tau_l / (tau_k + tau_l) as 1 / (1 + tau_k / tau_l): no overflow for far modes
    for (std::size_t l = 0; l < moduli_.size(); ++l) sum += moduli_[l] / (1 + times_[k] / times_[l]);
    weights_.push_back(2 * moduli_[k] * sum);
  }
}

std::complex<double> PronySeries::modulus(double w) const {
  require_not_negative("angular_frequency", w);
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
  double i1 = 0, i2 = equilibrium_ * equilibrium_;
  for (std::size_t k = 0; k < moduli_.size(); ++k) {
    const double t = w * times_[k];
    const double r = t < 1e150 ? std::sqrt(1 + t * t) : t;
    const double s_over_t = (t / r) / (r + 1);
    i1 += moduli_[k] * s_over_t;
    i2 += weights_[k] * t * s_over_t;
  }
  return {2 * pi * i1, 2 * pi * i2};
}

// Beyond 1e300 w tau itself overflows.
void PronySeries::check_frequency(double w) const {
  require_not_negative("angular_frequency", w);
  if (!(w * longest_ < 1e300))
    refuse("angular_frequency", w, "below 1e300 / relaxation_times, " + show(1e300 / longest_) + " rad/s");
}

void PronySeries::angular_integrals(std::span<const double> w, double* i1, double* i2) const {
  const std::size_t n = w.size();
  const double fastest = n == 0 ? 0 : *std::ranges::max_element(w);
  for (const double one : w) require_not_negative("angular_frequency", one);
  check_frequency(fastest);
  if (n % lanes != 0 || !(fastest * longest_ < 1e150)) {
    for (std::size_t i = 0; i < n; ++i) {
      const AngularIntegrals one = angular_integrals(w[i]);
      i1[i] = one.i1;
      i2[i] = one.i2;
    }
    return;
  }
  kernels().prony({moduli_.data(), weights_.data(), times_.data(), moduli_.size(), equilibrium_}, w.data(), n, i1, i2);
}

PronySeries PronySeries::shifted(double a_T) const {
  require_positive("a_T", a_T);
  std::vector<double> times = times_;
  for (double& tau : times) tau *= a_T;
  return {equilibrium_, moduli_, std::move(times)};
}

std::complex<double> modulus(const Rubber& rubber, double angular_frequency) {
  return std::visit([&](const auto& r) { return r.modulus(angular_frequency); }, rubber);
}

AngularIntegrals angular_integrals(const Rubber& rubber, double angular_frequency) {
  return std::visit([&](const auto& r) { return r.angular_integrals(angular_frequency); }, rubber);
}

bool angular_integrals(const Rubber& rubber, std::span<const double> angular_frequency, double* i1, double* i2,
                       double* i1_outside) {
  if (const auto* series = std::get_if<PronySeries>(&rubber)) {
    series->angular_integrals(angular_frequency, i1, i2);
    return false;
  }
  return std::get<MasterCurve>(rubber).angular_integrals(angular_frequency, i1, i2, i1_outside);
}

double effective_modulus(double modulus, double poisson_ratio, double modulus_2, double poisson_ratio_2) {
  require_positive("modulus", modulus);
  require_poisson("poisson_ratio", poisson_ratio);
  require_poisson("poisson_ratio_2", poisson_ratio_2);
  if (!(modulus_2 > 0)) refuse("modulus_2", modulus_2, "positive (infinite for a rigid body)");
  return 1 / ((1 - poisson_ratio * poisson_ratio) / modulus + (1 - poisson_ratio_2 * poisson_ratio_2) / modulus_2);
}

}  // namespace asperity
