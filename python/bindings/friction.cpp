// The friction coefficient and the adhesion fitted to measured friction.
#include "asperity/friction.hpp"

#include <algorithm>

#include "arrays.hpp"
#include "asperity/gradients.hpp"
#include "asperity/heating.hpp"
#include "topics.hpp"
#include "value.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

/// (a row a column of Friction in the order of `friction_columns`, notes, contributions or None).
py::tuple parts_of(Friction f) {
  py::array_t<double> rows({std::size(friction_columns), f.mu.size()});
  double* to = rows.mutable_data();
  for (const auto column : friction_columns) to = std::ranges::copy(f.*column, to).out;
  py::object shares = py::none();
  if (f.contributions) {
    Contributions& c = *f.contributions;
    shares = py::make_tuple(array_of(std::move(c.wavenumber)), array_of(std::move(c.dmu_dlnq)),
                            array_of(std::move(c.decade_edges)), array_of(std::move(c.decade_share)));
  }
  return py::make_tuple(rows, tuple_of(f.notes), shares);
}

py::tuple friction_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                      const std::optional<Adhesion>& adhesion, const Array& pressure, const Array& velocity,
                      bool contributions, unsigned threads, const std::optional<TemperatureShift>& shift,
                      const std::optional<Array>& temperature) {
  return parts_of(released([&] {
    const auto p = span_of(pressure), v = span_of(velocity);
    return shift ? friction(spectrum, rubber, *shift, model, adhesion, p, v, span_of(*temperature), contributions,
                            threads)
                 : friction(spectrum, rubber, model, adhesion, p, v, contributions, threads);
  }));
}

/// (hot parts, cold parts, T at q1, P_m, gain, branches, temperature profiles)
py::tuple flash_friction_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                            const std::optional<Adhesion>& adhesion, const Array& pressure, const Array& velocity,
                            bool contributions, unsigned threads, const TemperatureShift& shift,
                            const Array& temperature, const Heating& heating, Branch branch) {
  FlashFriction f = released([&] {
    return friction(spectrum, rubber, shift, heating, model, adhesion, span_of(pressure), span_of(velocity),
                    span_of(temperature), branch, contributions, threads);
  });
  py::array hottest = array_of(std::move(f.hot.temperature));
  return py::make_tuple(parts_of(std::move(f.hot)), parts_of(std::move(f.cold)), hottest,
                        array_of(std::move(f.macro_area)), array_of(std::move(f.gain)), array_of(std::move(f.branches)),
                        array_of(std::move(f.temperature_profile)));
}

/// ((rows of C, density), (rows of the modulus, densities of E' and E''), over p, v, T, {argument: values}, error).
py::tuple gradients_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                       const std::optional<Adhesion>& adhesion, const Array& pressure, const Array& velocity,
                       unsigned threads, const std::optional<TemperatureShift>& shift,
                       const std::optional<Array>& temperature, const std::optional<Heating>& heating, Branch branch) {
  Gradients g = released([&] {
    const auto p = span_of(pressure), v = span_of(velocity);
    if (heating)
      return gradients(spectrum, rubber, *shift, *heating, model, adhesion, p, v, span_of(*temperature), branch,
                       threads);
    return shift ? gradients(spectrum, rubber, *shift, model, adhesion, p, v, span_of(*temperature), threads)
                 : gradients(spectrum, rubber, model, adhesion, p, v, threads);
  });
  py::dict arguments;
  for (Gradients::OfArgument& one : g.arguments) arguments[one.name.c_str()] = array_of(std::move(one.values));
  return py::make_tuple(array_of(std::move(g.wavenumber)), array_of(std::move(g.spectrum)),
                        array_of(std::move(g.angular_frequency)), array_of(std::move(g.storage)),
                        array_of(std::move(g.loss)), array_of(std::move(g.pressure)), array_of(std::move(g.velocity)),
                        array_of(std::move(g.temperature)), arguments, array_of(std::move(g.error_estimate)));
}

/// ((tau_f0, v0, c), covariance row by row, residual, outliers, notes).
py::tuple fit(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, const Array& pressure,
              const Array& velocity, const Array& mu, std::optional<double> shear_stress,
              std::optional<double> reference_velocity, std::optional<double> width) {
  const AdhesionFit f = released([&] {
    return fit_adhesion(spectrum, rubber, model, span_of(pressure), span_of(velocity), span_of(mu),
                        {shear_stress, reference_velocity, width});
  });
  const Adhesion& a = f.adhesion;
  return py::make_tuple(py::make_tuple(a.shear_stress, a.reference_velocity, a.width),
                        array_of(std::vector<double>(f.covariance.begin(), f.covariance.end()), {3, 3}), f.residual,
                        py::cast(f.outliers), tuple_of(f.notes));
}

}  // namespace

void bind_friction(py::module_& m) {
  m.attr("NOTED_EXTRAPOLATION") = asperity::noted_extrapolation;
  m.attr("FATAL_EXTRAPOLATION") = asperity::fatal_extrapolation;
  bind_value(m, "Heating", &Heating::density, &Heating::heat_capacity, &Heating::conductivity,
             &Heating::contact_diameter, &Heating::macro_wavenumber, &Heating::macro_area, &Heating::residence,
             &Heating::interface_share);
  m.def("heat_kernel", [](const Array& q, const Array& q_prime, const Array& velocity, const Heating& heating) {
    return computed([&] { return heat_kernel(span_of(q), span_of(q_prime), span_of(velocity), heating); });
  });
  bind_value(m, "Adhesion", &Adhesion::shear_stress, &Adhesion::reference_velocity, &Adhesion::width);
  m.def("friction", &friction_of);
  m.def("flash_friction", &flash_friction_of);
  m.def("gradients", &gradients_of);
  m.def("sliding_length", [](const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                             const std::optional<Adhesion>& adhesion, const Array& pressure, const Array& velocity,
                             const TemperatureShift& shift, const Array& temperature, const Heating& heating) {
    return computed([&] {
      return sliding_length(spectrum, rubber, shift, heating, model, adhesion, span_of(pressure), span_of(velocity),
                            span_of(temperature));
    });
  });
  m.def("extrapolation_notes", [](const Array& velocity, const Array& share) {
    return tuple_of(extrapolation_notes(span_of(velocity), span_of(share)));
  });
  m.def("fit_adhesion", &fit);
}

}  // namespace asperity::python
