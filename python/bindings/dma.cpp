// From dynamic mechanical analysis to a rubber (the article's Section 5.1): isotherms shifted by a_T onto a master
// curve, shift factors with their WLF and Arrhenius laws, Prony series through a curve, and the curve at a large
// strain.
#include "asperity/dma.hpp"

#include <cstdint>

#include "arrays.hpp"
#include "topics.hpp"
#include "value.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

using Vector = std::vector<double>;

void bind_shift_factors(py::module_& m) {
  bind_made<ShiftTable, double, Vector, Vector, Vector>(m, "ShiftFactors")
      .def_property_readonly("reference_temperature", &ShiftTable::reference)
      .def_property_readonly("temperature", [](const ShiftTable& s) { return array_of(s.temperature()); })
      .def_property_readonly("log10_a_T", [](const ShiftTable& s) { return array_of(s.log10_a_T()); })
      .def_property_readonly("standard_deviation", [](const ShiftTable& s) { return array_of(s.standard_deviation()); })
      .def("shift_factor",
           [](const ShiftTable& s, const Array& temperature) {
             return computed([&] {
               std::vector<double> a_T;
               for (const double one : span_of(temperature)) a_T.push_back(s.shift_factor(one));
               return a_T;
             });
           })
      .def("fit_wlf",
           [](const ShiftTable& s, const Array& covariance) {
             const WlfFit fit = s.fit_wlf(span_of(covariance));
             return py::make_tuple(fit.c1, fit.c2, fit.c1_error, fit.c2_error, fit.residual);
           })
      .def("fit_arrhenius", [](const ShiftTable& s, const Array& covariance) {
        const ArrheniusFit fit = s.fit_arrhenius(span_of(covariance));
        return py::make_tuple(fit.activation_energy, fit.activation_energy_error, fit.residual);
      });
}

void bind_laws(py::module_& m) {
  bind_value(m, "WLF", &WLF::c1, &WLF::c2, &WLF::reference);
  py::classh<WlfFit>(m, "WlfFit").def(py::init([](double c1, double c2, double reference) {
    return WlfFit{c1, c2, reference, 0, 0, 0};
  }));
  py::classh<ArrheniusFit>(m, "ArrheniusFit").def(py::init([](double energy, double reference) {
    return ArrheniusFit{energy, reference, 0, 0};
  }));
  // (log10 a_T, its slopes)
  m.def("shift_at", [](const TemperatureShift& shift, const Array& temperature) {
    std::vector<double> values, slopes;
    released([&] {
      for (const double one : span_of(temperature)) {
        const ShiftValue at = shift_at(shift, one);
        values.push_back(at.log10_a_T);
        slopes.push_back(at.slope);
      }
    });
    return py::make_tuple(array_of(std::move(values)), array_of(std::move(slopes)));
  });
}

void bind_sweeps(py::module_& m) {
  py::classh<Isotherm>(m, "Isotherm")
      .def(py::init([](double temperature, const Array& w, const Array& storage, const Array& loss,
                       const std::optional<py::tuple>& notes) {
        if (!notes) return Isotherm(temperature, vector_of(w), vector_of(storage), vector_of(loss));
        return Isotherm(temperature, vector_of(w), vector_of(storage), vector_of(loss), notes_of(*notes));
      }))
      .def_property_readonly("angular_frequency", [](const Isotherm& s) { return array_of(s.angular_frequency()); })
      .def_property_readonly("storage_modulus", [](const Isotherm& s) { return array_of(s.storage_modulus()); })
      .def_property_readonly("loss_modulus", [](const Isotherm& s) { return array_of(s.loss_modulus()); })
      .def_property_readonly("notes", [](const Isotherm& s) { return tuple_of(s.notes()); });
  bind_made<StrainSweep, double, double, Vector, Vector, Vector>(m, "StrainSweep");
  bind_made<StrainFactors, Vector, Vector, Vector, double>(m, "StrainFactors");
}

/// (master curve, shift factors, b_T, columns of the points, residual, covariance, notes)
py::tuple parts_of(MasterCurveBuild build) {
  std::vector<double> w, storage, loss;
  std::vector<std::int64_t> isotherm;
  for (const MasterPoint& point : build.points) {
    w.push_back(point.angular_frequency);
    storage.push_back(point.storage_modulus);
    loss.push_back(point.loss_modulus);
    isotherm.push_back(static_cast<std::int64_t>(point.isotherm));
  }
  const py::tuple points = py::make_tuple(array_of(std::move(w)), array_of(std::move(storage)),
                                          array_of(std::move(loss)), array_of(std::move(isotherm)));
  const auto n = static_cast<py::ssize_t>(build.b_T.size());
  const py::array covariance = array_of(std::move(build.covariance), {n, n});
  return py::make_tuple(std::move(build.master_curve), std::move(build.shifts), array_of(std::move(build.b_T)), points,
                        build.residual, covariance, tuple_of(build.notes));
}

