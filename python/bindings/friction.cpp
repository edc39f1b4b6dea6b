// The friction coefficient and the adhesion fitted to measured friction.
#include "asperity/friction.hpp"

#include <algorithm>

#include "arrays.hpp"
#include "topics.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

/// (a row a column of Friction in the order of `friction_columns`, notes, contributions or None).
py::tuple friction_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                      const std::optional<Adhesion>& adhesion, const Array& pressure, const Array& velocity,
                      bool contributions, unsigned threads) {
  Friction f = released([&] {
    return friction(spectrum, rubber, model, adhesion, span_of(pressure), span_of(velocity), contributions, threads);
  });
  const auto points = static_cast<std::size_t>(pressure.size());
  py::array_t<double> rows({std::size(friction_columns), points});
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
  py::classh<Adhesion>(m, "Adhesion").def(py::init([](double tau, double v0, double c) {
    const Adhesion adhesion{tau, v0, c};
    validate(adhesion);
    return adhesion;
  }));
  m.def("friction", &friction_of);
  m.def("fit_adhesion", &fit);
}

}  // namespace asperity::python
