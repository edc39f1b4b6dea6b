#include "asperity/spectrum.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "parts.hpp"
#include "surface.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

const auto windows = {std::pair{"split-cosine-bell", Window::split_cosine_bell}, std::pair{"hann", Window::hann},
                      std::pair{"none", Window::none}};

/// What both spectra can do.
template <class S>
void bind_common(py::classh<S>& cls) {
  cls.def_property_readonly(
         "rms_slope", [](const S& s) { return rms_slope(s); }, "h' = sqrt(2 pi int q^3 C dq) [-].")
      .def(
          "at",
          [](const S& s, const py::object& q) {
            const Array array = real_array(q, "wavenumber");
            auto values = density(s, std::span(array.data(), static_cast<std::size_t>(array.size())));
            return shaped(std::move(values), Shape(array.shape(), array.shape() + array.ndim()));
          },
          py::arg("wavenumber"),
          "C(q) [m^4] at `wavenumber` [1/m], any shape. A self-affine spectrum is 0 outside its band; a table "
          "raises OutOfRange.")
      .def(
          "truncated",
          [](const S& s, std::optional<double> q0, std::optional<double> q1) {
            return std::get<S>(truncated(Spectrum(s), q0, q1));
          },
          py::kw_only(), py::arg("q0") = py::none(), py::arg("q1") = py::none(),
          "The same densities on a narrower band [1/m]; a new spectrum. InvalidInput where it would be wider.")
      .def(
          "cutoff_for_slope", [](const S& s, double slope) { return cutoff_for_slope(s, slope); },
          py::arg("slope") = 1.3,
          "The wavenumber [1/m] up to which the cumulative rms slope is `slope`, the upper cut-off of the text below "
          "Eq. 22; q1 where the whole spectrum has less.")
      .def(
          "cutoff_for_contamination", [](const S& s, double size) { return cutoff_for_contamination(s, size); },
          py::arg("size"), "2 pi / `size` of the contamination particles [m], at most q1 [1/m].")
      .def(
          "scaled", [](const S& s, double factor) { return std::get<S>(scaled(Spectrum(s), factor)); },
          py::arg("factor"), "All densities times `factor`; a new spectrum.")
      .def(
          "autocorrelation",
          [](const S& s, const py::object& distance) {
            const Array array = real_array(distance, "distance");
            std::vector<double> values;
            {
              const std::span<const double> r(array.data(), static_cast<std::size_t>(array.size()));
              const py::gil_scoped_release release;
              values = autocorrelation(s, r);
            }
            return shaped(std::move(values), Shape(array.shape(), array.shape() + array.ndim()));
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
      .def(py::init([](double h, double hurst, double q0, double q1, std::optional<double> rolloff) {
             const SelfAffineSpectrum s{h, hurst, q0, q1, rolloff};
             validate(s);
             return s;
           }),
           py::kw_only(), py::arg("rms_height"), py::arg("hurst"), py::arg("q0"), py::arg("q1"),
           py::arg("rolloff") = py::none())
      .def_static("from_article", &SelfAffineSpectrum::from_article, py::kw_only(), py::arg("h0"), py::arg("hurst"),
                  py::arg("q0"), py::arg("q1"),
                  "Eq. 12 as printed, C = (h0 / q0)^2 (H / 2 pi) (q / q0)^(-2 (H + 1)), cut at q1. Its rms height is "
                  "not h0 but h0 / sqrt(2) for q1 >> q0: for reproducing the article only.")
      .def_readonly("rms_height", &SelfAffineSpectrum::rms_height, "h_rms [m].")
      .def_readonly("hurst", &SelfAffineSpectrum::hurst, "Hurst exponent H [-].")
      .def_readonly("q0", &SelfAffineSpectrum::q0, "Lower cut-off [1/m].")
      .def_readonly("q1", &SelfAffineSpectrum::q1, "Upper cut-off [1/m].")
      .def_readonly("rolloff", &SelfAffineSpectrum::rolloff, "Roll-off [1/m] or None.");
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

Raises
------
InvalidInput
)");
  table
      .def(py::init([](const py::object& q, const py::object& c, const py::object& n) {
             return TabulatedSpectrum(vector_of(q, "wavenumber"), vector_of(c, "density"),
                                      n.is_none() ? std::vector<double>{} : vector_of(n, "count"));
           }),
           py::kw_only(), py::arg("wavenumber"), py::arg("density"), py::arg("count") = py::none())
      .def_property_readonly(
          "wavenumber", [](const TabulatedSpectrum& s) { return flat(s.wavenumber()); }, "q [1/m], shape (n,).")
      .def_property_readonly(
          "density", [](const TabulatedSpectrum& s) { return flat(s.density()); }, "C [m^4], shape (n,).")
      .def_property_readonly(
          "count",
          [](const TabulatedSpectrum& s) { return s.count().empty() ? py::object(py::none()) : flat(s.count()); },
          "Modes in each row, shape (n,), or None.")
      .def_property_readonly(
          "rms_height", [](const TabulatedSpectrum& s) { return rms_height(s); }, "sqrt(2 pi int q C dq) [m].")
      .def_property_readonly(
          "q0", [](const TabulatedSpectrum& s) { return band(s)[0]; }, "First row [1/m].")
      .def_property_readonly(
          "q1", [](const TabulatedSpectrum& s) { return band(s)[1]; }, "Last row [1/m].");
  bind_common(table);
  value_semantics(table, {"wavenumber", "density", "count"});

  py::classh<SelfAffineFit>(m, "SelfAffineFit", "A power law through a measured spectrum (fit_self_affine).")
      .def(py::init(
               [](const SelfAffineSpectrum& spectrum, const std::map<std::string, double>& errors, std::size_t rows) {
                 if (errors.size() != 2 || !errors.contains("rms_height") || !errors.contains("hurst"))
                   throw InvalidInput("standard_errors: must have rms_height and hurst, and nothing else");
                 return SelfAffineFit{spectrum, errors.at("rms_height"), errors.at("hurst"), rows};
               }),
           py::kw_only(), py::arg("spectrum"), py::arg("standard_errors"), py::arg("rows"))
      .def_property_readonly(
          "rms_height", [](const SelfAffineFit& f) { return f.spectrum.rms_height; }, "h_rms on [q0, q1] [m].")
      .def_property_readonly(
          "hurst", [](const SelfAffineFit& f) { return f.spectrum.hurst; }, "H [-].")
      .def_property_readonly(
          "q0", [](const SelfAffineFit& f) { return f.spectrum.q0; }, "First row used [1/m].")
      .def_property_readonly(
          "q1", [](const SelfAffineFit& f) { return f.spectrum.q1; }, "Last row used [1/m].")
      .def_readonly("spectrum", &SelfAffineFit::spectrum, "The fit as a SelfAffineSpectrum.")
      .def_readonly("rows", &SelfAffineFit::rows, "Rows of the spectrum that were used.")
      .def_property_readonly(
          "standard_errors",
          [](const SelfAffineFit& f) {
            return std::map<std::string, double>{{"rms_height", f.rms_height_error}, {"hurst", f.hurst_error}};
          },
          "{'rms_height': [m], 'hurst': [-]}, from the scatter of the rows about the line.");
  value_semantics(m.attr("SelfAffineFit"), {"spectrum", "standard_errors", "rows"});

  m.def(
      "power_spectrum",
      [](const py::object& scan, const std::string& window, const std::optional<std::string>& detrend,
         long long threads) {
        if (threads < 1 || threads > 1024)
          throw InvalidInput("threads = " + std::to_string(threads) + ": must be from 1 to 1024");
        const auto& surface = object_of<HeightMap>(scan, "surface", "a HeightMap");
        const auto w = choice<Window>("window", window, windows);
        const auto d = detrend ? std::optional(detrend_of("detrend", *detrend)) : std::nullopt;
        const py::gil_scoped_release release;
        return power_spectrum(surface, w, d, static_cast<unsigned>(threads));
      },
      py::arg("surface"), py::kw_only(), py::arg("window") = "split-cosine-bell", py::arg("detrend") = "plane",
      py::arg("threads") = 1,
      R"(Radially averaged roughness spectrum of a map (Eqs 25-27).

Detrended, windowed, transformed; |h(q)|^2 averaged over rings round(|q| / dq), dq = 2 pi / longest side, out to the
corner of the plane. The mean square of the window is divided out.

Parameters
----------
surface : HeightMap
    Without drop-outs.
window : {"split-cosine-bell", "hann", "none"}
    "none" is right for periodic maps only.
detrend : {"plane", "quadratic", "offset", None}
threads : int
    Threads of its own that the call may use. The sums then differ in rounding.

float32 maps are transformed in single precision, whose noise lies some 14 decades below the highest density.

Returns
-------
TabulatedSpectrum
    `wavenumber` the mean |q| of a ring's modes [1/m], `density` C [m^4], `count` the modes of the full plane in it:
    sum(density * count) (2 pi)^2 / area is the mean square height (Parseval). Rings beyond the Nyquist
    wavenumber pi / pixel are incomplete: cut there with `truncated` before taking moments or contact from it.

Raises
------
InvalidInput
    Drop-outs, fewer than 2 x 2 points.
)");
  m.def(
      "fit_self_affine",
      [](const py::object& measured, std::optional<double> q_min, std::optional<double> q_max) {
        const auto& spectrum = object_of<TabulatedSpectrum>(measured, "spectrum", "a TabulatedSpectrum");
        const py::gil_scoped_release release;
        return fit_self_affine(spectrum, q_min, q_max);
      },
      py::arg("spectrum"), py::kw_only(), py::arg("q_min") = py::none(), py::arg("q_max") = py::none(),
      R"(A self-affine power law through a spectrum: H = |slope| / 2 - 1 (Eq. 28) and the rms height on the band.

Least squares in ln C over ln q, each row weighted by its count where it has one.

Parameters
----------
spectrum : TabulatedSpectrum
q_min, q_max : float, optional
    Rows used [1/m]. Under a window the rows below some 16 periods a side read high: leave them out.

Returns
-------
SelfAffineFit

Raises
------
InvalidInput
    Fewer than 3 rows, a density of zero among them, a slope that gives no H in (0, 1].
)");
  m.def(
      "synthesize",
      [](const py::object& spectrum, const std::array<long long, 2>& shape, const PixelSizeArgument& pixel_size,
         long long seed) {
        if (shape[0] < 0 || shape[1] < 0)
          throw InvalidInput("shape = (" + std::to_string(shape[0]) + ", " + std::to_string(shape[1]) +
                             "): must be 2 x 2 or more");
        if (seed < 0) throw InvalidInput("seed = " + std::to_string(seed) + ": must not be negative");
        const HeightMap::Shape grid{static_cast<std::size_t>(shape[0]), static_cast<std::size_t>(shape[1])};
        const Spectrum target = spectrum_of(spectrum);
        const py::gil_scoped_release release;
        return synthesize(target, grid, pixel_size_of(pixel_size), static_cast<std::uint64_t>(seed));
      },
      py::arg("spectrum"), py::kw_only(), py::arg("shape"), py::arg("pixel_size"), py::arg("seed"),
      R"(A periodic map with random phases whose modes have exactly the densities of the spectrum.

Parameters
----------
spectrum : SelfAffineSpectrum or TabulatedSpectrum
    What of its band the grid's modes, from 2 pi / side to the Nyquist corner, do not hold is left out.
shape : (int, int)
    (ny, nx), 2 or more each.
pixel_size : float or (float, float)
    [m], or (dy, dx).
seed : int
    The same map for the same seed on every machine (splitmix64), to rounding.

Returns
-------
HeightMap

Raises
------
InvalidInput
    The band holds no mode of the grid at all.
)");
}

}  // namespace asperity::python
