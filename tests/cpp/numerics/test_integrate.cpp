#include <doctest/doctest.h>

#include <cmath>

#include "asperity/errors.hpp"
#include "numerics/adaptive_quadrature.hpp"

using namespace asperity;

namespace {

constexpr Adaptive rules[] = {Adaptive::qag, Adaptive::qags, Adaptive::cquad};

}  // namespace

TEST_CASE("every routine keeps its tolerance on a kink") {
  for (const Adaptive rule : rules) {
    const auto f = [](double x) { return std::fabs(x - 0.3); };
    const Integral found = integrate(f, 0, 1, 1e-10, 0, rule);
    CHECK(std::fabs(found.value - 0.29) <= 1e-10 * 0.29);
    CHECK(found.error <= 1e-10 * 0.29);
  }
}

TEST_CASE("an integrand that integrates leaves the outer integral alone") {
  for (const Adaptive outer : rules) {
    for (const Adaptive inner : rules) {
      // int_0^1 int_0^1 |x - 0.3| |y - 0.3| dy dx, with a kink that either level bisects for
      const auto row = [&](double x) {
        return integrate([&](double y) { return std::fabs((x - 0.3) * (y - 0.3)); }, 0, 1, 1e-10, 0, inner).value;
      };
      CHECK(std::fabs(integrate(row, 0, 1, 1e-8, 0, outer).value - 0.29 * 0.29) <= 1e-8 * 0.29 * 0.29);
    }
  }
}

TEST_CASE("what cannot be integrated is an error, and what the integrand throws comes through") {
  for (const Adaptive rule : rules) {
    CHECK_THROWS_AS((void)integrate([](double x) { return 1 / x; }, 0, 1, 1e-9, 0, rule), NotConverged);
    CHECK_THROWS_AS((void)integrate([](double) -> double { throw InvalidInput("no"); }, 0, 1, 1e-9, 0, rule),
                    InvalidInput);
  }
}
