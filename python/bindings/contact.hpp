// The contact model from its arguments.
#pragma once

#include <string>

#include "asperity/contact.hpp"
#include "correction.hpp"

namespace asperity::python {

ContactModel contact_model(double poisson_ratio, const pybind11::object& correction, const std::string& form,
                           double rtol, const std::string& method);

}  // namespace asperity::python
