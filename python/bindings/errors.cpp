// The errors of the core as exceptions of the package.
#include "asperity/errors.hpp"

#include <pybind11/pybind11.h>

#include "topics.hpp"

namespace asperity::python {

namespace py = pybind11;

void bind_errors(py::module_& m) {
  const auto base = py::register_exception<Error>(m, "Error");
  const py::tuple invalid = py::make_tuple(base, py::reinterpret_borrow<py::object>(PyExc_ValueError));
  const auto describe = [](py::handle cls, const char* doc) { py::setattr(cls, "__doc__", py::str(doc)); };
  describe(base, "Base of all errors of asperity.");
  describe(py::register_exception<InvalidInput>(m, "InvalidInput", invalid),
           "An argument that cannot be used; the message names it, the value found and what is allowed.");
  describe(py::register_exception<OutOfRange>(m, "OutOfRange", base),
           "Asked outside of what was measured; nothing is extrapolated silently.");
  describe(py::register_exception<NotConverged>(m, "NotConverged", base),
           "The tolerance was not reached; the message has the estimate and its error.");
  for (const char* name : {"Error", "InvalidInput", "OutOfRange", "NotConverged"})
    py::setattr(m.attr(name), "__module__", py::str("asperity"));
}

}  // namespace asperity::python
