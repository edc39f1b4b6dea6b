#include <pybind11/stl.h>

#include "arguments.hpp"
#include "dma.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// A Prony series and how well it follows what it was fitted to.
struct FittedProny : PronySeries {
  double storage_residual, loss_residual;
  bool causal;
  std::vector<std::string> notes;
};

void warn(const std::vector<std::string>& notes) {
  for (const std::string& note : notes)
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 2) < 0) throw py::error_already_set();
}

}  // namespace

MasterCurve large_strain(const MasterCurve& curve, Number<"strain"> strain, const Many<"sweeps">& sweeps,
                         const py::object& shift_factors) {
  if (shift_factors.is_none() && !curve.shifts())
    throw InvalidInput("shift_factors: is missing, the curve does not know at which temperature it holds");
  std::vector<StrainSweep> all;
  for (const py::handle& one : sweeps.value) {
    const std::string name = "sweeps[" + std::to_string(all.size()) + "]";
    all.push_back(object_of<StrainSweep>(py::reinterpret_borrow<py::object>(one), name.c_str(), "a StrainSweep"));
  }
  const ShiftTable& shifts = shift_factors.is_none() ? *curve.shifts() : shifts_of(shift_factors);
  const LargeStrain result = [&] {
    const py::gil_scoped_release release;
    return at_strain(curve, shifts, strain, all);
  }();
  warn(result.notes);
  return result.master_curve;
}

void bind_prony_fit(py::module_& m) {
  py::classh<FittedProny, PronySeries> fitted(m, "PronyFit", R"(A PronySeries that was fitted (fit_prony).

A rubber like any other [Pa], that also knows how well it follows the measurement.
)");
  fitted
      .def(py::init([](Number<"equilibrium_modulus"> e, const py::object& moduli, const py::object& times,
                       Number<"storage_residual"> storage_residual, Number<"loss_residual"> loss_residual,
                       Flag<"causal"> causal, const Sentences<"notes">& notes) {
             return FittedProny{PronySeries(e, vector_of(moduli, "moduli"), vector_of(times, "relaxation_times")),
                                storage_residual, loss_residual, causal, notes};
           }),
           py::kw_only(), py::arg("equilibrium_modulus"), py::arg("moduli"), py::arg("relaxation_times"),
           py::arg("storage_residual"), py::arg("loss_residual"), py::arg("causal"), py::arg("notes") = py::tuple())
      .def_readonly("storage_residual", &FittedProny::storage_residual, "Relative rms of E' about the fit [-].")
      .def_readonly("loss_residual", &FittedProny::loss_residual, "Relative rms of E'' about the fit [-].")
      .def_readonly("causal", &FittedProny::causal,
                    "False where E' and E'' contradict each other (Kramers-Kronig) by more than their noise.")
      .def_property_readonly(
          "notes", [](const FittedProny& f) { return py::tuple(py::cast(f.notes)); }, "What a reader must know.");
  value_semantics(fitted, {"equilibrium_modulus", "moduli", "relaxation_times", "storage_residual", "loss_residual",
                           "causal", "notes"});
  m.def(
      "fit_prony",
      [](const py::object& master_curve, OptionalNumber<"modes_per_decade"> modes_per_decade,
         OptionalNumber<"residual"> residual) {
        const MasterCurve& curve = py::isinstance<Built>(master_curve)
                                       ? master_curve.cast<const Built&>().build.master_curve
                                       : object_of<MasterCurve>(master_curve, "master_curve", "a MasterCurve");
        PronyFit fit = [&] {
          const py::gil_scoped_release release;
          return fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus(),
                           {modes_per_decade, residual});
        }();
        if (!fit.causal) warn(fit.notes);
        return FittedProny{std::move(fit.series), fit.storage_residual, fit.loss_residual, fit.causal, fit.notes};
      },
      py::arg("master_curve"), py::kw_only(), py::arg("modes_per_decade") = py::none(),
      py::arg("residual") = py::none(),
      R"(A Prony series through the rows of a master curve.

Non-negative least squares with relative weights, relaxation times equally spaced in the logarithm from a decade below to
a decade above those of the measured frequencies.

Parameters
----------
master_curve : MasterCurve
modes_per_decade : float, optional
    By default the fewest that reach the noise of the rows.
residual : float, optional
    ... or that reach this relative rms of E' and E'' together.

Returns
-------
PronyFit
    A PronySeries [Pa] with its residuals. Prony series are causal: where none follows the rows, E' and E'' contradict
    each other; `causal` is then False, and a UserWarning says why that may be.

Raises
------
InvalidInput
NotConverged
    A `residual` that no number of modes reaches.
)");
}

void bind_strain_sweep(py::module_& m) {
  py::classh<StrainSweep> sweep(m, "StrainSweep", R"(A sweep of strain at one temperature and one frequency.

Parameters
----------
temperature : float
    [K].
angular_frequency : float
    w = 2 pi f [rad/s].
strain : array_like, shape (n,)
    Amplitudes [-] (0.5 is 50 %), strictly rising.
storage_modulus, loss_modulus : array_like, shape (n,)
    E', E'' [Pa].

Raises
------
InvalidInput
)");
  sweep
      .def(py::init([](Number<"temperature"> temperature, Number<"angular_frequency"> w, const py::object& strain,
                       const py::object& storage, const py::object& loss) {
             return StrainSweep(temperature, w, vector_of(strain, "strain"), vector_of(storage, "storage_modulus"),
                                vector_of(loss, "loss_modulus"));
           }),
           py::kw_only(), py::arg("temperature"), py::arg("angular_frequency"), py::arg("strain"),
           py::arg("storage_modulus"), py::arg("loss_modulus"))
      .def_property_readonly("temperature", &StrainSweep::temperature, "[K].")
      .def_property_readonly("angular_frequency", &StrainSweep::angular_frequency, "w [rad/s].")
      .def_property_readonly(
          "strain", [](const StrainSweep& s) { return flat(s.strain()); }, "[-], shape (n,).")
      .def_property_readonly(
          "storage_modulus", [](const StrainSweep& s) { return flat(s.storage_modulus()); }, "E' [Pa].")
      .def_property_readonly(
          "loss_modulus", [](const StrainSweep& s) { return flat(s.loss_modulus()); }, "E'' [Pa].");
  value_semantics(sweep, {"temperature", "angular_frequency", "strain", "storage_modulus", "loss_modulus"});
}

}  // namespace asperity::python
