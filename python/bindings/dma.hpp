// What the bindings of rubber and of its measurement share.
#pragma once

#include <optional>
#include <string>

#include "arrays.hpp"
#include "asperity/dma.hpp"

namespace asperity::python {

inline const auto extrapolations = {std::pair{"power-law", Extrapolation::power_law},
                                    std::pair{"clamp", Extrapolation::clamp}};

inline std::optional<Extrapolation> extrapolation_of(const std::optional<std::string>& name) {
  return name ? std::optional(choice<Extrapolation>("extrapolation", *name, extrapolations)) : std::nullopt;
}

/// Result of build_master_curve.
struct Built {
  MasterCurveBuild build;
};

/// A ShiftFactors, or what came out of build_master_curve.
const ShiftTable& shifts_of(const py::object& found);

/// MasterCurve.at_strain.
MasterCurve large_strain(const MasterCurve& curve, double strain, const py::iterable& sweeps,
                         const py::object& shift_factors);

}  // namespace asperity::python
