#include "asperity/spectrum.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "parts.hpp"
#include "rows.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// What both spectra can do.
template <class S>
void bind_common(py::classh<S>& cls) {
  cls.def_property_readonly("rms_slope", released<S>([](const S& s) { return rms_slope(s); }),
                            "h' = sqrt(2 pi int q^3 C dq) [-].")
      .def_property_readonly(
          "nayak_parameter", released<S>([](const S& s) { return nayak_parameter(s); }),
          "Nayak's parameter m0 m4 / m2^2 of a profile [-] (P. R. Nayak, J. Lubr. Technol. 93, 398 (1971)): 1.5 for a "
          "single wavenumber, the larger the wider the band.")
      .def(
          "at",
          [](const S& s, const py::object& q) {
            return over_array(q, "wavenumber", [&](std::span<const double> at) { return density(s, at); });
          },
          py::arg("wavenumber"),
          "C(q) [m^4] at `wavenumber` [1/m], any shape. A self-affine spectrum is 0 outside its band; a table "
          "raises OutOfRange.")
      .def(
          "truncated",
          [](const S& s, OptionalNumber<"q0"> q0, OptionalNumber<"q1"> q1) {
            const py::gil_scoped_release release;
            return std::get<S>(truncated(Spectrum(s), q0, q1));
          },
          py::kw_only(), py::arg("q0") = py::none(), py::arg("q1") = py::none(),
          "The same densities on a narrower band [1/m]; a new spectrum. InvalidInput where it would be wider.")
      .def(
          "line_density",
          [](const S& s, const py::object& q) {
            return over_array(q, "wavenumber", [&](std::span<const double> at) { return line_density(s, at); });
          },
          py::arg("wavenumber"),
          "C1D(q) = int C(sqrt(q^2 + k^2)) dk over all k [m^3] at `wavenumber` [1/m], any shape: the two-sided "
          "spectrum "
          "of a profile of this surface.")
      .def(
          "cutoff_for_slope", [](const S& s, Number<"slope"> slope) { return cutoff_for_slope(s, slope); },
          py::arg("slope") = 1.3, py::call_guard<py::gil_scoped_release>(),
          "The wavenumber [1/m] up to which the cumulative rms slope is `slope`, the upper cut-off of the text below "
          "Eq. 22; q1 where the whole spectrum has less.")
      .def(
          "cutoff_for_contamination", [](const S& s, Number<"size"> size) { return cutoff_for_contamination(s, size); },
          py::arg("size"), "2 pi / `size` of the contamination particles [m], at most q1 [1/m].")
      .def(
          "scaled", [](const S& s, Number<"factor"> factor) { return std::get<S>(scaled(Spectrum(s), factor)); },
          py::arg("factor"), py::call_guard<py::gil_scoped_release>(), "All densities times `factor`; a new spectrum.")
      .def(
          "autocorrelation",
          [](const S& s, const py::object& distance) {
            return over_array(distance, "distance", [&](std::span<const double> r) { return autocorrelation(s, r); });
          },
          py::arg("distance"),
          "<h(x) h(0)> = 2 pi int q C J0(q |x|) dq [m^2] at `distance` |x| [m], any shape (Eqs 5-6); good to 1e-8 of "
          "the value at 0, which is the mean square height.");
}

}  // namespace

