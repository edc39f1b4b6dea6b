// The adhesion of Eq. 23 fitted to measured friction.
#include <pybind11/stl.h>

#include <cmath>
#include <numbers>

#include "arguments.hpp"
#include "arrays.hpp"
#include "asperity/friction.hpp"
#include "contact.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// An Adhesion and how well it is known.
struct FittedAdhesion : Adhesion {
  std::array<double, 9> covariance;
  double residual;
  std::vector<bool> outliers;
  Shape shape;  // of outliers
  std::vector<std::string> notes;

  [[nodiscard]] double error(std::size_t i) const { return std::sqrt(covariance[4 * i]); }
};

FittedAdhesion made(Number<"shear_stress"> tau, Number<"reference_velocity"> v0, Number<"width"> c,
                    const py::object& covariance, Number<"residual"> residual, const py::object& outliers,
                    const Sentences<"notes">& notes) {
  FittedAdhesion fit{{tau, v0, c}, covariance_of(covariance), residual, {}, {}, notes};
  validate(fit);
  const Array aside = real_array(outliers, "outliers");
  fit.outliers.assign(aside.data(), aside.data() + aside.size());
  fit.shape.assign(aside.shape(), aside.shape() + aside.ndim());
  return fit;
}

py::object outliers_of(const FittedAdhesion& f) {
  py::array_t<bool> result(f.shape);
  std::copy(f.outliers.begin(), f.outliers.end(), result.mutable_data());
  return frozen(std::move(result));
}

FixedAdhesion fixed_of(const py::object& found) {
  if (!py::isinstance<py::dict>(found)) throw InvalidInput("fixed = " + brief(found) + ": must be a dict");
  FixedAdhesion fixed;
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(found)) {
    std::optional<double>& place = *choice<std::optional<double>*>("fixed", {py::reinterpret_borrow<py::object>(key)},
                                                                   {{"shear_stress", &fixed.shear_stress},
                                                                    {"reference_velocity", &fixed.reference_velocity},
                                                                    {"width", &fixed.width}});
    const std::string name = "fixed: " + py::str(key).cast<std::string>();
    const Array number = real_array(value, name);
    if (number.ndim() != 0) throw InvalidInput(name + " = " + brief(value) + ": must be a number");
    place = *number.data();
  }
  return fixed;
}

FittedAdhesion fit(const py::object& spectrum, const py::object& rubber, const py::object& velocity,
                   const py::object& mu, const py::object& pressure, const py::object& fixed,
                   Number<"poisson_ratio"> poisson_ratio, const py::object& correction, const Option& form,
                   Number<"rtol"> rtol, const Option& method) {
  const Broadcast b = broadcast({{"pressure", pressure}, {"velocity", velocity}});
  const Array measured = real_array(mu, "mu");
  if (Shape(measured.shape(), measured.shape() + measured.ndim()) != b.shape)
    throw InvalidInput("mu has shape " + py::str(measured.attr("shape")).cast<std::string>() +
                       ": must be that of pressure and velocity together, " +
                       py::str(py::tuple(py::cast(b.shape))).cast<std::string>());
  const ContactModel model = contact_model(poisson_ratio, correction, form_of(form), rtol, method);
  const FixedAdhesion held = fixed_of(fixed);
  const Spectrum surface = spectrum_of(spectrum);
  const Rubber material = rubber_of(rubber);
  AdhesionFit f;
  {
    const py::gil_scoped_release release;
    f = fit_adhesion(surface, material, model, b.columns[0], b.columns[1],
                     {measured.data(), static_cast<std::size_t>(measured.size())}, held);
  }
  return {f.adhesion, f.covariance, f.residual, std::move(f.outliers), b.shape, std::move(f.notes)};
}

}  // namespace

