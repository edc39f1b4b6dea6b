#include <algorithm>
#include <numeric>

#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

TEST_CASE("contributions of PartialContact add up to the hysteresis, beyond the roughness too") {
  const SelfAffineSpectrum road{.rms_height = 100e-6, .hurst = 0.8, .q0 = 2000, .q1 = 1e5};
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const double velocity[] = {1e-4, 1.0};
  const Friction f =
      friction(road, rubber, {.pressure = 81e3, .correction = PartialContact{}, .contributions = true}, velocity);
  const Contributions& c = *f.contributions;
  const std::size_t m = c.decade_edges.size() - 1, n = c.wavenumber.size();
  // q_e by int ln q dm over the last tenth of m, m = q^power
  const double power = 4 - 2 * (0.8 + 1), most = std::pow(1e5, power);
  const double least = most - 0.1 * (most - std::pow(2000, power));
  const auto moment = [&](double value) { return value * (std::log(value) - 1) / power; };
  const double q_e = std::exp((moment(most) - moment(least)) / (most - least));
  CHECK(c.wavenumber.back() == doctest::Approx(33 * q_e).epsilon(1e-9));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::accumulate(&c.decade_share[i * m], &c.decade_share[i * m] + m, 0.0) == doctest::Approx(1).epsilon(1e-6));
    double sum = 0;
    for (std::size_t j = 1; j < n; ++j)
      sum += (c.dmu_dlnq[i * n + j] + c.dmu_dlnq[i * n + j - 1]) / 2 * std::log(c.wavenumber[j] / c.wavenumber[j - 1]);
    CHECK(sum == doctest::Approx(f.hysteresis[i]).epsilon(5e-3));
  }
}
