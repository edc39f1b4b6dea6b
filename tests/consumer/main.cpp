// A host program with its own GSL error handler, FFTW and Eigen, all of which must stay as they are.
#include <fftw3.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <Eigen/Dense>
#include <asperity/friction.hpp>
#include <asperity/sliding.hpp>
#include <asperity/version.hpp>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstring>

namespace {

int calls = 0;
void handler(const char*, const char*, int, int) { ++calls; }

bool check(bool fine, const char* what) {
  std::printf("%s: %s\n", fine ? "ok" : "FAILED", what);
  return fine;
}

}  // namespace

int main() {
  bool fine = check(std::strcmp(asperity::version(), ASPERITY_VERSION) == 0, "headers and library agree");
  gsl_set_error_handler(&handler);

  const asperity::SelfAffineSpectrum road{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e6};
  const asperity::PronySeries rubber(3e6, {1e8, 1e9}, {1e-3, 1e-6});
  const double velocity[] = {1e-3, 1.0};
  const asperity::Friction f = asperity::friction(road, rubber, {.pressure = 81e3}, velocity);
  std::printf("mu = %.6f %.6f\n", f.mu[0], f.mu[1]);
  fine &= check(f.mu[0] > 0 && f.error_estimate[0] < 1e-6 * f.mu[0], "friction within its tolerance");

  const asperity::Friction partial =
      asperity::friction(road, rubber, {.pressure = 81e3, .correction = asperity::PartialContact{}}, velocity);
  fine &= check(partial.mu[0] > 0 && partial.error_estimate[0] < 1e-6 * partial.mu[0] &&
                    partial.contact_area[0] > f.contact_area[0],
                "partial contact within its tolerance");

  try {
    (void)asperity::friction(road, rubber, {.pressure = -1}, velocity);
    fine = check(false, "a negative pressure is refused");
  } catch (const asperity::InvalidInput& error) {
    fine &= check(std::strstr(error.what(), "pressure = -1") != nullptr, error.what());
  }
  const asperity::Heating tread{.density = 1200, .heat_capacity = 1650, .conductivity = 0.23, .contact_diameter = 1e-3};
  const double pressure[] = {81e3, 81e3}, temperature[] = {293.15, 293.15};
  const asperity::FlashFriction heated = asperity::friction(road, rubber, asperity::WLF{8.86, 101.6, 293.15}, tread, {},
                                                            {}, pressure, velocity, temperature);
  std::printf("hot mu = %.6f %.6f at %.2f %.2f K\n", heated.hot.mu[0], heated.hot.mu[1], heated.hot.temperature[0],
              heated.hot.temperature[1]);
  fine &= check(heated.cold.mu[0] == f.mu[0] && heated.hot.temperature[1] > 293.15 && heated.branches[0] == 1,
                "friction heats its rubber");

  (void)asperity::power_spectrum(asperity::synthesize(road, {64, 64}, {1e-4, 1e-4}, 1));

  const asperity::SelfAffineSpectrum waves{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2000, .q1 = 16000};
  const asperity::SlidingContact contact =
      asperity::slide(asperity::synthesize(waves, {32, 32}, {1e-4, 1e-4}, 1), rubber, 1e5, 0.1,
                      {.continuation = asperity::Continuation::periodic});
  fine &=
      check(contact.error < 1e-6 && contact.hysteresis > 0 && contact.contact_area < 1, "sliding contact is solved");

  const asperity::HeightMap scan = asperity::synthesize(waves, {64, 64}, {1e-4, 1e-4}, 1);
  const asperity::ScanContact exact(scan, asperity::Continuation::periodic);
  const asperity::Spectrum rings = asperity::power_spectrum(scan, asperity::Window::none, std::nullopt);
  const asperity::Friction of_scan = asperity::friction(asperity::truncated(rings, std::nullopt, 16000), rubber,
                                                        {.pressure = 1e5, .correction = exact}, velocity);
  fine &= check(of_scan.mu[0] > 0 && exact.contacts().size() > 4, "the contact of the scan itself is solved");

  // An integral that cannot converge makes GSL call the handler of this host, and no other.
  gsl_integration_workspace* const workspace = gsl_integration_workspace_alloc(2);
  gsl_function steep{[](double x, void*) { return std::sin(1 / x); }, nullptr};
  double value = 0, error = 0;
  gsl_integration_qag(&steep, 1e-9, 1, 0, 1e-12, 2, GSL_INTEG_GAUSS15, workspace, &value, &error);
  gsl_integration_workspace_free(workspace);
  fine &= check(calls == 1, "the host's GSL error handler is its own");
  fine &= check(gsl_set_error_handler(nullptr) == &handler, "the host's GSL error handler was left alone");

  std::complex<double> mode[3];
  double heights[4] = {1, 2, 3, 4};
  const fftw_plan plan = fftw_plan_dft_r2c_1d(4, heights, reinterpret_cast<fftw_complex*>(mode), FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  fine &= check(mode[0] == 10.0, "the host's FFTW works beside ours");

  // The solver that our detrending uses too, instantiated here with this host's flags.
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3) * 2;
  const Eigen::VectorXd solution = matrix.completeOrthogonalDecomposition().solve(Eigen::VectorXd::Ones(3));
  const asperity::HeightMap tilted(std::vector<double>{0, 1, 2, 1, 2, 3, 2, 3, 4.5}, {3, 3}, {1, 1});
  fine &= check(solution[0] == 0.5 && tilted.detrend(asperity::Detrend::plane).statistics().rms_height < 0.2,
                "the host's Eigen works beside ours");
  return fine ? 0 : 1;
}