void bind_spectrum(py::module_& m) {
  py::classh<SelfAffineSpectrum> self_affine(m, "SelfAffineSpectrum", R"(Spectrum of a self-affine surface.

C(q) = C_r (q / q_r)^(-2 (H + 1)) on [q_r, q1], flat on [q0, q_r], zero elsewhere. C_r follows from
rms_height^2 = 2 pi int_q0^q1 q C dq, so that the rms height is exact on the band.

Parameters
----------
rms_height : float
    h_rms [m].
hurst : float
    H in (0, 1].
q0, q1 : float
    Lower and upper cut-off, angular wavenumbers 2 pi / wavelength [1/m].
rolloff : float, optional
    q_r [1/m], q0 < q_r < q1; without it the power law starts at q0.

Raises
------
InvalidInput

Examples
--------
Table 1's asphalt; its rms slope is above the 1.3 at which the cut-off rule ends a spectrum:

>>> from asperity import SelfAffineSpectrum
>>> road = SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=1e6)
>>> round(road.rms_slope, 2), round(road.cutoff_for_slope() / 2000, 1)
(2.76, 11.7)
)");
  self_affine
      .def(py::init([](Number<"rms_height"> h, Number<"hurst"> hurst, Number<"q0"> q0, Number<"q1"> q1,
                       OptionalNumber<"rolloff"> rolloff) {
             const SelfAffineSpectrum s{h, hurst, q0, q1, rolloff};
             validate(s);
             return s;
           }),
           py::kw_only(), py::arg("rms_height"), py::arg("hurst"), py::arg("q0"), py::arg("q1"),
           py::arg("rolloff") = py::none())
      .def_static(
          "from_article",
          [](Number<"h0"> h0, Number<"hurst"> hurst, Number<"q0"> q0, Number<"q1"> q1) {
            return SelfAffineSpectrum::from_article(h0, hurst, q0, q1);
          },
          py::kw_only(), py::arg("h0"), py::arg("hurst"), py::arg("q0"), py::arg("q1"),
          "Eq. 12 as printed, C = (h0 / q0)^2 (H / 2 pi) (q / q0)^(-2 (H + 1)), cut at q1. Its rms height is "
          "not h0 but h0 / sqrt(2) for q1 >> q0: for reproducing the article only.")
      .def_readonly("rms_height", &SelfAffineSpectrum::rms_height, "h_rms [m].")
      .def_readonly("hurst", &SelfAffineSpectrum::hurst, "Hurst exponent H [-].")
      .def_readonly("q0", &SelfAffineSpectrum::q0, "Lower cut-off [1/m].")
      .def_readonly("q1", &SelfAffineSpectrum::q1, "Upper cut-off [1/m].")
      .def_readonly("rolloff", &SelfAffineSpectrum::rolloff, "Roll-off [1/m] or None.");
  self_affine.def(
      "extended",
      [](const SelfAffineSpectrum& s, OptionalNumber<"q0"> q0, OptionalNumber<"q1"> q1) { return extended(s, q0, q1); },
      py::kw_only(), py::arg("q0") = py::none(), py::arg("q1") = py::none(),
      "The same law on another band [1/m], wider or narrower: beyond the old ends the power law goes on, and below a "
      "roll-off the flat part. C(q) stays, the rms height follows; a new spectrum.");
  bind_common(self_affine);
  value_semantics(self_affine, {"rms_height", "hurst", "q0", "q1", "rolloff"});

  py::classh<TabulatedSpectrum> table(m, "TabulatedSpectrum", R"(Spectrum given at wavenumbers.

Log-log linear between rows, linear in q where one of the two is zero. Beyond the rows: OutOfRange.

Parameters
----------
wavenumber : array_like, shape (n,)
    Angular wavenumbers [1/m], strictly rising, n >= 2.
density : array_like, shape (n,)
    C(q) [m^4], not negative.
count : array_like, shape (n,), optional
    Modes averaged in each row: the weights of a fit.
standard_error : array_like, shape (n,), optional
    Of the density [m^4].
flag : array_like of int, shape (n,), optional
    Why a row is not to be trusted, a sum of 1: fewer than 16 (split cosine bell) or 10 (Hann) periods on the scan;
    2: above half of pi / pixel, where what is finer than the pixels is folded back; 4: so few modes that their mean
    is uncertain by more than a quarter. 0: reliable.

Raises
------
InvalidInput
)");
  table
      .def(py::init(&make_rows<TabulatedSpectrum>), py::kw_only(), py::arg("wavenumber"), py::arg("density"),
           py::arg("count") = py::none(), py::arg("standard_error") = py::none(), py::arg("flag") = py::none())
      .def_property_readonly("rms_height",
                             released<TabulatedSpectrum>([](const TabulatedSpectrum& s) { return rms_height(s); }),
                             "sqrt(2 pi int q C dq) [m].")
      .def_property_readonly(
          "q0", [](const TabulatedSpectrum& s) { return band(s)[0]; }, "First row [1/m].")
      .def_property_readonly(
          "q1", [](const TabulatedSpectrum& s) { return band(s)[1]; }, "Last row [1/m].");
  bind_common(table);
  bind_rows(table, "C [m^4]");
}

}  // namespace asperity::python
