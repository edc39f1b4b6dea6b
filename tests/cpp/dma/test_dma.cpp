#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/dma.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

constexpr double t_ref = 293.15;

/// Like SBR: a glass transition (Cole-Cole), a slow process, an equilibrium modulus.
std::complex<double> true_modulus(double w) {
  const std::complex<double> iw(0, w);
  return 3e6 + 2e9 / (1.0 + std::pow(iw * 1e-7, -0.45)) + 5e6 / (1.0 + std::pow(iw * 1e-2, -0.3));
}
double true_shift(double t) { return -8.86 * (t - t_ref) / (101.6 + t - t_ref); }

/// 22 isotherms of 16 frequencies from 0.1 to 30 Hz, -30 to 75 C.
std::vector<Isotherm> sweeps() {
  std::vector<Isotherm> result;
  for (int k = 0; k < 22; ++k) {
    const double t = 243.15 + 5 * k;
    std::vector<double> w, storage, loss;
    for (int i = 0; i < 16; ++i) {
      w.push_back(2 * std::numbers::pi * 0.1 * std::pow(300, i / 15.0));
      const auto modulus = true_modulus(w.back() * std::pow(10, true_shift(t)));
      storage.push_back(modulus.real());
      loss.push_back(modulus.imag());
    }
    result.emplace_back(t, w, storage, loss);
  }
  return result;
}

ShiftTable table() {
  std::vector<double> t, a;
  for (double at = 243.15; at < 349; at += 5) {
    t.push_back(at);
    a.push_back(true_shift(at));
  }
  return {t_ref, t, a};
}

}  // namespace

TEST_CASE("shift factors of a synthetic rubber, and its modulus from a Prony series") {
  const std::vector<Isotherm> isotherms = sweeps();
  const MasterCurveBuild build = build_master_curve(isotherms, {.reference_temperature = t_ref});
  REQUIRE(build.shifts.temperature().size() == 22);
  for (std::size_t i = 0; i < 22; ++i)
    CHECK_NEAR(build.shifts.log10_a_T()[i], true_shift(build.shifts.temperature()[i]), 1e-3, 1);
  CHECK(build.points.size() == 22 * 16);
  CHECK(build.residual < 1e-4);
  REQUIRE(build.master_curve.shifts());
  CHECK(build.master_curve.shifts()->log10_a_T() == build.shifts.log10_a_T());
  CHECK_THROWS_AS((void)build.shifts.shift_factor(243), OutOfRange);

  const MasterCurve& curve = build.master_curve;
  const PronyFit fit = fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus());
  CHECK(fit.causal);
  for (const MasterPoint& point : build.points) {
    const auto found = fit.series.modulus(point.angular_frequency), truth = true_modulus(point.angular_frequency);
    CHECK_NEAR(found.real(), truth.real(), 0.01, 0);
    CHECK_NEAR(found.imag(), truth.imag(), 0.02, 0);
  }
  CHECK(fit.series.fitted_range() ==
        FrequencyRange{curve.angular_frequency().front(), curve.angular_frequency().back()});
  CHECK_FALSE(fit.series.extrapolated());
  CHECK(fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus(), {.extrapolated = true})
            .series.extrapolated());
  const PronyFit swapped = fit_prony(curve.angular_frequency(), curve.loss_modulus(), curve.storage_modulus());
  CHECK_FALSE(swapped.causal);
  REQUIRE(swapped.notes.size() == 1);
}

TEST_CASE("at a large strain either modulus takes its own ratio, held beyond the sweeps") {
  std::vector<double> w, storage, loss;
  for (int i = 0; i <= 60; ++i) {
    w.push_back(1e-2 * std::pow(10, i / 6.0));
    storage.push_back(true_modulus(w.back()).real());
    loss.push_back(true_modulus(w.back()).imag());
  }
  const MasterCurve small(w, storage, loss);
  // ln of the ratios straight in ln w and in ln strain, as the interpolant has it
  const auto ratio = [](double at, double strain, double c, double slope) {
    return std::exp((c + slope * std::log(at)) * std::log(strain / 0.005));
  };
  const ShiftTable shifts = table();
  std::vector<StrainSweep> strain_sweeps;
  for (const double t : shifts.temperature()) {
    const double at = 60 * std::pow(10, true_shift(t));
    const std::vector<double> strain{1e-3, 4e-3, 0.02, 0.3, 0.9};
    std::vector<double> s, l;
    for (const double e : strain) {
      s.push_back(true_modulus(at).real() * ratio(at, e, -0.2, 0.004));
      l.push_back(true_modulus(at).imag() * ratio(at, e, -0.1, -0.002));
    }
    strain_sweeps.emplace_back(t, 60, strain, s, l);
  }
  const double lowest = 60 * std::pow(10, true_shift(348.15)), highest = 60 * std::pow(10, true_shift(243.15));
  const LargeStrain large = at_strain(small, shifts, 0.5, strain_sweeps);
  CHECK(large.notes.size() == 1);
  for (std::size_t i = 0; i < w.size(); ++i) {
    CAPTURE(w[i]);
    const double held = std::fmin(std::fmax(w[i], lowest), highest);
    const auto found = large.master_curve.modulus(w[i]);
    CHECK_NEAR(found.real(), storage[i] * ratio(held, 0.5, -0.2, 0.004), 1e-9, 0);
    CHECK_NEAR(found.imag(), loss[i] * ratio(held, 0.5, -0.1, -0.002), 1e-9, 0);
  }
  CHECK_THROWS_AS((void)at_strain(small, shifts, 0.95, strain_sweeps), OutOfRange);
  CHECK_THROWS_AS((void)at_strain(small, shifts, 0.5, {}), InvalidInput);
}
