#include <limits>
#include <optional>
#include <span>

#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
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

template <class Error = InvalidInput>
void refused(const char* argument, auto spoil) {
  const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 2e4};
  const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  Point point;
  CHECK_NOTHROW((void)point.at(road, rubber));
  spoil(point);
  CAPTURE(argument);
  try {
    (void)point.at(road, rubber);
    FAIL("not refused");
  } catch (const Error& error) {
    CHECK(error.argument() == argument);
  }
}

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

TEST_CASE("what heat cannot be computed with is refused by its argument") {
  refused("density", [](Point& p) { p.heating.density = 1.2; });
  refused("density", [](Point& p) { p.heating.density = unknown; });
  refused("heat_capacity", [](Point& p) { p.heating.heat_capacity = 1e5; });
  refused("conductivity", [](Point& p) { p.heating.conductivity = 230; });
  refused("contact_diameter", [](Point& p) { p.heating.contact_diameter = -1e-3; });
  refused("macro_wavenumber", [](Point& p) { p.heating.macro_wavenumber = 10; });
  refused("macro_wavenumber", [](Point& p) { p.heating.macro_wavenumber = unknown; });
  refused("macro_area", [](Point& p) { p.heating.macro_area = 1.5; });
  refused("macro_area", [](Point& p) {
    p.heating.macro_wavenumber = 6e3;
    p.heating.macro_area = 0.1;
  });
  refused("interface_share", [](Point& p) { p.heating.interface_share = 0.5; });
  refused("temperature", [](Point& p) { p.temperature = 20; });
  refused("c1", [](Point& p) { p.shift = WLF{-1, 101.6, 293.15}; });
  refused("reference_temperature", [](Point& p) { p.shift = WLF{8.86, 101.6, 20}; });
  refused("method", [](Point& p) { p.model.method = Method::qag; });
  refused<OutOfRange>("temperature", [](Point& p) {
    p.shift = WLF{8.86, 51.6, 293.15};
    p.temperature = 230;
  });
  refused<OutOfRange>("temperature", [](Point& p) {
    p.shift = ShiftTable(293.15, {263.15, 293.15, 293.65}, {3.0, 0.0, -0.05});
  });
  refused<OutOfRange>("temperature", [](Point& p) {  // above what rubber stands
    p.heating.macro_area = 1e-3;
    p.shift = WLF{0.01, 101.6, 293.15};
  });
}
