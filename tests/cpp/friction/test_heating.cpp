#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "asperity/friction.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

const WLF law{8.86, 101.6, 293.15};
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A hot point, each argument of which may be wrong.
struct Asked {
  Heating heating{.density = 1200, .heat_capacity = 1650, .conductivity = 0.23, .contact_diameter = 1e-3};
  TemperatureShift shift = law;
  double temperature = 293.15;
  std::optional<Adhesion> adhesion = std::nullopt;
  ContactModel model{};

  void compute() const {
    const SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 2e4};
    const PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
    const double pressure = 2e5, velocity = 0.1;
    (void)friction(road, rubber, shift, heating, model, adhesion, std::span(&pressure, 1), std::span(&velocity, 1),
                   std::span(&temperature, 1));
  }
};

template <class Error = InvalidInput>
void check_refused(const Asked& asked, const std::string& told) {
  CAPTURE(told);
  std::string message = "nothing";
  try {
    asked.compute();
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message == told);
}

}  // namespace

TEST_CASE("a refusal of heat names the argument, its value and what is allowed") {
  Asked().compute();
  const auto heated = [](auto change) {
    Asked asked;
    change(asked.heating);
    return asked;
  };
  check_refused(heated([](Heating& h) { h.density = 1.2; }), "density = 1.2: must be in [100, 10000] kg/m^3");
  check_refused(heated([](Heating& h) { h.density = unknown; }), "density = nan: must be in [100, 10000] kg/m^3");
  check_refused(heated([](Heating& h) { h.heat_capacity = 1.65; }),
                "heat_capacity = 1.65: must be in [100, 10000] J/(kg K)");
  check_refused(heated([](Heating& h) { h.heat_capacity = 1e5; }),
                "heat_capacity = 100000: must be in [100, 10000] J/(kg K)");
  check_refused(heated([](Heating& h) { h.conductivity = 0; }), "conductivity = 0: must be in [0.01, 100] W/(m K)");
  check_refused(heated([](Heating& h) { h.conductivity = 230; }), "conductivity = 230: must be in [0.01, 100] W/(m K)");
  check_refused(heated([](Heating& h) { h.contact_diameter = -1e-3; }),
                "contact_diameter = -0.001: must be positive and finite");
  check_refused(heated([](Heating& h) { h.contact_diameter = std::numeric_limits<double>::infinity(); }),
                "contact_diameter = inf: must be positive and finite");
  check_refused(heated([](Heating& h) { h.macro_wavenumber = 10; }),
                "macro_wavenumber = 10: must be in the spectrum's band, [2000, 20000] 1/m");
  check_refused(heated([](Heating& h) { h.macro_wavenumber = 1e9; }),
                "macro_wavenumber = 1000000000: must be in the spectrum's band, [2000, 20000] 1/m");
  check_refused(heated([](Heating& h) { h.macro_wavenumber = unknown; }),
                "macro_wavenumber = nan: must be positive and finite");
  check_refused(heated([](Heating& h) { h.macro_area = 0; }), "macro_area = 0: must be in (0, 1]");
  check_refused(heated([](Heating& h) { h.macro_area = 1.5; }), "macro_area = 1.5: must be in (0, 1]");
  check_refused(heated([](Heating& h) {
                  h.macro_wavenumber = 6e3;
                  h.macro_area = 0.1;
                }),
                "macro_area = 0.1: must be left out where macro_wavenumber is given, which gives that area");
  check_refused(heated([](Heating& h) { h.interface_share = 0.5; }),
                "interface_share = 0.5: must be 1, its default, where there is no adhesion");
  Asked sticky = heated([](Heating& h) { h.interface_share = 1.5; });
  sticky.adhesion = Adhesion{8.3e6};
  check_refused(sticky, "interface_share = 1.5: must be in [0, 1]");
  for (const auto& [temperature, shown] : {std::pair{-1.0, "-1"}, {20.0, "20"}, {unknown, "nan"}}) {
    Asked asked;
    asked.temperature = temperature;
    check_refused(asked,
                  std::string("temperature = ") + shown + ": must be finite and at least 150; its unit is kelvin");
  }
  Asked unlawful;
  unlawful.shift = WLF{-1, 101.6, 293.15};
  check_refused(unlawful, "c1 = -1: must be positive and finite");
  Asked celsius;
  celsius.shift = WLF{8.86, 101.6, 20};
  check_refused(celsius, "reference_temperature = 20: must be finite and at least 150; its unit is kelvin");
  Asked checked;
  checked.model.method = Method::qag;
  check_refused(
      checked,
      "method = qag: must be gauss where heating is given, as GSL's methods have one temperature for all waves");
}

TEST_CASE("heat beyond what is known is out of range") {
  Asked cold;
  cold.shift = WLF{8.86, 51.6, 293.15};
  cold.temperature = 230;
  check_refused<OutOfRange>(
      cold, "temperature = 230: the WLF law has no a_T at or below reference_temperature - c2 = 241.55 K");
  Asked few;
  few.shift = ShiftTable(293.15, {263.15, 293.15, 293.65}, {3.0, 0.0, -0.05});
  check_refused<OutOfRange>(few,
                            "temperature = 293.15, velocity = 0.1: the rubber heats itself to 338.386 K: temperature = "
                            "338.386: shift factors are known in [263.15, 293.65] K");
  Asked melted;
  melted.heating.macro_area = 1e-3;
  melted.shift = WLF{0.01, 101.6, 293.15};
  check_refused<OutOfRange>(melted,
                            "temperature = 293.15, velocity = 0.1: the rubber heats itself to 803.878 K, above 700 K, "
                            "which it does not stand");
}