py::tuple built(const std::vector<Isotherm>& isotherms, double reference_temperature, VerticalShift vertical_shift,
                const Array& b_T, const std::optional<ShiftTable>& shift_factors, bool smooth,
                std::optional<Extrapolation> extrapolation) {
  const MasterCurveOptions options{.reference_temperature = reference_temperature,
                                   .vertical_shift = vertical_shift,
                                   .b_T = vector_of(b_T),
                                   .shift_table = shift_factors,
                                   .smooth = smooth,
                                   .extrapolation = extrapolation};
  return parts_of(released([&] { return build_master_curve(isotherms, options); }));
}

/// A build as `_parts` in dma.py gives it.
using Parts = std::tuple<MasterCurve, ShiftTable, Array, Array, Array, Array, py::array_t<std::int64_t>, double, Array>;

MasterCurveBuild build_of(const Parts& parts) {
  const auto& [curve, shifts, b_T, w, storage, loss, isotherm, residual, covariance] = parts;
  MasterCurveBuild build{curve, shifts, vector_of(b_T), {}, residual, vector_of(covariance), {}};
  for (py::ssize_t i = 0; i < w.size(); ++i)
    build.points.push_back({w.at(i), storage.at(i), loss.at(i), static_cast<std::size_t>(isotherm.at(i))});
  return build;
}

py::tuple drawn(const Parts& parts, std::uint64_t seed) {
  const MasterCurveBuild build = build_of(parts);
  return parts_of(released([&] { return draw_master_curve(build, seed); }));
}

/// (ln E', ln E'', log10 a_T), a row a mode
py::tuple modes(const Parts& parts, const Array& angular_frequency) {
  const MasterCurveBuild build = build_of(parts);
  const std::vector<double> rows = vector_of(angular_frequency);
  MasterCurveModes found = released([&] { return master_curve_modes(build, rows); });
  const auto count = static_cast<py::ssize_t>(found.count);
  return py::make_tuple(array_of(std::move(found.storage), {count, angular_frequency.size()}),
                        array_of(std::move(found.loss), {count, angular_frequency.size()}),
                        array_of(std::move(found.log10_a_T), {count, std::get<2>(parts).size()}));
}

/// (series, residual of E', residual of E'', causal, notes)
py::tuple fitted(const MasterCurve& curve, std::optional<double> modes_per_decade, std::optional<double> residual,
                 bool extrapolated) {
  PronyFit fit = released([&] {
    return fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus(),
                     {.modes_per_decade = modes_per_decade, .residual = residual, .extrapolated = extrapolated});
  });
  return py::make_tuple(std::move(fit.series), fit.storage_residual, fit.loss_residual, fit.causal,
                        tuple_of(fit.notes));
}

/// (master curve, notes)
py::tuple large_strain(const MasterCurve& curve, const ShiftTable& shift_factors, double strain,
                       const std::vector<StrainSweep>& sweeps) {
  LargeStrain large = released([&] { return at_strain(curve, shift_factors, strain, sweeps); });
  return py::make_tuple(std::move(large.master_curve), tuple_of(large.notes));
}

/// (strain, f, g, their errors, notes)
py::tuple ratios_of(const std::vector<StrainSweep>& sweeps, std::optional<double> reference, double strain_per_slope) {
  StrainRatios ratios = released([&] { return strain_factors(sweeps, reference, strain_per_slope); });
  const StrainFactors& f = ratios.factors;
  return py::make_tuple(array_of(f.strain()), array_of(f.storage()), array_of(f.loss()),
                        array_of(std::move(ratios.storage_error)), array_of(std::move(ratios.loss_error)),
                        tuple_of(ratios.notes));
}

}  // namespace

void bind_dma(py::module_& m) {
  bind_shift_factors(m);
  bind_laws(m);
  bind_sweeps(m);
  m.def("build_master_curve", &built);
  m.def("draw_master_curve", &drawn);
  m.def("master_curve_modes", &modes);
  m.def("fit_prony", &fitted);
  m.def("at_strain", &large_strain);
  m.def("strain_factors", &ratios_of);
}

}  // namespace asperity::python
