#include "asperity/friction.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "contact.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct FrictionTag {
  static constexpr Field fields[] = {{"mu", Holds::numbers},
                                     {"hysteresis", Holds::numbers},
                                     {"adhesion", Holds::numbers},
                                     {"contact_area", Holds::numbers},
                                     {"shift_factor", Holds::numbers},
                                     {"pressure", Holds::numbers},
                                     {"velocity", Holds::numbers},
                                     {"error_estimate", Holds::numbers},
                                     {"extrapolated_share", Holds::numbers},
                                     {"notes", Holds::sentences},
                                     {"wavenumber", Holds::numbers_or_none},
                                     {"dmu_dlnq", Holds::numbers_or_none},
                                     {"decade_edges", Holds::numbers_or_none},
                                     {"decade_share", Holds::numbers_or_none}};
};

Record<FrictionTag> compute(const py::object& spectrum, const py::object& rubber, const py::object& pressure,
                            const py::object& velocity, Number<"poisson_ratio"> poisson_ratio,
                            const py::object& correction, const py::object& adhesion, const Option& form,
                            Number<"rtol"> rtol, Flag<"contributions"> contributions, const Option& method) {
  const Broadcast b = broadcast({{"pressure", pressure}, {"velocity", velocity}});
  const ContactModel model = contact_model(poisson_ratio, correction, form_of(form), rtol, method);
  const Spectrum surface = spectrum_of(spectrum);
  const Rubber material = rubber_of(rubber);
  std::optional<Adhesion> sticking;
  if (!adhesion.is_none()) sticking = object_of<Adhesion>(adhesion, "adhesion", "an Adhesion or None");
  Friction f;
  {
    const py::gil_scoped_release release;
    f = friction(surface, material, model, sticking, b.columns[0], b.columns[1], contributions);
  }
  Record<FrictionTag> record;
  py::dict& values = record.values;
  values["mu"] = shaped(std::move(f.mu), b.shape);
  values["hysteresis"] = shaped(std::move(f.hysteresis), b.shape);
  values["adhesion"] = shaped(std::move(f.adhesion), b.shape);
  values["contact_area"] = shaped(std::move(f.contact_area), b.shape);
  values["shift_factor"] = shaped(std::move(f.shift_factor), b.shape);
  values["pressure"] = shaped(std::move(f.pressure), b.shape);
  values["velocity"] = shaped(std::move(f.velocity), b.shape);
  values["error_estimate"] = shaped(std::move(f.error_estimate), b.shape);
  values["extrapolated_share"] = shaped(std::move(f.extrapolated_share), b.shape);
  values["notes"] = py::tuple(py::cast(f.notes));
  for (const char* name : {"wavenumber", "dmu_dlnq", "decade_edges", "decade_share"}) values[name] = py::none();
  if (f.contributions) {
    Contributions& c = *f.contributions;
    const auto appended = [&](std::size_t columns) {
      Shape shape = b.shape;
      shape.push_back(static_cast<py::ssize_t>(columns));
      return shape;
    };
    values["dmu_dlnq"] = shaped(std::move(c.dmu_dlnq), appended(c.wavenumber.size()));
    values["decade_share"] = shaped(std::move(c.decade_share), appended(c.decade_edges.size() - 1));
    values["wavenumber"] = flat(std::move(c.wavenumber));
    values["decade_edges"] = flat(std::move(c.decade_edges));
  }
  return record;
}

}  // namespace

void bind_friction(py::module_& m) {
  py::classh<Adhesion> adhesion(m, "Adhesion", R"(Friction of the real contact area (Eq. 23).

mu_A = (tau_f0 / sigma0) (A/A0) exp(-c log10(v / v0)^2).

Parameters
----------
shear_stress : float
    tau_f0 [Pa]; 5.3 to 8.3 MPa in the article.
reference_velocity : float
    v0 [m/s].
width : float
    c [-].

Raises
------
InvalidInput
)");
  adhesion
      .def(py::init([](Number<"shear_stress"> tau, Number<"reference_velocity"> v0, Number<"width"> c) {
             const Adhesion a{tau, v0, c};
             validate(a);
             return a;
           }),
           py::kw_only(), py::arg("shear_stress"), py::arg("reference_velocity") = 6e-3, py::arg("width") = 0.1)
      .def_readonly("shear_stress", &Adhesion::shear_stress, "tau_f0 [Pa].")
      .def_readonly("reference_velocity", &Adhesion::reference_velocity, "v0 [m/s].")
      .def_readonly("width", &Adhesion::width, "c [-].");
  value_semantics(adhesion, {"shear_stress", "reference_velocity", "width"});

  bind_record<FrictionTag>(m, "Friction", R"(What `friction` returns. Scalars for scalar arguments, else arrays.

mu : total friction coefficient, hysteresis + adhesion [-].
hysteresis, adhesion : mu_H of Eq. 22, mu_A of Eq. 23 [-].
contact_area : A/A0 at q1 [-].
shift_factor : p_T [-]; 1 where nothing is shifted, infinite without contact.
pressure, velocity : as given, broadcast [Pa], [m/s].
error_estimate : absolute error of mu [-].
extrapolated_share : share of the hysteresis, as it is weighted, whose modulus lies outside of the measured frequencies [-], to 1e-4.
notes : where the theory or its input leaves its range, a tuple of sentences.

With contributions=True, otherwise None:

wavenumber : shape (n,) [1/m].
dmu_dlnq : d mu_H / d ln q, shape (..., n).
decade_edges : angular frequencies v q, powers of ten, shape (m + 1,) [rad/s].
decade_share : share of the hysteresis from each decade of v q, shape (..., m); sums to 1.
)");
  m.def("friction", &compute, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"),
        py::arg("velocity"), py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(),
        py::arg("adhesion") = py::none(), py::arg("form") = "exact", py::arg("rtol") = 1e-6,
        py::arg("contributions") = false, py::arg("method") = "gauss",
        R"(Friction coefficient of rubber sliding on a rough surface (Eqs 22-24).

mu_H = (1/2) int q^3 C(q) (A/A0)(q) [S(q)] I1(v q) dq / ((1 - nu^2) sigma0). By parts this is
4 (1 - nu^2) sigma0 (R F at q1 - int F dR) with R = I1 / I2 and F = int_0^G P S dG, on Gauss-Legendre panels as fine as
rtol asks for.

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
adhesion : Adhesion, optional
    Without it the adhesion is 0.
form : {"exact", "interpolated"}
    Of A/A0, see `contact_area`.
rtol : float
    Relative tolerance of mu, 1e-12 to 0.1.
contributions : bool
    Also give dmu/dlnq and the share of each decade of frequency.
method : {"gauss", "qag", "qags", "cquad"}
    As above, or GSL's adaptive integration of that name to check it with, slower by hundreds of times.

Returns
-------
Friction

Raises
------
InvalidInput
OutOfRange
    v q0 or v q1 outside of a measured master curve; the message has the velocities that are allowed.
NotConverged

Examples
--------
>>> import asperity
>>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
>>> rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
>>> result = asperity.friction(road, rubber, pressure=81e3, velocity=[1e-3, 1e-2])
>>> result.mu.round(4)
array([0.0003, 0.0034])
)");
}

}  // namespace asperity::python
