#include "asperity/rubber.hpp"

#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <span>

#include "arrays.hpp"
#include "dma.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// f(w, first, second) over the frequencies in chunks, the GIL released.
template <class F>
py::tuple two_columns(const py::object& angular_frequency, F f) {
  const Array array = real_array(angular_frequency, "angular_frequency");
  const std::span w(array.data(), static_cast<std::size_t>(array.size()));
  std::vector<double> first(w.size()), second(w.size());
  {
    const py::gil_scoped_release release;
    constexpr std::size_t chunk = 512;  // which stays in the cache from term to term
    for (std::size_t i = 0; i < w.size(); i += chunk)
      f(w.subspan(i, std::min(chunk, w.size() - i)), &first[i], &second[i]);
  }
  const Shape shape(array.shape(), array.shape() + array.ndim());
  return py::make_tuple(shaped(std::move(first), shape), shaped(std::move(second), shape));
}

template <class R>
void bind_common(py::classh<R>& cls) {
  cls.def(
         "modulus",
         [](const R& r, const py::object& w) {
           return map_array(w, "angular_frequency", [&](double at) { return r.modulus(at); });
         },
         py::arg("angular_frequency"),
         "Complex modulus E' + i E'' [Pa] at `angular_frequency` [rad/s], any shape. A table raises OutOfRange "
         "outside of its range.")
      .def(
          "angular_integrals",
          [](const R& r, const py::object& w) {
            return two_columns(w, [&](auto part, double* i1, double* i2) {
              r.angular_integrals(part, {i1, part.size()}, {i2, part.size()});
            });
          },
          py::arg("angular_frequency"),
          "(I1 [Pa], I2 [Pa^2]) at `angular_frequency` w = v q [rad/s], any shape: I1 = int_0^2pi cos(phi) "
          "Im E(w cos phi) dphi of Eq. 22, I2 = int_0^2pi |E(w cos phi)|^2 dphi of Eq. 7.")
      .def(
          "shifted", [](const R& r, Number<"a_T"> a_T) { return r.shifted(a_T); }, py::arg("a_T"),
          py::call_guard<py::gil_scoped_release>(),
          "The rubber at another temperature: E(w) becomes E(a_T w), so that a_T > 1 is colder; a new rubber.");
}

}  // namespace

