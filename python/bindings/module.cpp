#include <pybind11/pybind11.h>

#include "asperity/version.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_core, m, py::mod_gil_not_used()) {
  using namespace asperity::python;
  m.doc() = "The compiled core of asperity.";
  m.attr("__version__") = asperity::version();
  m.def("_rebuild", &rebuilt);
  bind_errors(m);
  bind_surface(m);
  bind_spectrum(m);
  bind_scan_spectrum(m);
  bind_self_affine(m);
  bind_rubber(m);
  bind_dma(m);
  bind_master_curve_build(m);
  bind_prony_fit(m);
  bind_strain_sweep(m);
  bind_asperities(m);
  bind_correction(m);
  bind_asperity_correction(m);
  bind_contact(m);
  bind_friction(m);
  bind_fit_adhesion(m);
  bind_friction_map(m);
}
