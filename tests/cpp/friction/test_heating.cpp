#include <optional>
#include <span>

#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

const WLF law{8.86, 101.6, 293.15};
const Heating tread{.density = 1200, .heat_capacity = 1650, .conductivity = 0.23, .contact_diameter = 1e-3};

struct Point {
  Heating heating = tread;
  TemperatureShift shift = law;
  double pressure = 2e5, velocity = 0.1, temperature = 293.15;
  std::optional<Adhesion> adhesion = std::nullopt;
  ContactModel model{};

  [[nodiscard]] FlashFriction at(const Spectrum& road, const Rubber& rubber) const {
    return friction(road, rubber, shift, heating, model, adhesion, std::span(&pressure, 1), std::span(&velocity, 1),
                    std::span(&temperature, 1));
  }
};

}  // namespace

TEST_CASE("PartialContact with heat meets its reference table") {
  for (const Row& row : reference("hot_partial_contact")) {
    CAPTURE(row.text("case"));
    Spectrum road = SelfAffineSpectrum{};
    if (const auto rms = row.maybe("rms_height"))
      road = SelfAffineSpectrum{*rms, row.number("hurst"), row.number("q0"), row.number("q1"), row.maybe("rolloff")};
    else
      road = TabulatedSpectrum(row.list("table_wavenumber"), row.list("table_density"));
    const PronySeries rubber(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times"));
    Point point{.pressure = row.number("pressure"),
                .velocity = row.number("velocity"),
                .temperature = row.number("temperature"),
                .model = {.poisson_ratio = row.number("poisson_ratio"), .correction = PartialContact{}}};
    point.heating.heat_capacity = row.number("heat_capacity");
    point.heating.residence = row.text("residence") == "box" ? Residence::box : Residence::disc;
    const FlashFriction found = point.at(road, rubber);
    const double exact = row.number("hysteresis");
    CHECK(std::fabs(found.hot.hysteresis[0] - exact) <= found.hot.error_estimate[0] + row.number("rtol") * exact);
    CHECK_NEAR(found.hot.contact_area[0], row.number("contact_area"), 3e-6, 0);
    CHECK_NEAR(found.macro_area[0], row.number("macro_area"), 3e-6, 0);
    CHECK_NEAR(found.hot.temperature[0] - point.temperature, row.number("rise"), 3e-6, 1e-6);
  }
}
