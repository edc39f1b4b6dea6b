#include "asperity/asperities.hpp"
#include "asperity/correction.hpp"
#include "reference_table.hpp"

using namespace asperity;

TEST_CASE("Hertz penetration") {
  for (const Row& row : reference("hertz")) {
    CAPTURE(row.text("case"));
    CHECK_NEAR(hertz_penetration(row.number("force"), row.number("effective_modulus"), row.number("radius")),
               row.number("penetration"), row.number("rtol"), 0);
  }
}

TEST_CASE("the integral of Eq. 16 from -400 to 40 rms heights") {
  for (const Row& row : reference("gaussian_moment")) {
    CAPTURE(row.text("case"));
    CHECK_NEAR(log_gaussian_moment(row.number("t")), row.number("log_moment"), row.number("rtol"), 0);
  }
}

TEST_CASE("separations of both readings, Gaussian and measured peaks") {
  for (const Row& row : reference("greenwood_williamson")) {
    CAPTURE(row.text("case"));
    const std::vector<double> peaks = row.list("peaks");
    const double rms = row.number("rms_height"), rtol = row.number("rtol");
    for (const Reading reading : {Reading::implicit, Reading::added}) {
      const std::string name = reading == Reading::implicit ? "implicit" : "added";
      const Separation d =
          separation({rms, row.number("q0"), peaks}, row.number("pressure"), row.number("effective_modulus"), reading);
      CHECK_NEAR(d.effective, row.number("effective_" + name), rtol, rms);
      CHECK_NEAR(d.rigid, row.number("rigid_" + name), rtol, rms);
    }
  }
}

TEST_CASE("the article's shift factors come out of the text of Eq. 21") {
  const SelfAffineSpectrum sandpaper{.rms_height = 76.572e-6, .hurst = 0.7, .q0 = 2000, .q1 = 1e6};
  const PronySeries elastic(115.95e6 * 0.75, {}, {});
  const GreenwoodWilliamson igw{.z_max = 0.29028e-3, .z_min = -0.31587e-3};
  const double printed[] = {2.46, 2.02, 1.83}, pressure[] = {0.1e6, 0.3e6, 0.5e6};
  for (int i = 0; i < 3; ++i)
    CHECK(affine_shift(igw, sandpaper, elastic, pressure[i], 0.1, 0.5).p == doctest::Approx(printed[i]).epsilon(2e-3));
}

TEST_CASE("no contact and full conformity are states, not numbers gone wrong") {
  const SelfAffineSpectrum surface{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2000, .q1 = 1e6};
  const GreenwoodWilliamson igw{.z_max = 1e-4, .z_min = -1e-4};
  const Shift touching = affine_shift(igw, surface, PronySeries(1e12, {}, {}), 1e3, 1, 0.5);
  CHECK(touching.state == ContactState::no_contact);
  CHECK(std::isinf(touching.p));
  const Shift pressed = affine_shift(igw, surface, PronySeries(1e3, {}, {}), 1e6, 1, 0.5);
  CHECK(pressed.state == ContactState::full);
  CHECK(pressed.p == 1);
}

TEST_CASE("peaks and Greenwood-Williamson multiply") {
  const SelfAffineSpectrum surface{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2000, .q1 = 1e6};
  const PronySeries rubber(1e8, {}, {});
  const LocalPeaks peaks{.heights = {1e-4, 1.5e-4, 2e-4, 3e-4}};
  const double first = shift_factor(peaks);
  CHECK(first == doctest::Approx(3e-4 / (3e-4 - 1.875e-4)).epsilon(1e-14));
  const PeaksThenGreenwoodWilliamson both{.peaks = peaks, .z_max = 3e-4, .z_min = -4e-4};
  const double d = separation({1e-4 / first, 2000}, 1e5, effective_modulus(1e8, 0.5)).effective;
  const double second = 7e-4 / first / (3e-4 / first - d);
  CHECK(affine_shift(both, surface, rubber, 1e5, 1, 0.5).p == doctest::Approx(first * second).epsilon(1e-12));
}
