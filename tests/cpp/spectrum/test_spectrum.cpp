#include <numbers>

#include "asperity/spectrum.hpp"
#include "reference_table.hpp"

using namespace asperity;
using std::numbers::pi;

TEST_CASE("self-affine densities, slopes and cut-offs") {
  for (const Row& row : reference("spectrum")) {
    CAPTURE(row.text("case"));
    const SelfAffineSpectrum s{row.number("rms_height"), row.number("hurst"), row.number("q0"), row.number("q1"),
                               row.maybe("rolloff")};
    const double rtol = row.number("rtol");
    CHECK_NEAR(density(s, row.number("wavenumber")), row.number("density"), rtol, 0);
    CHECK_NEAR(rms_slope(s), row.number("rms_slope"), rtol, 0);
    CHECK_NEAR(cutoff_for_slope(s), row.number("slope_cutoff"), rtol, 0);
  }
}

TEST_CASE("tabulated densities and moments, zeros included") {
  for (const Row& row : reference("tabulated_spectrum")) {
    CAPTURE(row.text("case"));
    const TabulatedSpectrum s(row.list("table_wavenumber"), row.list("table_density"));
    const double rtol = row.number("rtol");
    CHECK_NEAR(density(s, row.number("wavenumber")), row.number("density"), rtol, 0);
    CHECK_NEAR(rms_height(s), row.number("rms_height"), rtol, 0);
    CHECK_NEAR(rms_slope(s), row.number("rms_slope"), rtol, 0);
    CHECK_NEAR(cutoff_for_slope(s), row.number("slope_cutoff"), rtol, 0);
  }
}

TEST_CASE("autocorrelation of a spectrum") {
  for (const Row& row : reference("autocorrelation")) {
    CAPTURE(row.text("case"));
    const double rms = row.number("rms_height"), distance = row.number("distance");
    const SelfAffineSpectrum s{rms, row.number("hurst"), row.number("q0"), row.number("q1"), row.maybe("rolloff")};
    CHECK_NEAR(autocorrelation(s, std::span(&distance, 1))[0], row.number("autocorrelation"), row.number("rtol"),
               rms * rms);
  }
}

TEST_CASE("a periodic map carries exactly its spectrum, and a transform gives it back") {
  const SelfAffineSpectrum s{.rms_height = 1e-5, .hurst = 0.7, .q0 = 2 * pi / 96e-6, .q1 = 2 * pi / 8e-6};
  const HeightMap map = synthesize(s, {96, 128}, {1e-6, 1.5e-6}, 7);
  const TabulatedSpectrum found = power_spectrum(map, Window::none, std::nullopt);
  double sum = 0;
  for (std::size_t i = 0; i < found.quality().count.size(); ++i) sum += found.density()[i] * found.quality().count[i];
  const double area = 96e-6 * 192e-6;
  CHECK_NEAR(sum * 4 * pi * pi / area, std::pow(map.statistics().rms_height, 2), 1e-12, 0);
  // a ring far inside the band averages the power law over its width only
  for (std::size_t i = 0; i < found.quality().count.size(); ++i)
    if (found.wavenumber()[i] > 1.5 * s.q0 && found.wavenumber()[i] < s.q1 / 1.2)
      CHECK(found.density()[i] == doctest::Approx(density(s, found.wavenumber()[i])).epsilon(0.1));
  const SelfAffineFit fit = fit_self_affine(found, {.q_min = 1.5 * s.q0, .q_max = s.q1 / 1.2});
  CHECK(fit.spectrum.hurst == doctest::Approx(0.7).epsilon(0.02));
}
