// Self-affine surfaces: fitted to spectra, and made.
#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "parts.hpp"
#include "surface.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

const auto methods = {std::pair{"least-squares", FitMethod::least_squares}, std::pair{"slope", FitMethod::slope}};
const auto rolloffs = {std::pair{"find", Rolloff::find}, std::pair{"require", Rolloff::require},
                       std::pair{"none", Rolloff::none}};

std::map<std::string, double> standard_errors(const SelfAffineFit& f) {
  std::map<std::string, double> errors{{"rms_height", std::sqrt(f.covariance[0][0])},
                                       {"hurst", std::sqrt(f.covariance[1][1])}};
  if (f.spectrum.rolloff) errors["rolloff"] = std::sqrt(f.covariance[2][2]);
  return errors;
}

SelfAffineFit make_fit(const py::object& spectrum, const py::object& covariance, Number<"residual"> residual,
                       Whole<"rows"> rows) {
  if (rows < 0) throw InvalidInput("rows = " + std::to_string(rows.value) + ": must not be negative");
  const auto& law = object_of<SelfAffineSpectrum>(spectrum, "spectrum", "a SelfAffineSpectrum");
  SelfAffineFit fit{law, {}, residual, static_cast<std::size_t>(rows.value)};
  const std::array<double, 9> given = covariance_of(covariance);
  for (std::size_t i = 0; i < 9; ++i) fit.covariance[i / 3][i % 3] = given[i];
  return fit;
}

}  // namespace

void bind_self_affine(py::module_& m) {
  py::classh<SelfAffineFit> fit(m, "SelfAffineFit", "A power law through a measured spectrum (fit_self_affine).");
  fit.def(py::init(&make_fit), py::kw_only(), py::arg("spectrum"), py::arg("covariance"), py::arg("residual"),
          py::arg("rows"))
      .def_property_readonly(
          "rms_height", [](const SelfAffineFit& f) { return f.spectrum.rms_height; }, "h_rms on [q0, q1] [m].")
      .def_property_readonly(
          "hurst", [](const SelfAffineFit& f) { return f.spectrum.hurst; }, "H [-].")
      .def_property_readonly(
          "q0", [](const SelfAffineFit& f) { return f.spectrum.q0; }, "First row used [1/m].")
      .def_property_readonly(
          "q1", [](const SelfAffineFit& f) { return f.spectrum.q1; }, "Last row used [1/m].")
      .def_property_readonly(
          "rolloff", [](const SelfAffineFit& f) { return f.spectrum.rolloff; },
          "Where the flat part ends [1/m]; None where there is none.")
      .def_readonly("spectrum", &SelfAffineFit::spectrum, "The fit as a SelfAffineSpectrum.")
      .def_readonly("residual", &SelfAffineFit::residual, "Weighted rms of ln(C / fit) [-].")
      .def_readonly("rows", &SelfAffineFit::rows, "Rows of the spectrum that were used.")
      .def_property_readonly(
          "covariance",
          [](const SelfAffineFit& f) {
            std::vector<double> flat;
            for (const auto& row : f.covariance) flat.insert(flat.end(), row.begin(), row.end());
            return shaped(std::move(flat), {3, 3});
          },
          "Of rms_height [m], hurst [-] and rolloff [1/m], shape (3, 3), from the scatter of the rows about the fit; "
          "zeros where there is no roll-off.")
      .def_property_readonly("standard_errors", &standard_errors,
                             "{'rms_height': [m], 'hurst': [-]} and 'rolloff' [1/m] where there is one.");
  value_semantics(fit, {"spectrum", "covariance", "residual", "rows"});

  m.def(
      "fit_self_affine",
      [](const py::object& measured, OptionalNumber<"q_min"> q_min, OptionalNumber<"q_max"> q_max, const Option& method,
         const Option& rolloff) {
        const auto& spectrum = object_of<TabulatedSpectrum>(measured, "spectrum", "a TabulatedSpectrum");
        const FitOptions options{q_min, q_max, choice<FitMethod>("method", method, methods),
                                 choice<Rolloff>("rolloff", rolloff, rolloffs)};
        const py::gil_scoped_release release;
        return fit_self_affine(spectrum, options);
      },
      py::arg("spectrum"), py::kw_only(), py::arg("q_min") = py::none(), py::arg("q_max") = py::none(),
      py::arg("method") = "least-squares", py::arg("rolloff") = "find",
      R"(A self-affine spectrum through a measured one: H, the rms height on the band, a roll-off where there is one.

Least squares in ln C over ln q, each row weighted by its count where it has one; H = |slope| / 2 - 1 (Eq. 28), held at
1 where it comes out above by less than three of its standard errors.

Parameters
----------
spectrum : TabulatedSpectrum
q_min, q_max : float, optional
    Rows used [1/m], on trust. Without q_max they end with the last reliable row, without q_min they begin with the
    first reliable one, that of a scan with the first that has 0.4 of the highest density (its band begins there).
method : {"least-squares", "slope"}
    "slope": the article's Eq. 28 alone, a straight line through all rows with equal weights, no roll-off.
rolloff : {"find", "require", "none"}
    "find": a flat part below a roll-off is taken where it leaves clearly less than a straight line does (Schwarz's
    criterion); "require" refuses where it is not found, as on a scan smaller than lambda_0.

Returns
-------
SelfAffineFit

Raises
------
InvalidInput
    Fewer than 3 rows, a density of zero among them, a slope that gives no H in (0, 1], no roll-off where one is
    required.
)");
  m.def(
      "synthesize",
      [](const py::object& spectrum, const Named<std::array<long long, 2>, "shape">& shape,
         const Named<PixelSizeArgument, "pixel_size">& pixel_size, Whole<"seed"> seed, Number<"skewness"> skewness) {
        const auto [ny, nx] = shape.value;
        if (ny < 0 || nx < 0)
          throw InvalidInput("shape = (" + std::to_string(ny) + ", " + std::to_string(nx) + "): must be 2 x 2 or more");
        if (seed < 0) throw InvalidInput("seed = " + std::to_string(seed.value) + ": must not be negative");
        const HeightMap::Shape grid{static_cast<std::size_t>(ny), static_cast<std::size_t>(nx)};
        const Spectrum target = spectrum_of(spectrum);
        const py::gil_scoped_release release;
        return synthesize(target, grid, pixel_size_of(pixel_size), static_cast<std::uint64_t>(seed.value), skewness);
      },
      py::arg("spectrum"), py::kw_only(), py::arg("shape"), py::arg("pixel_size"), py::arg("seed"),
      py::arg("skewness") = 0.0,
      R"(A periodic map whose modes have exactly the densities of the spectrum, with random phases.

Parameters
----------
spectrum : SelfAffineSpectrum or TabulatedSpectrum
    What of its band the grid's modes, from 2 pi / side to the Nyquist corner, do not hold is left out.
shape : (int, int)
    (ny, nx), 2 or more each.
pixel_size : float or (float, float)
    [m], or (dy, dx).
seed : int
    The same map for the same seed on every machine (splitmix64), to rounding.
skewness : float
    Of the heights [-], from -2 (worn) to 2, met to 1e-3: random phases are bent so that the heights follow a gamma
    distribution (Wilson and Hilferty's) as nearly as the densities allow. 0 leaves the phases random, and the skewness
    that chance gives them.

Returns
-------
HeightMap

Raises
------
InvalidInput
    The band holds no mode of the grid at all.
NotConverged
    A skewness that the long waves of this map are too few for.
)");
}

}  // namespace asperity::python
