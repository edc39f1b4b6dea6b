#include "asperity/rubber.hpp"
#include "reference_table.hpp"

using namespace asperity;

TEST_CASE("a Prony series has the moduli and angular integrals of its definition") {
  for (const Row& row : reference("prony")) {
    CAPTURE(row.text("case"));
    const PronySeries rubber(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times"));
    const double w = row.number("angular_frequency"), rtol = row.number("rtol");
    CHECK_NEAR(rubber.modulus(w).real(), row.number("storage_modulus"), rtol, 0);
    CHECK_NEAR(rubber.modulus(w).imag(), row.number("loss_modulus"), rtol, 0);
    CHECK_NEAR(rubber.angular_integrals(w).i1, row.number("i1"), rtol, 0);
    CHECK_NEAR(rubber.angular_integrals(w).i2, row.number("i2"), rtol, 0);
  }
}

TEST_CASE("a master curve is Steffen's interpolant and integrates its kinks and its tail") {
  for (const Row& row : reference("master_curve")) {
    CAPTURE(row.text("case"));
    const MasterCurve rubber(row.list("table_frequency"), row.list("table_storage"), row.list("table_loss"));
    const double w = row.number("angular_frequency"), rtol = row.number("rtol");
    CHECK_NEAR(rubber.modulus(w).real(), row.number("storage_modulus"), rtol, 0);
    CHECK_NEAR(rubber.modulus(w).imag(), row.number("loss_modulus"), rtol, 0);
    const AngularIntegrals found = rubber.angular_integrals(w);
    CHECK_NEAR(found.i1, row.number("i1"), rtol, 0);
    CHECK_NEAR(found.i2, row.number("i2"), rtol, 0);
    CHECK_NEAR(found.i1_outside / found.i1, row.number("i1_tail_share"), rtol, 1);
    CHECK_NEAR(found.i2_outside / found.i2, row.number("i2_tail_share"), rtol, 1);
  }
}

TEST_CASE("a master curve knows nothing outside of its table") {
  const MasterCurve rubber({1, 10, 100}, {1e6, 2e6, 4e6}, {1e5, 3e5, 4e5});
  CHECK_THROWS_AS((void)rubber.modulus(0.5), OutOfRange);
  CHECK_THROWS_AS((void)rubber.angular_integrals(101), OutOfRange);
  CHECK_NOTHROW((void)rubber.angular_integrals(1));
  CHECK_NOTHROW((void)rubber.angular_integrals(100));
}

TEST_CASE("extrapolation reaches one decade, by the end slope or at the end value, and is reported") {
  const std::vector<double> w{1, 10, 100}, storage{1e6, 1e7, 1e8}, loss{1e5, 1e6, 1e7};
  const MasterCurve power(w, storage, loss, Extrapolation::power_law), clamp(w, storage, loss, Extrapolation::clamp);
  CHECK_NEAR(power.modulus(1000).real(), 1e9, 1e-12, 0);
  CHECK_NEAR(power.modulus(0.1).imag(), 1e4, 1e-12, 0);
  CHECK_NEAR(clamp.modulus(1000).real(), 1e8, 1e-12, 0);
  CHECK_NEAR(clamp.modulus(0.1).imag(), 1e5, 1e-12, 0);
  CHECK_THROWS_AS((void)power.modulus(1100), OutOfRange);
  // From 100 rad/s on part of the circle is extrapolated; E proportional to w has I1 = pi E''(w).
  const AngularIntegrals found = power.angular_integrals(1000);
  CHECK_NEAR(found.i1, 3.14159265358979324 * 1e8, 1e-10, 0);
  CHECK(found.i1_outside / found.i1 > 0.9);
  const AngularIntegrals inside = power.angular_integrals(100);
  CHECK(inside.i1_outside / inside.i1 < 1e-4);
}

// The parts themselves are compared with their definition by tests/python/rubber/test_fitted_range.py.
TEST_CASE("a fitted Prony series is known where it was fitted, shifts included, and goes on when asked to") {
  const PronySeries by_hand(1e6, {1e8, 1e9}, {1e-3, 1e-6});
  const PronySeries fitted = by_hand.fitted_on({10, 1e4}), beyond = by_hand.fitted_on({10, 1e4}, true);
  CHECK_FALSE(by_hand.fitted_range());
  CHECK_FALSE(known_range(by_hand));
  CHECK_FALSE(known_range(beyond));
  CHECK(*known_range(fitted) == FrequencyRange{10, 1e4});
  CHECK(*fitted.shifted(10).fitted_range() == FrequencyRange{1, 1e3});
  CHECK(beyond.shifted(10).extrapolated());
  CHECK_FALSE(fitted == beyond);
  CHECK_THROWS_AS((void)fitted.modulus(9), OutOfRange);
  CHECK_THROWS_AS((void)fitted.modulus(1.1e4), OutOfRange);
  CHECK_THROWS_AS((void)fitted.angular_integrals(9), OutOfRange);
  CHECK_NOTHROW((void)fitted.shifted(10).modulus(1));
  CHECK(by_hand.modulus(1e9) == beyond.modulus(1e9));
  CHECK(by_hand.angular_integrals(1e9).i1_outside == 0);
  CHECK(beyond.angular_integrals(5).i1_outside == beyond.angular_integrals(5).i1);
  CHECK(beyond.angular_integrals(5).i2_outside == beyond.angular_integrals(5).i2);

  const std::vector<double> w{5, 10, 11, 100, 1e3, 1e4, 1.1e4, 1e6};
  std::vector<double> i1(w.size()), i2(w.size()), outside(w.size());
  CHECK_THROWS_AS((void)fitted.angular_integrals(w, i1, i2), OutOfRange);
  CHECK_FALSE(by_hand.angular_integrals(w, i1, i2, outside));
  CHECK(angular_integrals(beyond, w, i1, i2, outside));
  for (std::size_t i = 0; i < w.size(); ++i)
    CHECK_NEAR(outside[i] / i1[i], beyond.angular_integrals(w[i]).i1_outside / i1[i], 2e-7, 1);

  CHECK_THROWS_AS((void)by_hand.fitted_on({0, 1}), InvalidInput);
  CHECK_THROWS_AS((void)by_hand.fitted_on({2, 1}), InvalidInput);
}

TEST_CASE("a_T above 1 is colder: the modulus of a higher frequency") {
  const PronySeries rubber(1e6, {1e8, 1e9}, {1e-3, 1e-6});
  CHECK_NEAR(rubber.shifted(10).modulus(1e3).imag(), rubber.modulus(1e4).imag(), 1e-14, 0);
  const MasterCurve curve({1, 10, 100}, {1e6, 2e6, 4e6}, {1e5, 3e5, 4e5});
  CHECK_NEAR(curve.shifted(10).modulus(2).real(), curve.modulus(20).real(), 1e-14, 0);
}

TEST_CASE("the effective modulus follows Eq. 15") {
  CHECK(effective_modulus(3e6, 0.5) == doctest::Approx(4e6).epsilon(1e-15));
  CHECK(effective_modulus(2e6, 0, 2e6, 0) == doctest::Approx(1e6).epsilon(1e-15));
}
