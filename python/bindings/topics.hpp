// The parts of the module, each binding one topic of the core.
#pragma once

#include <pybind11/pybind11.h>

namespace asperity::python {

void bind_errors(pybind11::module_& m);
void bind_surface(pybind11::module_& m);
void bind_spectrum(pybind11::module_& m);
void bind_rubber(pybind11::module_& m);
void bind_dma(pybind11::module_& m);
void bind_contact(pybind11::module_& m);
void bind_sliding(pybind11::module_& m);
void bind_friction(pybind11::module_& m);
void bind_friction_map(pybind11::module_& m);

}  // namespace asperity::python
