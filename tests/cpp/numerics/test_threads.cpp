#include <doctest/doctest.h>

#include <cmath>
#include <latch>
#include <thread>
#include <vector>

#include "asperity/friction.hpp"
#include "numerics/libraries.hpp"

using namespace asperity;

namespace {

constexpr std::size_t many = 80;

MasterCurve master_curve() {
  std::vector<double> w, storage, loss;
  for (double x = -3; x < 7; x += 0.5) {
    w.push_back(std::pow(10, x));
    storage.push_back(1e6 * std::pow(10, 0.2 * (x + 3)));
    loss.push_back(2e5 * std::pow(10, 0.2 * (x + 3)));
  }
  return {w, storage, loss};
}

const SelfAffineSpectrum road{.rms_height = 50e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e5};
const PronySeries series(2e6, {1e9, 1e8, 1e7}, {1e-8, 1e-6, 1e-4});

/// What `many` threads that start together get from work(thread).
template <class Work>
std::vector<double> together(Work work) {
  std::vector<double> result(many);
  std::latch start(many);
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < many; ++i)
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      result[i] = work(i);
    });
  threads.clear();
  return result;
}

double mu(const Rubber& rubber, const Conditions& conditions) {
  const double velocity = 1e-3;
  return friction(road, rubber, conditions, std::span(&velocity, 1)).mu[0];
}

}  // namespace

// First, while no table of this process has been made: that of P, of the rules, of the kernels.
TEST_CASE("80 threads make the tables of a process and of a master curve at once") {
  const MasterCurve rubber = master_curve();  // its pieces are made by whichever thread comes first
  const std::vector<double> found = together([&](std::size_t) { return mu(rubber, {.pressure = 1e5}); });
  for (const double each : found) CHECK(each == found[0]);
  CHECK(found[0] == mu(master_curve(), {.pressure = 1e5}));
}

TEST_CASE("80 threads with corrections, forms and methods of their own get what each gets alone") {
  const MasterCurve rubber = master_curve();
  const std::vector<double> peaks{2e-4, 1e-4, 5e-5};
  const auto conditions = [&](std::size_t i) {
    Conditions c{.pressure = 1e5, .adhesion = Adhesion{.shear_stress = 5e6}};
    c.form = i % 2 ? Form::exact : Form::interpolated;
    c.rtol = i % 3 ? 1e-6 : 1e-9;
    c.method = has_gsl_and_fftw && i % 20 == 19 ? Method::qag : Method::gauss;
    const Correction corrections[] = {NoCorrection{},
                                      SFactor{.applies_to = SFactor::AppliesTo::both},
                                      NayakSFactor{},
                                      AffineShift{2},
                                      LocalPeaks{.heights = peaks},
                                      GreenwoodWilliamson{.z_max = 2e-4, .z_min = -2e-4}};
    c.correction = corrections[i % 6];
    return c;
  };
  const auto one = [&](std::size_t i) { return i % 4 ? mu(series, conditions(i)) : mu(rubber, conditions(i)); };
  const std::vector<double> found = together(one);
  for (std::size_t i = 0; i < many; ++i) CHECK(found[i] == one(i));
}

TEST_CASE("transforms of many sizes are planned at once") {
  const auto first_density = [](std::size_t i) {
    const HeightMap map = synthesize(road, {64 + i % 16, 64}, {2e-5, 2e-5}, i);
    return power_spectrum(map).density()[0];
  };
  const std::vector<double> found = together(first_density);
  for (std::size_t i = 0; i < many; ++i) CHECK(found[i] == first_density(i));
}

TEST_CASE("an error in one thread leaves the others alone") {
  const std::vector<double> found = together([](std::size_t i) {
    try {
      return mu(series, {.pressure = i % 2 ? 1e5 : -1.0});
    } catch (const InvalidInput&) {
      return -1.0;
    }
  });
  for (std::size_t i = 0; i < many; ++i) CHECK(found[i] == (i % 2 ? found[1] : -1.0));
  CHECK(found[1] > 0);
}
