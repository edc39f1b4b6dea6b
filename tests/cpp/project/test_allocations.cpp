// What a call allocates does not grow with its points, but for the numbers that it returns.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "asperity/friction.hpp"
#include "asperity/friction_map.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted_or_null(std::size_t size) {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}

void* counted(std::size_t size) {
  if (void* const memory = counted_or_null(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
// std::stable_sort asks for these: what is counted must be freed as it was had
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace asperity;

namespace {

/// Allocations of one call at as many velocities, after one that has filled all tables.
long allocations_at(std::size_t points, const Rubber& rubber, const Correction& correction) {
  const SelfAffineSpectrum road{.rms_height = 1e-4, .hurst = 0.8, .q0 = 1e3, .q1 = 1e6};
  const ContactModel model{.correction = correction};
  std::vector<double> pressure(points, 1e5), velocity(points);
  for (std::size_t i = 0; i < points; ++i)
    velocity[i] = 1e-4 * std::pow(1e4, static_cast<double>(i) / static_cast<double>(points));
  (void)friction(road, rubber, model, Adhesion{1e6}, pressure, velocity);
  const long before = allocations;
  (void)friction(road, rubber, model, Adhesion{1e6}, pressure, velocity);
  return allocations - before;
}

}  // namespace

TEST_CASE("a thousand points allocate hardly more often than a hundred: rooms grow by doubling") {
  const PronySeries series(1e6, {1e7, 1e8}, {1e-2, 1e-5});
  const MasterCurve table({1e-2, 1, 1e2, 1e4, 1e7}, {1e6, 2e6, 1e7, 1e8, 1e9}, {1e5, 4e5, 4e6, 3e7, 1e8});
  for (const Rubber& rubber : {Rubber(series), Rubber(table)})
    for (const Correction& correction :
         {Correction(NoCorrection{}), Correction(SFactor{.applies_to = SFactor::AppliesTo::both}),
          Correction(AffineShift{2}), Correction(NayakSFactor{})})
      CHECK(allocations_at(1000, rubber, correction) - allocations_at(100, rubber, correction) <= 10);
}

TEST_CASE("a query of a friction map allocates nothing, in its box, outside of it or with numbers that are none") {
  const SelfAffineSpectrum road{.rms_height = 1e-4, .hurst = 0.8, .q0 = 1e3, .q1 = 1e5};
  const MapRequest request{.pressure = {1e4, 1e6}, .velocity = {1e-4, 1}, .rtol = 1e-2, .checked = 0};
  const auto file =
      build_friction_map(road, PronySeries(1e6, {1e8}, {1e-4}),
                         {.correction = GreenwoodWilliamson{.z_max = 6e-4, .z_min = -3e-4}}, Adhesion{1e6}, request);
  FrictionMap map;
  std::string why;
  REQUIRE(map.read(file.data(), file.size(), why));
  const long before = allocations;
  double sum = 0;
  for (const auto outside : {FrictionMap::Outside::nan, FrictionMap::Outside::clamp})
    for (const double p : {1e5, 1e9, 0.0, std::nan("")})
      for (const double v : {1e-2, -1e-2, 0.0, 1e3}) {
        MapPoint point;
        map.at(p, v, point, outside, {3.0, true});
        sum += map.mu(p, v, outside) + map.traction(p, v, outside) + point.mu;
      }
  CHECK(allocations == before);
  CHECK(std::isnan(sum));  // of which some were outside: nothing was left out
}
