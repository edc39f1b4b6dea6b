#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/asperities.hpp"
#include "asperity/correction.hpp"
#include "reference_table.hpp"

using namespace asperity;

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

// Where the crowd is just reached, Newton's steps jump to and fro over it.
TEST_CASE("one peak above a crowd of others carries the load that it is asked for") {
  const double rms = 265.7e-6, q0 = 2000, pressure = 1e3, pi = std::numbers::pi;
  std::vector<double> peaks{0};
  for (int i = 1; i < 303; ++i) peaks.push_back(-1e-3 * (1 + std::pow(10, -i / 100.0)));  // no multiple of four
  const double stiffness = 2 * q0 / (3 * pi * pi * std::sqrt(3 * std::sqrt(2.0) * rms));  // (4/3) sqrt(R) n_a
  for (int i = 0; i < 2000; ++i) {
    const double modulus = std::pow(10, 3 + i / 300.0);
    CAPTURE(modulus);
    const double d = separation({rms, q0, peaks}, pressure, modulus).effective;
    double moment = 0;
    for (const double z : peaks) moment += std::pow(std::fmax(0, z - d), 1.5) / static_cast<double>(peaks.size());
    CHECK(modulus * stiffness * moment == doctest::Approx(pressure).epsilon(1e-12));
  }
}
