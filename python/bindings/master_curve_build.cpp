// Isotherms shifted onto one curve.
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>

#include "arguments.hpp"
#include "dma.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct MasterPointsTag {
  static constexpr Field fields[] = {{"angular_frequency", Holds::numbers},
                                     {"storage_modulus", Holds::numbers},
                                     {"loss_modulus", Holds::numbers},
                                     {"isotherm", Holds::whole_numbers}};
};
using MasterPoints = Record<MasterPointsTag>;

MasterPoints points_of(const Built& built) {
  std::vector<double> w, storage, loss;
  std::vector<std::int64_t> origin;
  for (const MasterPoint& p : built.build.points) {
    w.push_back(p.angular_frequency);
    storage.push_back(p.storage_modulus);
    loss.push_back(p.loss_modulus);
    origin.push_back(static_cast<std::int64_t>(p.isotherm));
  }
  const Shape shape{static_cast<py::ssize_t>(w.size())};
  MasterPoints record;
  record.values["angular_frequency"] = flat(std::move(w));
  record.values["storage_modulus"] = flat(std::move(storage));
  record.values["loss_modulus"] = flat(std::move(loss));
  record.values["isotherm"] = shaped(std::move(origin), shape);
  return record;
}

/// A build from what it shows of itself.
Built made(const py::object& curve, const py::object& shift_factors, const py::object& b_T, const py::object& given,
           Number<"residual"> residual, const py::object& covariance, const Sentences<"notes">& notes) {
  const ShiftTable& shifts = shifts_of(shift_factors);
  const auto& points = object_of<MasterPoints>(given, "points", "a MasterPoints");
  Built built{{object_of<MasterCurve>(curve, "master_curve", "a MasterCurve"),
               shifts,
               vector_of(b_T, "b_T"),
               {},
               residual,
               {},
               notes}};
  const std::size_t isotherms = shifts.temperature().size();
  const auto column = [&](const char* name) { return vector_of(points.values[name], std::string("points.") + name); };
  const std::vector<double> w = column("angular_frequency"), storage = column("storage_modulus"),
                            loss = column("loss_modulus"), origin = column("isotherm");
  const auto require_size = [](const char* name, std::size_t size, std::size_t wanted) {
    if (size != wanted)
      throw InvalidInput(std::string(name) + " has " + std::to_string(size) + " entries: must be " +
                         std::to_string(wanted));
  };
  require_size("b_T", built.build.b_T.size(), isotherms);
  const Array matrix = real_array(covariance, "covariance");
  built.build.covariance.assign(matrix.data(), matrix.data() + matrix.size());
  require_size("covariance", built.build.covariance.size(), isotherms * isotherms);
  require_size("points.storage_modulus", storage.size(), w.size());
  require_size("points.loss_modulus", loss.size(), w.size());
  require_size("points.isotherm", origin.size(), w.size());
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (!(origin[i] >= 0 && origin[i] < static_cast<double>(isotherms)))
      throw InvalidInput("points.isotherm[" + std::to_string(i) + "] = " + brief(py::int_(py::float_(origin[i]))) +
                         ": must be from 0 to " + std::to_string(isotherms - 1));
    built.build.points.push_back({w[i], storage[i], loss[i], static_cast<std::size_t>(origin[i])});
  }
  return built;
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

Built build(const Many<"isotherms">& isotherms, Number<"reference_temperature"> reference,
            const py::object& vertical_shift, const py::object& shift_factors, Flag<"smooth"> smooth,
            const Option& extrapolation) {
  MasterCurveOptions options{.reference_temperature = reference};
  if (py::isinstance<py::str>(vertical_shift)) {
    if (!vertical_shift.equal(py::str("T/T_ref")))
      throw InvalidInput("vertical_shift = " + quoted(vertical_shift) +
                         ": must be None, \"T/T_ref\" or an array of b_T");
    options.vertical_shift = VerticalShift::temperature_ratio;
  } else if (!vertical_shift.is_none()) {
    options.vertical_shift = VerticalShift::table;
    options.b_T = vector_of(vertical_shift, "vertical_shift");
  }
  if (!shift_factors.is_none()) options.shift_table = shifts_of(shift_factors);
  options.smooth = smooth;
  options.extrapolation = extrapolation_of(extrapolation);
  const std::vector<Isotherm> all = isotherms_of(isotherms.value);
  const py::gil_scoped_release release;
  return {build_master_curve(all, options)};
}

}  // namespace

