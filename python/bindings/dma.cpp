#include "dma.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct WlfTag {
  static constexpr Field fields[] = {{"c1", Holds::number},
                                     {"c2", Holds::number},
                                     {"reference_temperature", Holds::number},
                                     {"standard_errors", Holds::errors},
                                     {"residual", Holds::number}};
};
struct ArrheniusTag {
  static constexpr Field fields[] = {{"activation_energy", Holds::number},
                                     {"reference_temperature", Holds::number},
                                     {"standard_errors", Holds::errors},
                                     {"residual", Holds::number}};
};

}  // namespace

py::object wlf(const WlfFit& fit) {
  Record<WlfTag> record;
  record.values["c1"] = fit.c1;
  record.values["c2"] = fit.c2;
  record.values["reference_temperature"] = fit.reference;
  py::dict errors;
  errors["c1"] = fit.c1_error;
  errors["c2"] = fit.c2_error;
  record.values["standard_errors"] = errors;
  record.values["residual"] = fit.residual;
  return py::cast(record);
}

py::object arrhenius(const ArrheniusFit& fit) {
  Record<ArrheniusTag> record;
  record.values["activation_energy"] = fit.activation_energy;
  record.values["reference_temperature"] = fit.reference;
  py::dict errors;
  errors["activation_energy"] = fit.activation_energy_error;
  record.values["standard_errors"] = errors;
  record.values["residual"] = fit.residual;
  return py::cast(record);
}

py::object shift_factor(const ShiftTable& shifts, const py::object& temperature) {
  return map_array(temperature, "temperature", [&](double at) { return shifts.shift_factor(at); });
}

const ShiftTable& shifts_of(const py::object& found) {
  if (py::isinstance<Built>(found)) return found.cast<const Built&>().build.shifts;
  return object_of<ShiftTable>(found, "shift_factors", "ShiftFactors or what build_master_curve returned");
}

void bind_dma(py::module_& m) {
  py::classh<Isotherm> isotherm(m, "Isotherm", R"(A frequency sweep at one temperature and small strain.

Parameters
----------
temperature : float
    [K], 100 or more.
angular_frequency : array_like, shape (n,)
    w = 2 pi f [rad/s], in any order; four different ones or more. Points within 1 % of each other are averaged in the
    logarithm, which `notes` says.
storage_modulus, loss_modulus : array_like, shape (n,)
    E', E'' [Pa], positive (3 G of rubber where shear was measured).
notes : tuple of str, optional
    Of rows that an Isotherm gave: they rise, and are taken as they are.

Raises
------
InvalidInput
    Naming the row.
)");
  isotherm
      .def(py::init([](Number<"temperature"> temperature, const py::object& w, const py::object& storage,
                       const py::object& loss, Named<std::optional<std::vector<std::string>>, "notes"> notes) {
             auto frequency = vector_of(w, "angular_frequency"), e1 = vector_of(storage, "storage_modulus"),
                  e2 = vector_of(loss, "loss_modulus");
             if (!notes.value) return Isotherm(temperature, std::move(frequency), std::move(e1), std::move(e2));
             return Isotherm(temperature, std::move(frequency), std::move(e1), std::move(e2), std::move(*notes.value));
           }),
           py::kw_only(), py::arg("temperature"), py::arg("angular_frequency"), py::arg("storage_modulus"),
           py::arg("loss_modulus"), py::arg("notes") = py::none())
      .def_property_readonly("temperature", &Isotherm::temperature, "[K].")
      .def_property_readonly(
          "angular_frequency", [](const Isotherm& s) { return flat(s.angular_frequency()); }, "w [rad/s], rising.")
      .def_property_readonly(
          "storage_modulus", [](const Isotherm& s) { return flat(s.storage_modulus()); }, "E' [Pa].")
      .def_property_readonly(
          "loss_modulus", [](const Isotherm& s) { return flat(s.loss_modulus()); }, "E'' [Pa].")
      .def_property_readonly(
          "notes", [](const Isotherm& s) { return py::tuple(py::cast(s.notes())); }, "What was done to the points.");
  value_semantics(isotherm, {"temperature", "angular_frequency", "storage_modulus", "loss_modulus", "notes"});

  bind_record<WlfTag>(m, "WlfFit", R"(What fit_wlf returns.

c1 : [-]. c2 : [K]. reference_temperature : T_ref [K].
standard_errors : {"c1": [-], "c2": [K]}, from the scatter about the fit.
residual : rms of log10 a_T about the fit [-].
)");
  bind_record<ArrheniusTag>(m, "ArrheniusFit", R"(What fit_arrhenius returns.

activation_energy : E_a in J/mol. reference_temperature : T_ref [K].
standard_errors : {"activation_energy": J/mol}, from the scatter about the fit.
residual : rms of log10 a_T about the fit [-].
)");

  py::classh<ShiftTable> shifts(m, "ShiftFactors", R"(Shift factors over temperature, measured or from a table.

Parameters
----------
reference_temperature : float
    T_ref [K], where a_T = 1.
temperature : array_like, shape (n,)
    [K], strictly rising, n >= 2.
log10_a_T : array_like, shape (n,)
    [-]; above 0 below T_ref.
standard_deviation : array_like, shape (n,), optional
    Of log10_a_T.

Raises
------
InvalidInput
)");
  shifts
      .def(py::init([](Number<"reference_temperature"> reference, const py::object& t, const py::object& a,
                       const py::object& deviation) {
             return ShiftTable(
                 reference, vector_of(t, "temperature"), vector_of(a, "log10_a_T"),
                 deviation.is_none() ? std::vector<double>{} : vector_of(deviation, "standard_deviation"));
           }),
           py::kw_only(), py::arg("reference_temperature"), py::arg("temperature"), py::arg("log10_a_T"),
           py::arg("standard_deviation") = py::none())
      .def_property_readonly("reference_temperature", &ShiftTable::reference, "T_ref [K].")
      .def_property_readonly(
          "temperature", [](const ShiftTable& s) { return flat(s.temperature()); }, "[K], shape (n,).")
      .def_property_readonly(
          "log10_a_T", [](const ShiftTable& s) { return flat(s.log10_a_T()); }, "[-], shape (n,).")
      .def_property_readonly(
          "standard_deviation",
          [](const ShiftTable& s) {
            return s.standard_deviation().empty() ? py::object(py::none()) : flat(s.standard_deviation());
          },
          "Of log10_a_T, shape (n,), or None.")
      .def("shift_factor", &shift_factor, py::arg("temperature"), shift_text)
      .def(
          "fit_wlf", [](const ShiftTable& s) { return wlf(s.fit_wlf()); }, wlf_text)
      .def(
          "fit_arrhenius", [](const ShiftTable& s) { return arrhenius(s.fit_arrhenius()); }, arrhenius_text);
  value_semantics(shifts, {"reference_temperature", "temperature", "log10_a_T", "standard_deviation"});
}

}  // namespace asperity::python
