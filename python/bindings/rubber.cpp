// Rubber: E(w) as a Prony series or a measured master curve, its angular integrals I1 = int_0^2pi cos(phi)
// Im E(w cos phi) dphi (Eq. 22) and I2 = int_0^2pi |E(w cos phi)|^2 dphi (Eq. 7), and E* of two bodies (Eq. 15).
#include "asperity/rubber.hpp"

#include <pybind11/complex.h>

#include <algorithm>
#include <complex>

#include "arrays.hpp"
#include "topics.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// The two arrays that f(w, first, second) fills for parts of the frequencies, with the GIL released.
template <class F>
py::tuple two_columns(const Array& angular_frequency, F f) {
  const std::span<const double> w = span_of(angular_frequency);
  // not cleared: of 1e8 points that takes a second in which no signal is heeded
  py::array_t<double> first(angular_frequency.size()), second(angular_frequency.size());
  double *const to_first = first.mutable_data(), *const to_second = second.mutable_data();
  released([&] {
    constexpr std::size_t part = 512;  // stays in the cache from term to term
    for (std::size_t i = 0; i < w.size(); i += part) {
      heed();
      f(w.subspan(i, std::min(part, w.size() - i)), to_first + i, to_second + i);
    }
  });
  return py::make_tuple(first, second);
}

template <class R>
void bind_rubber(py::classh<R>& rubber) {
  rubber
      .def("modulus",
           [](const R& r, const Array& w) {
             return computed([&] {
               std::vector<std::complex<double>> modulus;
               modulus.reserve(span_of(w).size());
               for (const double one : span_of(w)) {
                 heed_at(modulus.size());
                 modulus.push_back(r.modulus(one));
               }
               return modulus;
             });
           })
      .def("angular_integrals",
           [](const R& r, const Array& w) {
             return two_columns(w, [&](auto part, double* i1, double* i2) {
               (void)r.angular_integrals(part, {i1, part.size()}, {i2, part.size()});
             });
           })
      .def("angular_harmonics",
           [](const R& r, const Array& w, std::size_t count) {
             const std::span<const double> at = span_of(w);
             const AngularHarmonics all = released([&] { return angular_harmonics(Rubber(r), at, count); });
             return py::make_tuple(array_of(all.loss), array_of(all.square));
           })
      .def("shifted", &R::shifted, py::call_guard<Released>());
}

/// Shares of I1 and I2 that come from outside of the measured frequencies.
template <class R>
py::tuple extrapolated_shares(const R& rubber, const Array& angular_frequency) {
  return two_columns(angular_frequency, [&](auto part, double* first, double* second) {
    for (const double w : part) {
      const AngularIntegrals integrals = rubber.angular_integrals(w);
      *first++ = integrals.i1_outside / integrals.i1;
      *second++ = integrals.i2_outside / integrals.i2;
    }
  });
}

py::array effective_moduli(const Array& modulus, const Array& poisson_ratio, const Array& modulus_2,
                           const Array& poisson_ratio_2) {
  const auto e = span_of(modulus), nu = span_of(poisson_ratio), e_2 = span_of(modulus_2),
             nu_2 = span_of(poisson_ratio_2);
  return computed([&] {
    std::vector<double> effective(e.size());
    for (std::size_t i = 0; i < e.size(); ++i) {
      heed_at(i);
      effective[i] = effective_modulus(e[i], nu[i], e_2[i], nu_2[i]);
    }
    return effective;
  });
}

}  // namespace

void bind_rubber(py::module_& m) {
  auto prony = bind_made<PronySeries, double, std::vector<double>, std::vector<double>>(m, "PronySeries");
  prony.def_property_readonly("equilibrium_modulus", &PronySeries::equilibrium_modulus)
      .def_property_readonly("moduli", [](const PronySeries& series) { return array_of(series.moduli()); })
      .def_property_readonly("relaxation_times",
                             [](const PronySeries& series) { return array_of(series.relaxation_times()); })
      .def("fitted_on",
           [](const PronySeries& series, double lowest, double highest, bool extrapolated) {
             return series.fitted_on({lowest, highest}, extrapolated);
           })
      .def_property_readonly("lowest_frequency", [](const PronySeries& s) { return s.fitted_range().value().lowest; })
      .def_property_readonly("highest_frequency", [](const PronySeries& s) { return s.fitted_range().value().highest; })
      .def("extrapolated_shares", &extrapolated_shares<PronySeries>);
  bind_rubber(prony);

  py::classh<MasterCurve> curve(m, "MasterCurve");
  curve
      .def(py::init([](const Array& w, const Array& storage, const Array& loss, std::optional<Extrapolation> beyond) {
        return released([&] { return MasterCurve(vector_of(w), vector_of(storage), vector_of(loss), beyond); });
      }))
      .def_property_readonly("angular_frequency", [](const MasterCurve& c) { return array_of(c.angular_frequency()); })
      .def_property_readonly("storage_modulus", [](const MasterCurve& c) { return array_of(c.storage_modulus()); })
      .def_property_readonly("loss_modulus", [](const MasterCurve& c) { return array_of(c.loss_modulus()); })
      .def("extrapolated_shares", &extrapolated_shares<MasterCurve>);
  bind_rubber(curve);

  m.def("effective_modulus", &effective_moduli);
}

}  // namespace asperity::python
