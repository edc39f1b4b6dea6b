
#include "asperity/contact.hpp"
#include "reference_table.hpp"

using namespace asperity;

TEST_CASE("S inside G that knows the band: the area of its definition, under any unit of length") {
  for (const Row& row : reference("nayak_s_factor")) {
    CAPTURE(row.text("case"));
    for (const double metre : {1.0, 1e-60, 1e60}) {
      const SelfAffineSpectrum surface{.rms_height = 1e-4 * metre,
                                       .hurst = row.number("hurst"),
                                       .q0 = 1024 / metre,
                                       .q1 = 1024 * row.number("q1_over_q0") / metre};
      CHECK_NEAR(nayak_parameter(surface), row.number("nayak_parameter"), 1e-10, 1e-300);
      const double pressure = 1e6 * rms_slope(surface) / std::sqrt(8 * row.number("g_uncorrected")), velocity = 1;
      const double area = contact_area(surface, PronySeries(1e6, {}, {}),
                                       {.poisson_ratio = 0, .correction = NayakSFactor{}, .rtol = 1e-10},
                                       std::span(&pressure, 1), std::span(&velocity, 1))[0];
      CHECK_NEAR(area, row.number("contact_area"), row.number("rtol"), 1e-300);
    }
  }
}

TEST_CASE("Nayak's parameter of a table: straight pieces too, 1.5 on a narrow band") {
  // C = 1 on [1, 2], falling straight to 0 at 3: m0 = 3/2 + 7/6, m2 and m4 alike by hand
  const TabulatedSpectrum table({1, 2, 3}, {1, 1, 0});
  const double m0 = 3.0 / 2 + 7.0 / 6, m2 = 15.0 / 4 + (3 * 65.0 / 4 - 211.0 / 5),
               m4 = 63.0 / 6 + (3 * 665.0 / 6 - 2059.0 / 7);
  CHECK(nayak_parameter(table) == doctest::Approx(1.5 * m0 * m4 / (m2 * m2)).epsilon(1e-14));
  CHECK(nayak_parameter(SelfAffineSpectrum{.rms_height = 1, .hurst = 0.8, .q0 = 1, .q1 = 1 + 1e-9}) ==
        doctest::Approx(1.5).epsilon(1e-12));
}
