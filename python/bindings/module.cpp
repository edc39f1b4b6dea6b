// The private module asperity._core: positional functions and plain objects. Names, defaults, checks of kind,
// broadcasting, docstrings and values are Python's, in the package above it.
#include "asperity/version.hpp"
#include "topics.hpp"

PYBIND11_MODULE(_core, m, pybind11::mod_gil_not_used()) {
  using namespace asperity::python;
  m.attr("__version__") = asperity::version();
  bind_errors(m);
  bind_surface(m);
  bind_spectrum(m);
  bind_rubber(m);
  bind_dma(m);
  bind_contact(m);
  bind_sliding(m);
  bind_friction(m);
  bind_friction_map(m);
}
