// Corrections as Python holds them, and as the core takes them.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "asperity/correction.hpp"
#include "scalars.hpp"

namespace asperity::python {

/// The core's correction, and what it was made from.
struct BoundLocalPeaks : LocalPeaks {
  pybind11::object source;
  std::optional<double> min_distance;
};
struct BoundPeaksThenGreenwoodWilliamson : PeaksThenGreenwoodWilliamson {
  pybind11::object source;
  std::optional<double> min_distance;
};

/// None is NoCorrection.
Correction correction_of(const pybind11::object& found);

Reading reading_of(const Option& name);
const char* name_of_reading(Reading reading);

}  // namespace asperity::python
