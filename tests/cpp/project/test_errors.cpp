#include <doctest/doctest.h>

#include <limits>

#include "asperity/errors.hpp"
#include "asperity/friction.hpp"

using namespace asperity;

namespace {

const SelfAffineSpectrum road{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2000, .q1 = 1e6};
const PronySeries rubber(3e6, {1e8}, {1e-3});
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect(const Conditions& conditions, double velocity, const char* text) {
  CHECK_THROWS_WITH_AS((void)friction(road, rubber, conditions, std::span(&velocity, 1)), text, InvalidInput);
}

}  // namespace

TEST_CASE("a message names the argument, the value and what is allowed") {
  expect({.pressure = -1}, 1, "pressure = -1: must be positive and finite");
  expect({.pressure = not_a_number}, 1, "pressure = nan: must be positive and finite");
  expect({.pressure = 1e5}, 0, "velocity = 0: must be positive and finite");
  expect({.pressure = 1e5, .poisson_ratio = 0.6}, 1, "poisson_ratio = 0.6: must be in [0, 0.5]");
  expect({.pressure = 1e5, .correction = AffineShift{0.5}}, 1, "p = 0.5: must be 1 or more, and finite");
  expect({.pressure = 1e5, .correction = SFactor{2}}, 1, "gamma = 2: must be in [0, 1]");
  expect({.pressure = 1e5, .adhesion = Adhesion{-1}}, 1, "shear_stress = -1: must be finite and not negative");
  expect({.pressure = 1e5, .rtol = 0}, 1, "rtol = 0: must be in [1e-12, 0.1]");
}

TEST_CASE("plain structs are checked where they are used") {
  SelfAffineSpectrum bad = road;
  bad.hurst = 1.2;
  CHECK_THROWS_WITH_AS((void)rms_slope(bad), "hurst = 1.2: must be in (0, 1]", InvalidInput);
  bad = road;
  bad.q1 = 1000;
  CHECK_THROWS_WITH_AS((void)density(bad, 1), "q1 = 1000: must be above q0 = 2000", InvalidInput);
}

TEST_CASE("all errors are caught as one") {
  CHECK_THROWS_AS((void)PronySeries(0, {}, {}), Error);
  CHECK_THROWS_AS((void)PronySeries(1, {1, 2}, {1}), Error);
  CHECK_THROWS_AS((void)MasterCurve({1, 1}, {1, 1}, {1, 1}), Error);
}

TEST_CASE("an error has what its message says as data") {
  const double velocity = 1;
  try {
    (void)friction(road, rubber, {.pressure = 1e5, .rtol = 0}, std::span(&velocity, 1));
    FAIL("rtol = 0 was taken");
  } catch (const Error& error) {
    CHECK(error.code() == "invalid-value");
    CHECK(error.argument() == "rtol");
    CHECK(std::get<double>(error.value()) == 0);
    CHECK(error.allowed() == "in [1e-12, 0.1]");
  }
  const MasterCurve curve({1, 1e7}, {1e6, 2e6}, {1e5, 1e5});
  const double fast = 100;
  try {
    (void)friction(road, curve, {.pressure = 1e5}, std::span(&fast, 1));
    FAIL("frequencies beyond the curve were taken");
  } catch (const OutOfRange& error) {
    CHECK(error.code() == "unknown-modulus");
    CHECK(error.argument() == "velocity");
    CHECK(std::get<double>(error.value()) == fast);
    CHECK(error.diagnostic().next_step.size() == 1);
  }
}
