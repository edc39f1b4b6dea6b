#include <algorithm>
#include <numeric>
#include <random>

#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 23340};
const PronySeries rubber(3e6, {1e7, 1e8, 1e9}, {1e-2, 1e-4, 1e-6});
const ContactModel model{.correction = AffineShift{2}};

std::vector<double> decades(double first, double last, std::size_t n) {
  std::vector<double> v(n);
  for (std::size_t i = 0; i < n; ++i)
    v[i] = std::pow(10, first + (last - first) * static_cast<double>(i) / static_cast<double>(n - 1));
  return v;
}

struct Points {
  std::vector<double> pressure, velocity, mu;
  double rtol = 1e-6;
  [[nodiscard]] AdhesionFit fit(const FixedAdhesion& fixed = {}) const {
    const ContactModel m{.correction = model.correction, .rtol = rtol};
    return fit_adhesion(road, rubber, m, pressure, velocity, mu, fixed);
  }
};

Points exact(const Adhesion& truth, std::vector<double> velocity, double pressure = 81e3) {
  const std::vector<double> p(velocity.size(), pressure);
  const Friction f = friction(road, rubber, model, truth, p, velocity);
  return {p, std::move(velocity), f.mu};
}

}  // namespace

TEST_CASE("noise of 5 % and a fifth of gross outliers: near the truth, by the errors that are stated") {
  constexpr int trials = 200;
  const Adhesion truth{8.3e6, 6e-3, 0.1};
  Points clean = exact(truth, decades(-6, 0, 40));
  clean.rtol = 1e-3;  // for speed
  for (const std::size_t outliers : {0, 8}) {
    CAPTURE(outliers);
    double squares[3] = {}, stated[3] = {};
    int near[4] = {};
    for (int trial = 0; trial < trials; ++trial) {
      std::mt19937_64 random(static_cast<std::uint64_t>(trial));
      std::normal_distribution<double> gauss;
      Points points = clean;
      for (double& mu : points.mu) mu *= 1 + 0.05 * gauss(random);
      std::vector<std::size_t> order(points.mu.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::shuffle(order, random);
      for (std::size_t i = 0; i < outliers; ++i) points.mu[order[i]] *= i % 2 ? 0.3 : 3;
      const AdhesionFit fit = points.fit(), narrow = points.fit({.width = 0.1});
      for (std::size_t i = 0; i < outliers; ++i) CHECK(fit.outliers[order[i]]);
      const double off[] = {std::log(fit.adhesion.shear_stress / truth.shear_stress),
                            std::log(fit.adhesion.reference_velocity / truth.reference_velocity),
                            fit.adhesion.width - truth.width};
      const double scale[] = {fit.adhesion.shear_stress, fit.adhesion.reference_velocity, 1};
      for (std::size_t k = 0; k < 3; ++k) {
        squares[k] += off[k] * off[k];
        stated[k] += fit.covariance[4 * k] / (scale[k] * scale[k]);
      }
      const auto close = [&](const Adhesion& a, std::size_t at) {
        near[at] += std::fabs(a.shear_stress / truth.shear_stress - 1) < 0.05;
        near[at + 1] += std::fabs(std::log10(a.reference_velocity / truth.reference_velocity)) < 0.1;
      };
      close(fit.adhesion, 0);
      close(narrow.adhesion, 2);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(k);
      // the ratio is known to 1 / sqrt(2 trials) = 5 %
      CHECK(std::sqrt(squares[k] / stated[k]) == doctest::Approx(1).epsilon(0.15));
    }
    // The best that any unbiased estimate can do with these points (Cramer and Rao) is 1.3 % and 0.061 decades, or
    // 0.031 with the width held: 100 %, 90 % and 99.9 % would be near; an outlier takes its information with it.
    CAPTURE(near[0]);
    CAPTURE(near[1]);
    CAPTURE(near[2]);
    CAPTURE(near[3]);
    CHECK(near[0] >= trials * 99 / 100);
    CHECK(near[1] >= trials * 80 / 100);
    CHECK(near[2] >= trials * 99 / 100);
    CHECK(near[3] >= trials * 97 / 100);
  }
}

TEST_CASE("units: pressures with moduli, velocities over relaxation times") {
  Points points = exact({8.3e6, 6e-3, 0.1}, decades(-5, -1, 16));
  for (std::size_t i = 0; i < points.mu.size(); ++i) points.mu[i] *= 1 + 0.05 * std::sin(7.0 * static_cast<double>(i));
  const AdhesionFit fit = points.fit();
  const double k = 3.7;
  const PronySeries stiff(3e6 * k, {1e7 * k, 1e8 * k, 1e9 * k}, {1e-2, 1e-4, 1e-6}), slow = rubber.shifted(k);
  std::vector<double> pressure = points.pressure, velocity = points.velocity;
  for (double& p : pressure) p *= k;
  for (double& v : velocity) v /= k;
  const AdhesionFit pressed = fit_adhesion(road, stiff, model, pressure, points.velocity, points.mu);
  const AdhesionFit slowed = fit_adhesion(road, slow, model, points.pressure, velocity, points.mu);
  // minima are found to about 1e-8 of a standard error, which is 0.1 of the values
  const double rtol = 1e-7;
  CHECK_NEAR(pressed.adhesion.shear_stress, k * fit.adhesion.shear_stress, rtol, 0);
  CHECK_NEAR(pressed.adhesion.reference_velocity, fit.adhesion.reference_velocity, rtol, 0);
  CHECK_NEAR(pressed.adhesion.width, fit.adhesion.width, rtol, 0);
  CHECK_NEAR(pressed.covariance[0], k * k * fit.covariance[0], rtol, 0);
  CHECK_NEAR(slowed.adhesion.shear_stress, fit.adhesion.shear_stress, rtol, 0);
  CHECK_NEAR(slowed.adhesion.reference_velocity * k, fit.adhesion.reference_velocity, rtol, 0);
  CHECK_NEAR(slowed.adhesion.width, fit.adhesion.width, rtol, 0);
}
