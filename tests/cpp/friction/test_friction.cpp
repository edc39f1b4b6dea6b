
#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

void check_scene(const Row& row, const Rubber& rubber) {
  CAPTURE(row.text("case"));
  const SelfAffineSpectrum surface{row.number("rms_height"), row.number("hurst"), row.number("q0"), row.number("q1"),
                                   row.maybe("rolloff")};
  const Form form = row.text("form") == "exact" ? Form::exact : Form::interpolated;
  const double velocity = row.number("velocity"), rtol = row.number("rtol"), p = row.number("shift_factor");
  Conditions c{.pressure = row.number("pressure"),
               .poisson_ratio = row.number("poisson_ratio"),
               .correction = AffineShift{p},
               .form = form};
  const Friction shifted = friction(surface, rubber, c, std::span(&velocity, 1));
  CHECK_NEAR(shifted.hysteresis[0], row.number("hysteresis"), rtol, 0);
  CHECK_NEAR(shifted.contact_area[0], row.number("contact_area"), rtol, 0);
  CHECK(std::fabs(shifted.hysteresis[0] - row.number("hysteresis")) <=
        shifted.error_estimate[0] + 1e-10 * row.number("hysteresis"));
  // C / p^2 by hand, so that the S factor can be looked at on the shifted surface too
  c.correction = SFactor{row.number("gamma"), SFactor::AppliesTo::both};
  const Friction with_s = friction(scaled(surface, 1 / (p * p)), rubber, c, std::span(&velocity, 1));
  CHECK_NEAR(with_s.hysteresis[0], row.number("hysteresis_s"), rtol, 0);
  CHECK_NEAR(with_s.contact_area[0], row.number("contact_area_s"), rtol, 0);
}

}  // namespace

TEST_CASE("friction and area of the reference scenes, Prony") {
  for (const Row& row : reference("friction"))
    check_scene(row, PronySeries(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times")));
}

TEST_CASE("friction and area of the reference scenes, tabulated rubber") {
  for (const Row& row : reference("friction_tabulated"))
    check_scene(row, MasterCurve(row.list("table_frequency"), row.list("table_storage"), row.list("table_loss")));
}

TEST_CASE("friction and area on measured spectra: zeros, jumps, fronts in the middle of the band, extrapolation") {
  for (const Row& row : reference("friction_measured")) {
    CAPTURE(row.text("case"));
    const TabulatedSpectrum surface(row.list("table_wavenumber"), row.list("table_density"));
    const std::string& beyond = row.text("extrapolation");
    const auto extrapolation = beyond.empty()      ? std::nullopt
                               : beyond == "clamp" ? std::optional(Extrapolation::clamp)
                                                   : std::optional(Extrapolation::power_law);
    const Rubber rubber =
        row.text("table_frequency").empty()
            ? Rubber(PronySeries(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times")))
            : Rubber(MasterCurve(row.list("table_frequency"), row.list("table_storage"), row.list("table_loss"),
                                 extrapolation));
    const double velocity = row.number("velocity"), rtol = row.number("rtol");
    Conditions c{.pressure = row.number("pressure"), .poisson_ratio = row.number("poisson_ratio")};
    const Friction plain = friction(surface, rubber, c, std::span(&velocity, 1));
    CHECK_NEAR(plain.hysteresis[0], row.number("hysteresis"), rtol, 0);
    CHECK_NEAR(plain.contact_area[0], row.number("contact_area"), rtol, 0);
    CHECK_NEAR(plain.extrapolated_share[0], row.maybe("extrapolated_share").value_or(0), 1e-4, 1);
    c.correction = SFactor{row.number("gamma"), SFactor::AppliesTo::both};
    const Friction with_s = friction(surface, rubber, c, std::span(&velocity, 1));
    CHECK_NEAR(with_s.hysteresis[0], row.number("hysteresis_s"), rtol, 0);
    CHECK_NEAR(with_s.contact_area[0], row.number("contact_area_s"), rtol, 0);
  }
}

TEST_CASE("a front on a ramp from zero and a narrow band keep their digits") {
  const PronySeries rubber(1e6, {1e9}, {1e-6});
  const double velocity = 1;
  const TabulatedSpectrum ramp({1e3, 1.3e3}, {0, 2.5e-5});
  const Friction f = friction(ramp, rubber, {.pressure = 1e5}, std::span(&velocity, 1));
  CHECK_NEAR(f.mu[0], 4664.89356, 2e-9, 0);  // graded panels from the start of the ramp, 9 digits
  // flat over a relative width of d: G = q^4 C I2 d / (8 (E ...)^2), the same for every d at C ~ 1 / d
  const auto narrow = [&](double d) {
    const TabulatedSpectrum s({1e3, 1e3 * (1 + d)}, {1e-11 / d, 1e-11 / d});
    const double exact = (1e3 * (1 + d) - 1e3) / (1e3 * d);  // the width that the rows really have
    return friction(scaled(s, 1 / exact), rubber, {.pressure = 1e5}, std::span(&velocity, 1)).mu[0];
  };
  for (const double d : {1e-9, 1e-11, 1e-13}) CHECK_NEAR(narrow(d), narrow(1e-8), 1e-7, 0);
}
