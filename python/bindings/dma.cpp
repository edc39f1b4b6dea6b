#include "dma.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct WlfTag {
  static constexpr const char* names[] = {"c1", "c2", "reference_temperature", "standard_errors", "residual"};
};
struct ArrheniusTag {
  static constexpr const char* names[] = {"activation_energy", "reference_temperature", "standard_errors", "residual"};
};
struct MasterPointsTag {
  static constexpr const char* names[] = {"angular_frequency", "storage_modulus", "loss_modulus", "isotherm"};
};

py::object wlf(const ShiftTable& shifts) {
  const WlfFit fit = shifts.fit_wlf();
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

py::object arrhenius(const ShiftTable& shifts) {
  const ArrheniusFit fit = shifts.fit_arrhenius();
  Record<ArrheniusTag> record;
  record.values["activation_energy"] = fit.activation_energy;
  record.values["reference_temperature"] = fit.reference;
  py::dict errors;
  errors["activation_energy"] = fit.activation_energy_error;
  record.values["standard_errors"] = errors;
  record.values["residual"] = fit.residual;
  return py::cast(record);
}

constexpr auto wlf_text =
    "log10 a_T = -c1 (T - T_ref) / (c2 + T - T_ref) through the shift factors by least squares (M. L. Williams, R. F. "
    "Landel, J. D. Ferry, J. Am. Chem. Soc. 77, 3701 (1955)): a WlfFit. InvalidInput with fewer than 4 temperatures.";
constexpr auto arrhenius_text =
    "ln a_T = (E_a / R) (1 / T - 1 / T_ref) through the shift factors by least squares: an ArrheniusFit.";
constexpr auto shift_text =
    "a_T [-] at `temperature` [K], any shape: Steffen's interpolant of log10 a_T; OutOfRange outside of the measured "
    "temperatures.";

py::object shift_factor(const ShiftTable& shifts, const py::object& temperature) {
  return map_array(temperature, "temperature", [&](double at) { return shifts.shift_factor(at); });
}

std::vector<Isotherm> isotherms_of(const py::iterable& given) {
  std::vector<Isotherm> result;
  for (const py::handle& one : given) {
    const auto object = py::reinterpret_borrow<py::object>(one);
    const std::string name = "isotherms[" + std::to_string(result.size()) + "]";
    result.push_back(object_of<Isotherm>(object, name.c_str(), "an Isotherm"));
  }
  return result;
}

Built build(const py::iterable& isotherms, double reference, const py::object& vertical_shift,
            const py::object& shift_factors, bool smooth, const std::optional<std::string>& extrapolation) {
  MasterCurveOptions options{.reference_temperature = reference};
  if (py::isinstance<py::str>(vertical_shift)) {
    const auto name = vertical_shift.cast<std::string>();
    if (name != "T/T_ref")
      throw InvalidInput("vertical_shift = \"" + name + "\": must be None, \"T/T_ref\" or an array of b_T");
    options.vertical_shift = VerticalShift::temperature_ratio;
  } else if (!vertical_shift.is_none()) {
    options.vertical_shift = VerticalShift::table;
    options.b_T = vector_of(vertical_shift, "vertical_shift");
  }
  if (!shift_factors.is_none()) options.shift_table = shifts_of(shift_factors);
  options.smooth = smooth;
  options.extrapolation = extrapolation_of(extrapolation);
  const std::vector<Isotherm> all = isotherms_of(isotherms);
  const py::gil_scoped_release release;
  return {build_master_curve(all, options)};
}

}  // namespace

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

