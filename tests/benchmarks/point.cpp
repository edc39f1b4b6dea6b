// What a call costs: the C++ function timed from C++, and a bound function that does nothing with as many arguments.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <asperity/friction.hpp>
#include <chrono>
#include <string>
#include <vector>

namespace py = pybind11;
using namespace asperity;

namespace {

/// Seconds of one call at one pressure and velocity, of `runs` times `many` calls.
std::vector<double> seconds(double rms_height, double hurst, double q0, double q1, double equilibrium_modulus,
                            std::vector<double> moduli, std::vector<double> times, double pressure, double velocity,
                            double gamma, double rtol, int runs, int many) {
  const Spectrum road = SelfAffineSpectrum{.rms_height = rms_height, .hurst = hurst, .q0 = q0, .q1 = q1};
  const Rubber rubber = PronySeries(equilibrium_modulus, std::move(moduli), std::move(times));
  const Conditions conditions{.pressure = pressure, .correction = SFactor{gamma}, .rtol = rtol};
  double sum = 0;
  std::vector<double> found;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < many; ++k) sum += friction(road, rubber, conditions, {&velocity, 1}).mu[0];
    found.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / many);
  }
  if (!(sum > 0)) throw py::value_error("mu: must be positive");
  return found;
}

void empty(const py::object&, const py::object&, const py::object&, const py::object&, double, const py::object&,
           const py::object&, const std::string&, double, bool, const std::string&) {}

}  // namespace

PYBIND11_MODULE(point_timing, m) {
  m.def("seconds", &seconds);
  m.def("empty", &empty, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"),
        py::arg("velocity"), py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(),
        py::arg("adhesion") = py::none(), py::arg("form") = "exact", py::arg("rtol") = 1e-6,
        py::arg("contributions") = false, py::arg("method") = "gauss");
}
