#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "asperity/friction.hpp"

using namespace asperity;

TEST_CASE("the same call from 16 threads gives the same digits") {
  const SelfAffineSpectrum road{.rms_height = 50e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e5};
  std::vector<double> w, storage, loss;
  for (double x = -3; x < 7; x += 0.5) {
    w.push_back(std::pow(10, x));
    storage.push_back(1e6 * std::pow(10, 0.2 * (x + 3)));
    loss.push_back(2e5 * std::pow(10, 0.2 * (x + 3)));
  }
  const MasterCurve rubber(w, storage, loss);  // its pieces are made by whichever thread comes first
  const double velocity = 1e-3;
  std::vector<double> mu(16);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < mu.size(); ++i)
      threads.emplace_back([&, i] {
        const HeightMap map = synthesize(road, {64 + i, 64}, {2e-5, 2e-5}, i);  // plans of many sizes at once
        (void)power_spectrum(map);
        mu[i] = friction(road, rubber, {.pressure = 1e5}, std::span(&velocity, 1)).mu[0];
      });
  }
  for (const double found : mu) CHECK(found == mu[0]);
}
