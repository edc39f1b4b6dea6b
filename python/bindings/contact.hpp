// The contact model from its arguments.
#pragma once

#include "asperity/contact.hpp"
#include "correction.hpp"
#include "scalars.hpp"

namespace asperity::python {

Form form_of(const Option& name);
ContactModel contact_model(double poisson_ratio, const pybind11::object& correction, Form form, double rtol,
                           const Option& method);

}  // namespace asperity::python