void bind_fit_adhesion(py::module_& m) {
  py::classh<FittedAdhesion, Adhesion> fitted(m, "AdhesionFit", R"(An Adhesion that was fitted (fit_adhesion).

An Adhesion like any other, tau_f0 [Pa], v0 [m/s], c [-], that also knows how well the measurement determines it.
)");
  fitted
      .def(py::init(&made), py::kw_only(), py::arg("shear_stress"), py::arg("reference_velocity"), py::arg("width"),
           py::arg("covariance"), py::arg("residual"), py::arg("outliers"), py::arg("notes") = py::tuple())
      .def_property_readonly(
          "covariance",
          [](const FittedAdhesion& f) {
            return frozen(shaped<double>({f.covariance.begin(), f.covariance.end()}, {3, 3}));
          },
          "Shape (3, 3): of shear_stress [Pa], reference_velocity [m/s], width [-]; rows of held ones are 0.")
      .def_readonly("residual", &FittedAdhesion::residual, "Robust standard deviation of ln(mu / fit) [-].")
      .def_property_readonly("outliers", &outliers_of,
                             "Points put aside, bool, in the shape of mu: more than 4.685 residuals off the fit.")
      .def_property_readonly(
          "notes", [](const FittedAdhesion& f) { return py::tuple(py::cast(f.notes)); }, "What a reader must know.")
      .def_property_readonly(
          "adhesion", [](const FittedAdhesion& f) { return Adhesion{f}; }, "The parameters alone, an Adhesion.")
      .def_property_readonly(
          "standard_errors",
          [](const FittedAdhesion& f) {
            return std::map<std::string, double>{
                {"shear_stress", f.error(0)}, {"reference_velocity", f.error(1)}, {"width", f.error(2)}};
          },
          "{'shear_stress': [Pa], 'reference_velocity': [m/s], 'width': [-]} from the scatter of the points; 0 where "
          "held.")
      .def_property_readonly(
          "log10_reference_velocity_error",
          [](const FittedAdhesion& f) { return f.error(1) / (std::numbers::ln10 * f.reference_velocity); },
          "Standard error of log10 v0 [-]: v0 is as uncertain upwards as downwards in the logarithm.");
  value_semantics(fitted,
                  {"shear_stress", "reference_velocity", "width", "covariance", "residual", "outliers", "notes"});
  m.def("fit_adhesion", &fit, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("velocity"), py::arg("mu"),
        py::arg("pressure"), py::arg("fixed") = py::dict(), py::arg("poisson_ratio") = 0.5,
        py::arg("correction") = py::none(), py::arg("form") = "exact", py::arg("rtol") = 1e-6,
        py::arg("method") = "gauss",
        R"(tau_f0, v0 and c of Eq. 23 from measured friction.

mu = mu_H + (tau_f0 / sigma0) (A/A0) exp(-c log10(v / v0)^2), with mu_H and A/A0 as `friction` computes them, is fitted
in ln mu: repeated friction measurements scatter in proportion to mu, so that a point counts by its relative error.
Outliers, up to 30 % of the points in trials, are put aside by Tukey's biweight about a robust scale (an M-estimate that
starts from S-estimates; Yohai 1987, Ann. Stat. 15, 642). tau_f0 goes with the cut-off of the spectrum that the area is
taken at.

Parameters
----------
spectrum : SelfAffineSpectrum or TabulatedSpectrum
rubber : PronySeries or MasterCurve
velocity, pressure : array_like
    v [m/s] and sigma0 [Pa], positive; they broadcast. Several pressures at once are fitted together.
mu : array_like
    Measured, positive [-], in the broadcast shape of velocity and pressure. Repeats are entries of their own.
fixed : dict
    Parameters to hold, up to two of shear_stress [Pa], reference_velocity [m/s], width [-]: {"width": 0.1}.
poisson_ratio, correction, form, rtol, method
    As of `friction`.

Returns
-------
AdhesionFit
    An Adhesion with covariance, standard errors, outliers and notes. The errors take the hysteresis and the area as
    exact.

Raises
------
InvalidInput
    Fewer different velocities than fitted parameters and one; hysteresis alone above mu; points that leave a parameter
    open: tau_f0 or c uncertain by more than half, v0 by more than a decade. The message says which, to be held by
    `fixed`, rather than to return a number that the points do not support.
OutOfRange, NotConverged
    As of `friction`.

Examples
--------
>>> import asperity, numpy
>>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
>>> rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
>>> scene = {"pressure": 81e3, "velocity": numpy.geomspace(1e-5, 1, 20)}
>>> truth = asperity.Adhesion(shear_stress=8.3e6)
>>> mu = asperity.friction(road, rubber, adhesion=truth, **scene).mu
>>> fit = asperity.fit_adhesion(road, rubber, mu=mu, **scene)
>>> round(fit.shear_stress / 1e6, 6), round(fit.reference_velocity, 6), round(fit.width, 6)
(8.3, 0.006, 0.1)
)");
}

}  // namespace asperity::python
