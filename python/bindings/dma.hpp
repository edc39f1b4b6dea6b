// What the bindings of rubber and of its measurement share.
#pragma once

#include <optional>
#include <string>

#include "arrays.hpp"
#include "asperity/dma.hpp"
#include "scalars.hpp"

namespace asperity::python {

inline const auto extrapolations = {std::pair{"power-law", Extrapolation::power_law},
                                    std::pair{"clamp", Extrapolation::clamp}};

inline std::optional<Extrapolation> extrapolation_of(const Option& name) {
  return choice_or_none<Extrapolation>("extrapolation", name, extrapolations);
}

/// Result of build_master_curve.
struct Built {
  MasterCurveBuild build;
};

/// A ShiftFactors, or what came out of build_master_curve.
const ShiftTable& shifts_of(const py::object& found);

/// Of shift factors, alone and in a build.
py::object wlf(const WlfFit& fit);
py::object arrhenius(const ArrheniusFit& fit);
py::object shift_factor(const ShiftTable& shifts, const py::object& temperature);
inline constexpr auto wlf_text =
    "log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) through the shift factors by least squares (M. L. Williams, R. F. "
    "Landel, J. D. Ferry, J. Am. Chem. Soc. 77, 3701 (1955)): a WlfFit. Standard "
    "errors follow from the covariance of a build, and from the scatter about the law where there is more or no "
    "covariance; a row at the reference is no data. InvalidInput with fewer than 4 temperatures.";
inline constexpr auto arrhenius_text =
    "ln a_T = (E_a / R) (1 / T - 1 / T_ref) through the shift factors by least squares: an ArrheniusFit.";
inline constexpr auto shift_text =
    "a_T [-] at `temperature` [K], any shape: Steffen's interpolant of log10 a_T; OutOfRange outside of the measured "
    "temperatures.";

/// MasterCurve.at_strain.
MasterCurve large_strain(const MasterCurve& curve, Number<"strain"> strain, const Many<"sweeps">& sweeps,
                         const py::object& shift_factors);

}  // namespace asperity::python
