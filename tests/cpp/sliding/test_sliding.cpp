#include <algorithm>
#include <chrono>
#include <numbers>
#include <numeric>

#include "asperity/sliding.hpp"
#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "reference_table.hpp"

using namespace asperity;
using std::numbers::pi;

namespace {

HeightMap waves(const Row& row) {
  const auto n = static_cast<std::size_t>(row.number("points"));
  const std::vector<double> kx = row.list("kx"), ky = row.list("ky"), a = row.list("amplitude"),
                            phase = row.list("phase");
  std::vector<double> h(n * n);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x)
      for (std::size_t i = 0; i < a.size(); ++i)
        h[y * n + x] += a[i] * std::cos(2 * pi * (kx[i] * static_cast<double>(x) + ky[i] * static_cast<double>(y)) /
                                            static_cast<double>(n) +
                                        phase[i]);
  const double pixel = row.number("length") / static_cast<double>(n);
  return {std::move(h), {n, n}, {pixel, pixel}};
}

const PronySeries rubber(1e6, {9.9e7}, {1e-3});

HeightMap rough(std::size_t n) {
  return synthesize(SelfAffineSpectrum{.rms_height = 1e-4, .hurst = 0.8, .q0 = 800 * pi, .q1 = 6400 * pi}, {n, n},
                    {0.01 / static_cast<double>(n), 0.01 / static_cast<double>(n)}, 1);
}

}  // namespace

TEST_CASE("contacts of the reference table") {
  for (const Row& row : reference("sliding")) {
    CAPTURE(row.text("case"));
    const PronySeries solid(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times"));
    const SlidingContact c = slide(waves(row), solid, row.number("pressure"), row.number("velocity"),
                                   {row.number("poisson_ratio"), Continuation::periodic, 1e-11});
    const double rtol = row.number("rtol");
    CHECK(c.error <= 1e-11);
    CHECK(c.contact_area_raw == doctest::Approx(row.number("contact_area")).epsilon(1e-14));
    CHECK_NEAR(c.hysteresis, row.number("hysteresis"), rtol, 0);
    CHECK_NEAR(c.work_of_slopes, row.number("work_of_slopes"), rtol, 0);
    CHECK_NEAR(c.elastic_energy, row.number("elastic_energy"), rtol, 0);
    CHECK_NEAR(std::ranges::max(c.pressure), row.number("highest_pressure"), rtol, 0);
    CHECK_NEAR(std::accumulate(c.gap.begin(), c.gap.end(), 0.0) / static_cast<double>(c.gap.size()),
               row.number("mean_gap"), rtol, 0);
  }
}

TEST_CASE("pressure and gap are complementary, and carry the load") {
  const SlidingContact c = slide(rough(64), rubber, 3e5, 0.1, {.continuation = Continuation::periodic, .rtol = 1e-9});
  CHECK(std::ranges::min(c.pressure) == 0);
  CHECK(std::ranges::min(c.gap) == 0);
  CHECK(std::accumulate(c.pressure.begin(), c.pressure.end(), 0.0) / 4096 == doctest::Approx(3e5).epsilon(1e-12));
  CHECK(std::inner_product(c.pressure.begin(), c.pressure.end(), c.gap.begin(), 0.0) / 4096 <= 1e-9 * 3e5 * 1e-4);
}

TEST_CASE("a watch ends it") {
  struct Enough {};
  const Watch watch([] { throw Enough(); }, std::chrono::milliseconds(20));
  CHECK_THROWS_AS(slide(rough(512), rubber, 1e5, 0.1), Enough);
}
