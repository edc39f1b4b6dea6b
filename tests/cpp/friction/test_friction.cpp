#include <algorithm>
#include <numeric>

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

TEST_CASE("S factor: where it applies it changes, elsewhere it does not") {
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const double velocity = 0.01;
  const auto with = [&](Correction correction) {
    return friction(road, rubber, {.pressure = 81e3, .correction = std::move(correction), .adhesion = Adhesion{8.3e6}},
                    std::span(&velocity, 1));
  };
  using Where = SFactor::AppliesTo;
  const Friction none = with(NoCorrection{}), on_friction = with(SFactor{0.5, Where::friction}),
                 on_area = with(SFactor{0.5, Where::area}), both = with(SFactor{0.5, Where::both});
  CHECK(on_friction.contact_area[0] == none.contact_area[0]);
  CHECK(on_friction.adhesion[0] == none.adhesion[0]);
  CHECK(on_friction.hysteresis[0] < none.hysteresis[0]);
  CHECK(on_area.hysteresis[0] == none.hysteresis[0]);
  CHECK(on_area.contact_area[0] > none.contact_area[0]);
  CHECK(on_area.adhesion[0] > none.adhesion[0]);
  CHECK(both.hysteresis[0] == on_friction.hysteresis[0]);
  CHECK(both.adhesion[0] == on_area.adhesion[0]);
  CHECK(both.mu[0] == both.hysteresis[0] + both.adhesion[0]);
}

TEST_CASE("contributions add up to the hysteresis") {
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const double velocity[] = {1e-4, 1.0};
  const Friction f = friction(road, rubber, {.pressure = 81e3, .contributions = true}, velocity);
  const Contributions& c = *f.contributions;
  const std::size_t m = c.decade_edges.size() - 1, n = c.wavenumber.size();
  CHECK(c.decade_edges.front() <= 1e-4 * 2000);
  CHECK(c.decade_edges.back() >= 1.0 * 1e6);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::accumulate(&c.decade_share[i * m], &c.decade_share[i * m] + m, 0.0) ==
          doctest::Approx(1).epsilon(1e-12));
    double sum = 0;
    for (std::size_t j = 1; j < n; ++j)
      sum += (c.dmu_dlnq[i * n + j] + c.dmu_dlnq[i * n + j - 1]) / 2 * std::log(c.wavenumber[j] / c.wavenumber[j - 1]);
    CHECK(sum ==
          doctest::Approx(f.hysteresis[i]).epsilon(5e-3));  // a trapezoid of 32 points a decade, and of the front
  }
}

TEST_CASE("the tolerance asked for is kept, the impossible one refused") {
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const double velocity = 0.01;
  const auto at = [&](double rtol) {
    return friction(road, rubber, {.pressure = 81e3, .rtol = rtol}, std::span(&velocity, 1)).mu[0];
  };
  const double best = at(1e-11);
  for (const double rtol : {1e-2, 1e-4, 1e-6, 1e-9}) CHECK_NEAR(at(rtol), best, rtol, 0);
  CHECK_THROWS_AS((void)at(1e-13), InvalidInput);
}

TEST_CASE("notes say where the theory is left, and only there") {
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const SelfAffineSpectrum mild{.rms_height = 20e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e5};
  const SelfAffineSpectrum steep{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const double slow = 1e-3, fast = 1;
  const auto notes = [&](const Spectrum& s, double v) {
    return friction(s, rubber, {.pressure = 81e3}, std::span(&v, 1)).notes;
  };
  CHECK(notes(mild, slow).empty());
  CHECK(notes(mild, fast).front().code == "heat-left-out");
  const Diagnostic note = notes(steep, slow).front();
  CHECK(note.code == "steep-spectrum");
  CHECK(note.severity == Severity::warning);
  CHECK(note.text().find("rms slope is 2.76") != std::string::npos);
}

TEST_CASE("an integrand that itself integrates does not disturb the integral it stands in") {
  // A coarse curve, on which the fixed rule inside G gives way to the adaptive one.
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const MasterCurve coarse({1, 639, 1359, 1e8}, {3.9e6, 1.94e7, 9.767e8, 1.4529e9},
                           {2.39e6, 7.4e6, 1.9486e8, 3.0038e8});
  const double velocity = 0.01;
  const auto at = [&](double rtol) {
    return friction(road, coarse, {.pressure = 81e3, .rtol = rtol}, std::span(&velocity, 1)).mu[0];
  };
  // found with a workspace an integral, at three tolerances
  for (const double rtol : {1e-3, 1e-6, 1e-9}) CHECK_NEAR(at(rtol), 1.6124015534, rtol, 0);
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
