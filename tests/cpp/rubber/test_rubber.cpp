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