void bind_rubber(py::module_& m) {
  py::classh<PronySeries> prony(m, "PronySeries", R"(E(w) = E_inf + sum_k E_k i w tau_k / (1 + i w tau_k).

The angular integrals are closed forms, README (6). Without terms the rubber is elastic.

Parameters
----------
equilibrium_modulus : float
    E_inf [Pa], not negative.
moduli : array_like, shape (n,)
    E_k [Pa], positive.
relaxation_times : array_like, shape (n,)
    tau_k [s], positive, in any order.

Raises
------
InvalidInput

Examples
--------
>>> from asperity import PronySeries
>>> rubber = PronySeries(equilibrium_modulus=1e6, moduli=[1e9], relaxation_times=[1e-6])
>>> rubber.modulus(1e6)
(501000000+500000000j)
)");
  prony
      .def(py::init([](Number<"equilibrium_modulus"> e, const py::object& moduli, const py::object& times) {
             return PronySeries(e, vector_of(moduli, "moduli"), vector_of(times, "relaxation_times"));
           }),
           py::kw_only(), py::arg("equilibrium_modulus"), py::arg("moduli"), py::arg("relaxation_times"))
      .def_property_readonly("equilibrium_modulus", &PronySeries::equilibrium_modulus, "E_inf [Pa].")
      .def_property_readonly(
          "moduli", [](const PronySeries& s) { return flat(s.moduli()); }, "E_k [Pa], shape (n,).")
      .def_property_readonly(
          "relaxation_times", [](const PronySeries& s) { return flat(s.relaxation_times()); },
          "tau_k [s], shape (n,).");
  bind_common(prony);
  value_semantics(prony, {"equilibrium_modulus", "moduli", "relaxation_times"});

  py::classh<MasterCurve> curve(m, "MasterCurve", R"(A measured complex modulus.

Steffen's monotone interpolant of ln E' and ln E'' in ln w (M. Steffen, Astron. Astrophys. 239, 443 (1990)).

Parameters
----------
angular_frequency : array_like, shape (n,)
    w = 2 pi f [rad/s], strictly rising, n >= 2.
storage_modulus, loss_modulus : array_like, shape (n,)
    E', E'' [Pa], positive.
extrapolation : {None, "power-law", "clamp"}
    Over at most one decade at either end: none, with the slope that ln E', ln E'' have at the end, or constant.
shift_factors : ShiftFactors, optional
    Of the isotherms behind the curve; at_strain places its sweeps by them.

Raises
------
InvalidInput
OutOfRange
    From the methods, where they are asked outside of the measured range.
)");
  curve
      .def(py::init([](const py::object& w, const py::object& storage, const py::object& loss,
                       const Option& extrapolation, const py::object& shifts) {
             const auto frequency = vector_of(w, "angular_frequency"), e1 = vector_of(storage, "storage_modulus"),
                        e2 = vector_of(loss, "loss_modulus");
             const std::optional<Extrapolation> beyond = extrapolation_of(extrapolation);
             const MasterCurve curve = [&] {
               const py::gil_scoped_release release;
               return MasterCurve(frequency, e1, e2, beyond);
             }();
             if (shifts.is_none()) return curve;
             return curve.with_shifts(std::make_shared<const ShiftTable>(shifts_of(shifts)));
           }),
           py::kw_only(), py::arg("angular_frequency"), py::arg("storage_modulus"), py::arg("loss_modulus"),
           py::arg("extrapolation") = py::none(), py::arg("shift_factors") = py::none())
      .def_property_readonly(
          "angular_frequency", [](const MasterCurve& s) { return flat(s.angular_frequency()); }, "w [rad/s].")
      .def_property_readonly(
          "storage_modulus", [](const MasterCurve& s) { return flat(s.storage_modulus()); }, "E' [Pa].")
      .def_property_readonly(
          "loss_modulus", [](const MasterCurve& s) { return flat(s.loss_modulus()); }, "E'' [Pa].")
      .def_property_readonly(
          "extrapolation",
          [](const MasterCurve& s) {
            return s.extrapolation() ? py::object(py::str(name_of(*s.extrapolation(), extrapolations)))
                                     : py::object(py::none());
          },
          "None, \"power-law\" or \"clamp\".")
      .def_property_readonly(
          "shift_factors",
          [](const MasterCurve& s) { return s.shifts() ? py::cast(ShiftTable(*s.shifts())) : py::object(py::none()); },
          "ShiftFactors of the isotherms that the curve was made from, or None.")
      .def("at_strain", &large_strain, py::arg("strain"), py::arg("sweeps"), py::kw_only(),
           py::arg("shift_factors") = py::none(),
           R"(The master curve at a large strain (the article's Section 5.1), a MasterCurve.

E' and E'' each times its own ratio E(strain) / E(0.5 %), which every sweep gives at its place a_T(T) w on the curve;
between sweeps the logarithm of the ratio is interpolated (Steffen), beyond the first and the last it is held, with a
warning.

Parameters
----------
strain : float
    Amplitude [-], 0.5 is 50 %.
sweeps : iterable of StrainSweep
shift_factors : ShiftFactors, optional
    Of the small strain; by default those the curve was built with.

Raises
------
InvalidInput, OutOfRange
    No shift factors, a temperature outside of theirs, a strain outside of a sweep's.
)")
      .def(
          "extrapolated_shares",
          [](const MasterCurve& r, const py::object& w) {
            return two_columns(w, [&](auto part, double* first, double* second) {
              for (const double one : part) {
                const AngularIntegrals a = r.angular_integrals(one);
                *first++ = a.i1_outside / a.i1;
                *second++ = a.i2_outside / a.i2;
              }
            });
          },
          py::arg("angular_frequency"),
          "Shares of I1 and I2 that come from outside of the measured frequencies: w cos(phi) always runs to zero, "
          "and below the lowest frequency E' is taken constant and E'' proportional to w.");
  bind_common(curve);
  value_semantics(curve, {"angular_frequency", "storage_modulus", "loss_modulus", "extrapolation", "shift_factors"});

  m.def(
      "effective_modulus",
      [](const py::object& modulus, const py::object& poisson_ratio, const py::object& modulus_2,
         const py::object& poisson_ratio_2) {
        const Broadcast b = broadcast({{"modulus", modulus},
                                       {"poisson_ratio", poisson_ratio},
                                       {"modulus_2", modulus_2},
                                       {"poisson_ratio_2", poisson_ratio_2}});
        std::vector<double> result;
        {
          const py::gil_scoped_release release;
          for (std::size_t i = 0; i < b.columns[0].size(); ++i)
            result.push_back(effective_modulus(b.columns[0][i], b.columns[1][i], b.columns[2][i], b.columns[3][i]));
        }
        return shaped(std::move(result), b.shape);
      },
      py::kw_only(), py::arg("modulus"), py::arg("poisson_ratio"),
      py::arg("modulus_2") = std::numeric_limits<double>::infinity(), py::arg("poisson_ratio_2") = 0.0,
      R"(E* [Pa] of 1 / E* = (1 - nu^2) / E + (1 - nu_2^2) / E_2 (Eq. 15); the second body is rigid by default.

Moduli [Pa] positive, Poisson ratios in [0, 0.5], else InvalidInput. Arguments broadcast.
)");
}

}  // namespace asperity::python
