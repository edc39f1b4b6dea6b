#include "asperity/contact.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "contact.hpp"
#include "parts.hpp"

namespace asperity::python {

namespace {

const auto forms = {std::pair{"exact", Form::exact}, std::pair{"interpolated", Form::interpolated}};
const auto methods = {std::pair{"gauss", Method::gauss}, std::pair{"qag", Method::qag}, std::pair{"qags", Method::qags},
                      std::pair{"cquad", Method::cquad}};

using Spans = std::vector<double> (*)(const Spectrum&, const Rubber&, const ContactModel&, std::span<const double>,
                                      std::span<const double>, std::span<const double>);

/// Binds one of the functions of pressure, velocity and wavenumber, all of which take the same arguments.
template <Spans function>
void bind_over_wavenumber(py::module_& m, const char* name, bool wavenumber_required, const char* doc) {
  const auto call = [](const py::object& spectrum, const py::object& rubber, const py::object& pressure,
                       const py::object& velocity, Number<"poisson_ratio"> poisson_ratio, const py::object& correction,
                       const Option& form, const py::object& wavenumber, Number<"rtol"> rtol, const Option& method) {
    Broadcast b = broadcast({{"pressure", pressure}, {"velocity", velocity}});
    const ContactModel model = contact_model(poisson_ratio, correction, form_of(form), rtol, method);
    std::vector<double> q, result;
    if (!wavenumber.is_none()) {
      const Array array = real_array(wavenumber, "wavenumber");
      if (array.ndim() > 1)
        throw InvalidInput("wavenumber has " + std::to_string(array.ndim()) + " dimensions: must have 0 or 1");
      q.assign(array.data(), array.data() + array.size());
      if (q.empty()) throw InvalidInput("wavenumber has 0 entries: must be 1 or more");
      if (array.ndim() == 1) b.shape.push_back(array.size());
    }
    const Spectrum surface = spectrum_of(spectrum);
    const Rubber material = rubber_of(rubber);
    {
      const py::gil_scoped_release release;
      result = function(surface, material, model, b.columns[0], b.columns[1], q);
    }
    return shaped(std::move(result), b.shape);
  };
  if (wavenumber_required)
    m.def(name, call, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"), py::arg("velocity"),
          py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(), py::arg("form") = "exact",
          py::arg("wavenumber"), py::arg("rtol") = 1e-6, py::arg("method") = "gauss", doc);
  else
    m.def(name, call, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"), py::arg("velocity"),
          py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(), py::arg("form") = "exact",
          py::arg("wavenumber") = py::none(), py::arg("rtol") = 1e-6, py::arg("method") = "gauss", doc);
}

}  // namespace

Form form_of(const Option& name) { return choice<Form>("form", name, forms); }

ContactModel contact_model(double poisson_ratio, const py::object& correction, Form form, double rtol,
                           const Option& method) {
  return {poisson_ratio, correction_of(correction), form, rtol, choice<Method>("method", method, methods)};
}

void bind_contact(py::module_& m) {
  bind_over_wavenumber<&contact_area>(m, "contact_area", false, R"(Real over nominal contact area A/A0 [-].

A/A0 = erf(1 / (2 sqrt G)), G(q) = (1/8) int_q0^q k^3 C(k) I2(v k) dk / ((1 - nu^2) sigma0)^2 (Persson 2001; the
article's Eq. 7 is its interpolation).

Parameters
----------
spectrum : SelfAffineSpectrum or TabulatedSpectrum
rubber : PronySeries or MasterCurve
pressure, velocity : array_like
    sigma0 [Pa] and v [m/s], positive; they broadcast.
poisson_ratio : float
    In [0, 0.5].
correction : SFactor, NayakSFactor, AffineShift, LocalPeaks, GreenwoodWilliamson, PeaksThenGreenwoodWilliamson or None
    None is plain Persson.
form : {"exact", "interpolated"}
    "interpolated" is Eq. 7, (1 + (pi G)^1.5)^(-1/3), which differs by -2.8 to +2.6 %.
wavenumber : array_like, shape (n,) or (), optional
    Where the surface is cut [1/m], within its band: appended as last axis. By default q1.
rtol : float
    Relative tolerance, 1e-12 to 0.1.
method : {"gauss", "qag", "qags", "cquad"}
    Gauss-Legendre panels, or GSL's adaptive integration of that name to check them with, slower by hundreds of times.

Returns
-------
float or ndarray
    In the broadcast shape of pressure and velocity, then wavenumber.

Raises
------
InvalidInput
OutOfRange
    v q0 or v q1 outside of a measured master curve, wavenumber outside of the band.
NotConverged
)");
  m.def(
      "contact_notes",
      [](const py::object& spectrum, const py::object& rubber, const py::object& pressure, const py::object& velocity,
         Number<"poisson_ratio"> poisson_ratio, const py::object& correction, const Option& form, Number<"rtol"> rtol,
         const Option& method) {
        const Broadcast b = broadcast({{"pressure", pressure}, {"velocity", velocity}});
        const ContactModel model = contact_model(poisson_ratio, correction, form_of(form), rtol, method);
        const Spectrum surface = spectrum_of(spectrum);
        const Rubber material = rubber_of(rubber);
        std::vector<std::string> notes;
        {
          const py::gil_scoped_release release;
          notes = contact_notes(surface, material, model, b.columns[0], b.columns[1]);
        }
        return py::tuple(py::cast(notes));
      },
      py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"), py::arg("velocity"),
      py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(), py::arg("form") = "exact",
      py::arg("rtol") = 1e-6, py::arg("method") = "gauss",
      R"(Where the theory or its input leaves its range at these pressures [Pa] and velocities [m/s], in sentences.

What `friction` returns as notes, for those who ask for the contact area alone. Arguments as for `contact_area`; a tuple
of str.
)");
  bind_over_wavenumber<&mean_pressure>(m, "mean_pressure", false, R"(Mean contact pressure <sigma> = sigma0 A0 / A [Pa]
(Eq. 1) at a magnification; infinite where there is no contact. Arguments, shape and errors as for `contact_area`.
)");
  bind_over_wavenumber<&correction_factor>(m, "correction_factor", true, R"(The correction factor CF of Section 6.1 [-].

A_m C_m / (A0 C) = (A_m / A0) / p_T^2 with the corrected area A_m; for the S factor on the friction PF-CF = S A / A0 with
the uncorrected A. It is what the integrand of Eq. 22 is weighted with, 1 in full contact. Arguments, shape and errors
as for `contact_area`.
)");
  m.def(
      "pressure_distribution",
      [](const py::object& stress, const py::object& spectrum, const py::object& rubber, const py::object& pressure,
         const py::object& velocity, OptionalNumber<"wavenumber"> wavenumber, Number<"poisson_ratio"> poisson_ratio,
         const py::object& correction, Number<"rtol"> rtol, const Option& method) {
        Broadcast b = broadcast({{"stress", stress}, {"pressure", pressure}, {"velocity", velocity}});
        const ContactModel model = contact_model(poisson_ratio, correction, Form::exact, rtol, method);
        const Spectrum surface = spectrum_of(spectrum);
        const Rubber material = rubber_of(rubber);
        std::vector<double> result;
        {
          const py::gil_scoped_release release;
          result = pressure_distribution(surface, material, model, b.columns[0], b.columns[1], b.columns[2],
                                         wavenumber.value.value_or(band(surface)[1]));
        }
        return shaped(std::move(result), b.shape);
      },
      py::arg("stress"), py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"),
      py::arg("velocity"), py::arg("wavenumber") = py::none(), py::arg("poisson_ratio") = 0.5,
      py::arg("correction") = py::none(), py::arg("rtol") = 1e-6, py::arg("method") = "gauss",
      R"(Probability density P(sigma) of the contact pressure [1/Pa], the solution of Eq. 4.

A Gaussian of variance 2 G sigma0^2 about sigma0 minus its mirror image at -sigma0. Its integral over sigma > 0 is A/A0 and
its first moment sigma0; the delta at sigma = 0, of weight 1 - A/A0, is left out.

Parameters
----------
stress : array_like
    sigma >= 0 [Pa]; broadcasts with pressure and velocity.
wavenumber : float, optional
    The magnification [1/m], above q0; by default q1.

The others, and the errors, as for `contact_area`.

Returns
-------
float or ndarray
    In the broadcast shape of stress, pressure and velocity.
)");
}

}  // namespace asperity::python
