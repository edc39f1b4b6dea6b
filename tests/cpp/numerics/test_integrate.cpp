#include <doctest/doctest.h>

#include <cmath>
#include <span>

#include "asperity/errors.hpp"
#include "numerics/adaptive_quadrature.hpp"
#include "numerics/libraries.hpp"

using namespace asperity;

namespace {

constexpr Adaptive every[] = {Adaptive::bisection, Adaptive::qag, Adaptive::qags, Adaptive::cquad};
constexpr std::span<const Adaptive> rules(every, has_gsl_and_fftw ? 4 : 1);

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

TEST_CASE("the error of bisection bounds what is wrong, down to 1e-13") {
  struct Known {
    double (*f)(double);
    double lower, upper, value;
  };
  const double e = std::exp(1.0), pi = std::acos(-1.0);
  const Known all[] = {
      {[](double x) { return std::exp(x); }, 0, 1, e - 1},
      {[](double x) { return 1 / (1e-6 + x * x); }, -1, 2, 1e3 * (std::atan(1e3) + std::atan(2e3))},
      {[](double x) { return std::sin(50 * x); }, 0, pi / 50, 2.0 / 50},
      {[](double x) { return std::sqrt(x); }, 0, 4, 16.0 / 3},
      {[](double x) { return std::exp(-x * x / 2); }, 0, 40, std::sqrt(pi / 2)},
      {[](double x) { return x < 0.7 ? 1 : 3 * x; }, 0, 1, 0.7 + 1.5 * (1 - 0.49)},
  };
  for (const Known& k : all)
    for (const double rtol : {1e-4, 1e-9, 1e-13}) {
      const Integral result = integrate(k.f, k.lower, k.upper, rtol);
      CHECK(result.error <= rtol * result.value);
      CHECK(std::fabs(result.value - k.value) <= result.error + 4e-15 * k.value);
    }
  // backwards, over nothing, and small beside what is allowed
  CHECK(integrate([](double x) { return x; }, 2, 1, 1e-12).value == doctest::Approx(-1.5).epsilon(1e-14));
  CHECK(integrate([](double x) { return x; }, 1, 1, 1e-12).value == 0);
  CHECK(integrate([](double x) { return std::sqrt(x); }, 0, 1, 0, 0.1).error <= 0.1);
}
