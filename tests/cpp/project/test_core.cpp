// Every part of the core once, for sanitizers and valgrind: what it computes is tested through Python.
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "asperity/friction.hpp"
#include "asperity/gradients.hpp"
#include "asperity/scan_contact.hpp"
#include "asperity/sliding.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

const WLF law{8.86, 101.6, 293.15};
const PronySeries tread(3e6, {1e7, 1e8, 1e9}, {1e-2, 1e-4, 1e-6});

/// A rough map of 1 cm with drop-outs.
HeightMap scan(std::size_t n) {
  const SelfAffineSpectrum road{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2500, .q1 = 2e4};
  const HeightMap made = synthesize(road, {n, n}, {1e-2 / static_cast<double>(n), 1e-2 / static_cast<double>(n)}, 1);
  std::vector<double> z(n * n);
  for (std::size_t y = 0; y < n; ++y) made.read_row(y, z.data() + y * n);
  for (std::size_t i = 7; i < z.size(); i += 41) z[i] = std::numeric_limits<double>::quiet_NaN();
  return {std::move(z), made.shape(), made.pixel_size()};
}

/// Isotherms of `tread` from 0.1 to 30 Hz.
MasterCurveBuild built() {
  std::vector<Isotherm> isotherms;
  for (double t = 253.15; t < 330; t += 6) {
    std::vector<double> w, storage, loss;
    for (int i = 0; i < 12; ++i) {
      w.push_back(std::pow(300, i / 11.0));
      const auto e = std::get<PronySeries>(shifted(tread, law, t)).modulus(w.back());
      storage.push_back(e.real());
      loss.push_back(e.imag());
    }
    isotherms.emplace_back(t, w, storage, loss);
  }
  return build_master_curve(isotherms, {.reference_temperature = 293.15});
}

bool possible(const std::vector<double>& mu) {
  for (const double one : mu)
    if (!(one >= 0 && one < 100)) return false;
  return !mu.empty();
}

}  // namespace

TEST_CASE("from a scan and isotherms to friction, with all corrections and heat") {
  const HeightMap map = scan(96).fill_dropouts();
  const std::vector<double> peaks = map.local_peaks(5e-4);
  const TabulatedSpectrum rings = power_spectrum(map);
  const SelfAffineFit fit = fit_self_affine(rings);
  CHECK(fit.spectrum.hurst > 0.3);
  CHECK(possible(autocorrelation(rings, std::vector{0.0, 1e-4})));
  CHECK(possible(log_binned(isotropic(line_spectrum(map)), 10).density()));
  const MasterCurveBuild build = built();
  const MasterCurve& curve = build.master_curve;
  const PronyFit series = fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus());
  CHECK(series.causal);
  CHECK(draw_master_curve(build, 1).points.size() == build.points.size());
  const std::vector<double> velocity{1e-3, 1e-2}, pressure(2, 1e5), temperature(2, 293.15);
  const Adhesion adhesion{.shear_stress = 5e6};
  const Heating heating{.density = 1200, .heat_capacity = 1650, .conductivity = 0.23, .contact_diameter = 1e-3};
  for (const Spectrum& road : {Spectrum(rings), Spectrum(SelfAffineSpectrum{1e-4, 0.8, 2500, 2e4, 4e3})})
    for (const Rubber& rubber : {Rubber(series.series), Rubber(curve), Rubber(tread)})
      for (const Correction& correction :
           {Correction(NoCorrection{}), Correction(SFactor{0.4}), Correction(NayakSFactor{}),
            Correction(ImplicitSFactor{}), Correction(AffineShift{2}),
            Correction(GreenwoodWilliamson{.z_max = 4e-4, .z_min = -4e-4}), Correction(PartialContact{})}) {
        const ContactModel model{.correction = correction, .rtol = 1e-4};
        CHECK(possible(friction(road, rubber, model, adhesion, pressure, velocity, true).mu));
        CHECK(possible(friction(road, rubber, law, heating, model, adhesion, pressure, velocity, temperature).hot.mu));
        CHECK(gradients(road, rubber, model, adhesion, pressure, velocity).pressure.size() == 2);
      }
  CHECK(possible(friction(rings, tread, {.correction = LocalPeaks(peaks)}, {}, pressure, velocity).mu));
}

TEST_CASE("contacts of the scan itself, and a fit of the adhesion") {
  const HeightMap map = scan(32).fill_dropouts();
  const SlidingContact contact = slide(map, tread, 3e5, 0.1, {.continuation = Continuation::periodic, .rtol = 1e-4});
  CHECK(contact.contact_area > 0);
  const std::vector<double> velocity{1e-4, 1e-3, 1e-2, 0.1, 1}, pressure(5, 2e5);
  const Spectrum road = power_spectrum(map);
  const ContactModel exact{.correction = ScanContact(map), .rtol = 1e-4};
  CHECK(possible(friction(road, tread, exact, {}, pressure, velocity).mu));
  const Friction points = friction(road, tread, ContactModel{}, Adhesion{.shear_stress = 5e6}, pressure, velocity);
  const AdhesionFit fit = fit_adhesion(road, tread, ContactModel{}, pressure, velocity, points.mu);
  CHECK(fit.adhesion.shear_stress == doctest::Approx(5e6).epsilon(1e-3));
}

TEST_CASE("tables with zeros, jumps and fronts, and extrapolated moduli") {
  for (const Row& row : reference("friction_measured")) {
    CAPTURE(row.text("case"));
    const TabulatedSpectrum surface(row.list("table_wavenumber"), row.list("table_density"));
    std::optional<Extrapolation> extrapolation;
    if (const std::string& beyond = row.text("extrapolation"); !beyond.empty())
      extrapolation = beyond == "clamp" ? Extrapolation::clamp : Extrapolation::power_law;
    const Rubber rubber =
        row.text("table_frequency").empty()
            ? Rubber(PronySeries(row.number("equilibrium_modulus"), row.list("moduli"), row.list("relaxation_times")))
            : Rubber(MasterCurve(row.list("table_frequency"), row.list("table_storage"), row.list("table_loss"),
                                 extrapolation));
    const double velocity = row.number("velocity");
    const Conditions conditions{.pressure = row.number("pressure"), .poisson_ratio = row.number("poisson_ratio")};
    const Friction result = friction(surface, rubber, conditions, std::span(&velocity, 1));
    CHECK_NEAR(result.hysteresis[0], row.number("hysteresis"), 1e-6, 0);
  }
}