Raises
------
InvalidInput
    Naming the row.
)");
  isotherm
      .def(py::init([](double temperature, const py::object& w, const py::object& storage, const py::object& loss) {
             return Isotherm(temperature, vector_of(w, "angular_frequency"), vector_of(storage, "storage_modulus"),
                             vector_of(loss, "loss_modulus"));
           }),
           py::kw_only(), py::arg("temperature"), py::arg("angular_frequency"), py::arg("storage_modulus"),
           py::arg("loss_modulus"))
      .def_property_readonly("temperature", &Isotherm::temperature, "[K].")
      .def_property_readonly(
          "angular_frequency", [](const Isotherm& s) { return flat(s.angular_frequency()); }, "w [rad/s], rising.")
      .def_property_readonly(
          "storage_modulus", [](const Isotherm& s) { return flat(s.storage_modulus()); }, "E' [Pa].")
      .def_property_readonly(
          "loss_modulus", [](const Isotherm& s) { return flat(s.loss_modulus()); }, "E'' [Pa].")
      .def_property_readonly(
          "notes", [](const Isotherm& s) { return py::tuple(py::cast(s.notes())); }, "What was done to the points.");
  value_semantics(isotherm, {"temperature", "angular_frequency", "storage_modulus", "loss_modulus"});

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
      .def(py::init([](double reference, const py::object& t, const py::object& a, const py::object& deviation) {
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
      .def("fit_wlf", &wlf, wlf_text)
      .def("fit_arrhenius", &arrhenius, arrhenius_text);
  value_semantics(shifts, {"reference_temperature", "temperature", "log10_a_T", "standard_deviation"});

  bind_record<MasterPointsTag>(m, "MasterPoints", R"(The measured points of a master curve, in rising frequency.

angular_frequency : a_T w [rad/s]. storage_modulus, loss_modulus : E / b_T [Pa].
isotherm : index of the isotherm of origin, in rising temperature.
)");
  py::classh<Built> built(m, "MasterCurveBuild",
                          "What build_master_curve returns: a master curve, and a_T [-] over temperature [K].");
  built
      .def_property_readonly(
          "master_curve", [](const Built& b) { return b.build.master_curve; }, "A MasterCurve at T_ref.")
      .def_property_readonly(
          "shift_factors", [](const Built& b) { return b.build.shifts; }, "The table below as ShiftFactors.")
      .def_property_readonly(
          "reference_temperature", [](const Built& b) { return b.build.shifts.reference(); }, "T_ref [K].")
      .def_property_readonly(
          "temperature", [](const Built& b) { return flat(b.build.shifts.temperature()); },
          "Of the isotherms [K], rising.")
      .def_property_readonly(
          "log10_a_T", [](const Built& b) { return flat(b.build.shifts.log10_a_T()); }, "Their shift factors [-].")
      .def_property_readonly(
          "standard_deviation", [](const Built& b) { return flat(b.build.shifts.standard_deviation()); },
          "Of log10_a_T against the isotherm nearest to T_ref, from the scatter about the master spline.")
      .def_property_readonly(
          "b_T", [](const Built& b) { return flat(b.build.b_T); }, "Vertical shifts: moduli were divided by them.")
      .def_property_readonly(
          "points",
          [](const Built& b) {
            std::vector<double> w, storage, loss;
            std::vector<long long> origin;
            for (const MasterPoint& p : b.build.points) {
              w.push_back(p.angular_frequency);
              storage.push_back(p.storage_modulus);
              loss.push_back(p.loss_modulus);
              origin.push_back(static_cast<long long>(p.isotherm));
            }
            const Shape shape{static_cast<py::ssize_t>(w.size())};
            Record<MasterPointsTag> record;
            record.values["angular_frequency"] = flat(std::move(w));
            record.values["storage_modulus"] = flat(std::move(storage));
            record.values["loss_modulus"] = flat(std::move(loss));
            record.values["isotherm"] = shaped(std::move(origin), shape);
            return record;
          },
          "MasterPoints: every measured point, reduced, with its isotherm.")
      .def_property_readonly(
          "residual", [](const Built& b) { return b.build.residual; },
          "rms of ln E' and ln E'' about the master spline [-].")
      .def_property_readonly(
          "notes", [](const Built& b) { return py::tuple(py::cast(b.build.notes)); },
          "What a reader must know: averaged points, small overlaps, undetermined shifts, outliers, what the other "
          "vertical shift would do.")
      .def(
          "shift_factor", [](const Built& b, const py::object& t) { return shift_factor(b.build.shifts, t); },
          py::arg("temperature"), shift_text)
      .def(
          "fit_wlf", [](const Built& b) { return wlf(b.build.shifts); }, wlf_text)
      .def(
          "fit_arrhenius", [](const Built& b) { return arrhenius(b.build.shifts); }, arrhenius_text);

  m.def(
      "build_master_curve", &build, py::arg("isotherms"), py::kw_only(), py::arg("reference_temperature"),
      py::arg("vertical_shift") = py::none(), py::arg("shift_factors") = py::none(), py::arg("smooth") = false,
      py::arg("extrapolation") = py::none(),
      R"(Isotherms shifted in frequency until neighbours overlap (the article's Section 5.1): E(w; T) = b_T E(a_T w; T_ref).

E' and E'' together: from neighbour to neighbour for a start, then all shifts at once, with one cubic spline of ln E' and
one of ln E'' in ln w that all isotherms share (variable projection; knots by generalised cross-validation).

Parameters
----------
isotherms : iterable of Isotherm
    Of two temperatures or more, in any order. Neighbours should overlap by 0.3 decades.
reference_temperature : float
    T_ref [K], within the measured ones.
vertical_shift : {None, "T/T_ref"} or array_like
    b_T: 1, T / T_ref, or one for each isotherm in rising temperature. Moduli are divided by it. It moves a_T, by more
    than a decade on some rubbers: `notes` says by how much.
shift_factors : ShiftFactors, optional
    a_T from outside, instead of a fit.
smooth : bool
    The master spline at ten frequencies a decade instead of the points (those within 0.02 decades averaged).
extrapolation : {None, "power-law", "clamp"}
    As in MasterCurve.

Returns
-------
MasterCurveBuild

Raises
------
InvalidInput
    One temperature only, neighbours without a modulus in common.
OutOfRange
    `reference_temperature` [K] outside of the isotherms, a temperature outside of `shift_factors`.
)");
}

}  // namespace asperity::python
