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

const PronySeries rubber(1e6, {9.9e7}, {1e-3});

HeightMap rough(std::size_t n) {
  return synthesize(SelfAffineSpectrum{.rms_height = 1e-4, .hurst = 0.8, .q0 = 800 * pi, .q1 = 6400 * pi}, {n, n},
                    {0.01 / static_cast<double>(n), 0.01 / static_cast<double>(n)}, 1);
}

}  // namespace

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