void bind_master_curve_build(py::module_& m) {
  bind_record<MasterPointsTag>(m, "MasterPoints", R"(The measured points of a master curve, in rising frequency.

angular_frequency : a_T w [rad/s]. storage_modulus, loss_modulus : E / b_T [Pa].
isotherm : index of the isotherm of origin, in rising temperature.
)");
  py::classh<Built> built(m, "MasterCurveBuild",
                          "What build_master_curve returns: a master curve, and a_T [-] over temperature [K].");
  built
      .def(py::init(&made), py::kw_only(), py::arg("master_curve"), py::arg("shift_factors"), py::arg("b_T"),
           py::arg("points"), py::arg("residual"), py::arg("covariance"), py::arg("notes") = py::tuple())
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
          "Of log10_a_T against the isotherm nearest to T_ref. Above 0.3 the data do not fix the shift: see "
          "`undetermined` and `notes`.")
      .def_property_readonly(
          "covariance",
          [](const Built& b) {
            const auto n = static_cast<py::ssize_t>(b.build.shifts.temperature().size());
            return frozen(shaped<double>(b.build.covariance, {n, n}));
          },
          "Shape (n, n): of log10_a_T, zero at the isotherm nearest to T_ref and where a_T was given.")
      .def_property_readonly(
          "undetermined",
          [](const Built& b) {
            const std::vector<double>& deviation = b.build.shifts.standard_deviation();
            py::array_t<bool> flags(static_cast<py::ssize_t>(deviation.size()));
            std::ranges::transform(deviation, flags.mutable_data(), [](double s) { return s > undetermined_shift; });
            return frozen(std::move(flags));
          },
          "Whether the data leave a shift open, bool: its standard deviation exceeds 0.3 decades.")
      .def_property_readonly(
          "b_T", [](const Built& b) { return flat(b.build.b_T); }, "Vertical shifts: moduli were divided by them.")
      .def_property_readonly("points", &points_of, "MasterPoints: every measured point, reduced, with its isotherm.")
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
          "fit_wlf", [](const Built& b) { return wlf(b.build.shifts.fit_wlf(b.build.covariance)); }, wlf_text)
      .def(
          "fit_arrhenius", [](const Built& b) { return arrhenius(b.build.shifts.fit_arrhenius(b.build.covariance)); },
          arrhenius_text);
  value_semantics(built, {"master_curve", "shift_factors", "b_T", "points", "residual", "covariance", "notes"});

  m.def(
      "draw_master_curve", [](const Built& b, std::uint64_t seed) { return Built{draw_master_curve(b.build, seed)}; },
      py::arg("build"), py::arg("seed"), py::call_guard<py::gil_scoped_release>(),
      "A build as its errors would have it: a_T drawn from `covariance`, the points moved, and the coefficients of the "
      "spline through them drawn from their own covariance.");
  m.def(
      "build_master_curve", &build, py::arg("isotherms"), py::kw_only(), py::arg("reference_temperature"),
      py::arg("vertical_shift") = py::none(), py::arg("shift_factors") = py::none(), py::arg("smooth") = false,
      py::arg("extrapolation") = py::none(),
      R"(Isotherms shifted in frequency until neighbours overlap (the article's Section 5.1): E(w; T) = b_T E(a_T w; T_ref).

E' and E'' together: neighbours in pairs for a start, then all shifts at once, with one penalised cubic spline of ln E'
and one of ln E'' in ln w that all isotherms share. Shifts and smoothness maximise the restricted likelihood (REML),
whose determinant makes an overlap that is given up no gain; residuals that are correlated within isotherms make the data
count by as much less. a_T falls with temperature.

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
