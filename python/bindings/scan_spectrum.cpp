// From scans to spectra: maps, profiles, their averages.
#include <pybind11/stl.h>

#include "arguments.hpp"
#include "parts.hpp"
#include "rows.hpp"
#include "surface.hpp"

namespace asperity::python {

namespace {

const auto windows = {std::pair{"split-cosine-bell", Window::split_cosine_bell}, std::pair{"hann", Window::hann},
                      std::pair{"none", Window::none}};
const auto parts = {std::pair{"all", Part::all}, std::pair{"top", Part::top}, std::pair{"bottom", Part::bottom}};

struct SpectralDensityTag {
  static constexpr Field fields[] = {
      {"wavenumber_y", Holds::numbers}, {"wavenumber_x", Holds::numbers}, {"density", Holds::numbers}};
};
struct AnisotropyTag {
  static constexpr Field fields[] = {{"across", Holds::number}, {"along", Holds::number}, {"direction", Holds::number}};
};

/// What every transform of a map takes.
struct How {
  Window window;
  std::optional<Detrend> detrend;
};
How how(const Option& window, const Option& detrend) {
  return {choice<Window>("window", window, windows), choice_or_none<Detrend>("detrend", detrend, detrends)};
}

const HeightMap& map_of(const py::object& surface) {
  if (py::isinstance<LineScan>(surface))
    throw InvalidInput("surface = a LineScan: must be a HeightMap; line_spectrum takes line scans");
  return object_of<HeightMap>(surface, "surface", "a HeightMap");
}

}  // namespace

void bind_scan_spectrum(py::module_& m) {
  m.def(
      "power_spectrum",
      [](const py::object& surface, const Option& window, const Option& detrend, Whole<"threads"> threads,
         const Option& part) {
        if (threads < 1 || threads > 1024)
          throw InvalidInput("threads = " + std::to_string(threads.value) + ": must be from 1 to 1024");
        const HeightMap& map = map_of(surface);
        const How h = how(window, detrend);
        const auto side = choice<Part>("part", part, parts);
        const py::gil_scoped_release release;
        return power_spectrum(map, h.window, h.detrend, static_cast<unsigned>(threads.value), side);
      },
      py::arg("surface"), py::kw_only(), py::arg("window") = "split-cosine-bell", py::arg("detrend") = "plane",
      py::arg("threads") = 1, py::arg("part") = "all",
      R"(Radially averaged roughness spectrum of a map (Eqs 25-27).

Detrended, windowed, transformed; |h(q)|^2 averaged over rings round(|q| / dq), dq = 2 pi / longest side, out to the
corner of the plane. The mean square of the window is divided out.

Parameters
----------
surface : HeightMap
    Without drop-outs.
window : {"split-cosine-bell", "hann", "none"}
    "none" is right for periodic maps only, and then with detrend=None: a plane taken out of a periodic map leaves a
    saw-tooth.
detrend : {"plane", "quadratic", "offset", None}
threads : int
    Threads of its own that the call may use. The sums then differ in rounding.
part : {"all", "top", "bottom"}
    "top": the spectrum of max(h, 0), h the height above the mean plane, divided by the share of points above it
    (B. N. J. Persson et al., J. Phys.: Condens. Matter 17, R1 (2005)); "bottom": of min(h, 0) likewise. They agree
    with the whole at large q where heights are Gaussian; on worn tracks the top is what the rubber meets.

float32 maps are transformed in single precision, whose noise lies some 14 decades below the highest density.

Returns
-------
TabulatedSpectrum
    `wavenumber` the mean |q| of a ring's modes [1/m], `density` C [m^4], `count` the modes of the full plane in it:
    sum(density * count) (2 pi)^2 / area is the mean square height (Parseval). `standard_error` as for Gaussian heights,
    whose |h(q)|^2 scatter as much as their mean. `flag` says what not to trust. Rings beyond the Nyquist wavenumber
    pi / pixel are incomplete: cut there with `truncated` before taking moments or contact from it.

Raises
------
InvalidInput
    Drop-outs, fewer than 2 x 2 points, a LineScan.
)");

  bind_record<SpectralDensityTag>(m, "SpectralDensity", R"(What `spectral_density` returns.

wavenumber_y, wavenumber_x : rising, shapes (ny,) and (nx,) [1/m].
density : C [m^4], shape (ny, nx).
)");
  m.def(
      "spectral_density",
      [](const py::object& surface, const Option& window, const Option& detrend) {
        const HeightMap& map = map_of(surface);
        const How h = how(window, detrend);
        SpectralDensity found;
        {
          const py::gil_scoped_release release;
          found = spectral_density(map, h.window, h.detrend);
        }
        const Shape shape{static_cast<py::ssize_t>(map.shape()[0]), static_cast<py::ssize_t>(map.shape()[1])};
        Record<SpectralDensityTag> record;
        record.values["wavenumber_y"] = flat(std::move(found.wavenumber_y));
        record.values["wavenumber_x"] = flat(std::move(found.wavenumber_x));
        record.values["density"] = shaped(std::move(found.density), shape);
        return record;
      },
      py::arg("surface"), py::kw_only(), py::arg("window") = "split-cosine-bell", py::arg("detrend") = "plane",
      R"(C over the whole plane of wavevectors [m^4], as `power_spectrum` averages it over rings.

Parameters
----------
surface, window, detrend
    As in `power_spectrum`.

Returns
-------
SpectralDensity
    In rising wavenumbers [1/m], as numpy.fft.fftshift orders them: ready for matplotlib's pcolormesh.

Raises
------
InvalidInput
)");

  bind_record<AnisotropyTag>(m, "Anisotropy", R"(What `anisotropy` returns.

across, along : rms slopes [-] along the two principal axes, across >= along; equal on an isotropic surface.
direction : of the lay, along which the slope is least [-]: the angle in radians from x towards y (rising row index).
)")
      .def_property_readonly(
          "ratio",
          [](const Record<AnisotropyTag>& r) {
            return r.values["across"].cast<double>() / r.values["along"].cast<double>();
          },
          "across / along, 1 for an isotropic surface.");
  m.def(
      "anisotropy",
      [](const py::object& surface, const Option& window, const Option& detrend, OptionalNumber<"q_min"> q_min,
         OptionalNumber<"q_max"> q_max) {
        const HeightMap& map = map_of(surface);
        const How h = how(window, detrend);
        Anisotropy found;
        {
          const py::gil_scoped_release release;
          found = anisotropy(map, h.window, h.detrend, q_min, q_max);
        }
        Record<AnisotropyTag> record;
        record.values["across"] = found.across;
        record.values["along"] = found.along;
        record.values["direction"] = found.direction;
        return record;
      },
      py::arg("surface"), py::kw_only(), py::arg("window") = "split-cosine-bell", py::arg("detrend") = "plane",
      py::arg("q_min") = py::none(), py::arg("q_max") = py::none(),
      R"(Principal axes of the mean square slopes <dh/dx_i dh/dx_j> = int q_i q_j C d^2q over a band.

After M. S. Longuet-Higgins, Phil. Trans. R. Soc. Lond. A 249, 321 (1957). A radial spectrum averages over directions:
where the ratio is far from 1 it stands for no direction in particular.

Parameters
----------
surface, window, detrend
    As in `power_spectrum`.
q_min, q_max : float, optional
    The band [1/m]; by default that of the rows which `power_spectrum` does not flag for the window or Nyquist.

Returns
-------
Anisotropy

Raises
------
InvalidInput
    Fewer than 16 modes in the band.
)");

  py::classh<LineSpectrum> line(m, "LineSpectrum", R"(Two-sided spectrum C1D of profiles, at positive wavenumbers.

h_rms^2 is its integral over wavenumbers of both signs.

Parameters
----------
wavenumber : array_like, shape (n,)
    Angular wavenumbers [1/m], strictly rising, n >= 2.
density : array_like, shape (n,)
    C1D [m^3], not negative.
count, standard_error, flag : array_like, shape (n,), optional
    As in TabulatedSpectrum.

Raises
------
InvalidInput
)");
  line.def(py::init(&make_rows<LineSpectrum>), py::kw_only(), py::arg("wavenumber"), py::arg("density"),
           py::arg("count") = py::none(), py::arg("standard_error") = py::none(), py::arg("flag") = py::none())
      .def(
          "isotropic",
          [](const LineSpectrum& s, OptionalNumber<"per_decade"> per_decade) {
            const py::gil_scoped_release release;
            return isotropic(per_decade.value ? log_binned(s, *per_decade.value) : s);
          },
          py::kw_only(), py::arg("per_decade") = 10.0,
          R"(The spectrum C [m^4] of the isotropic surface that has such profiles, a TabulatedSpectrum.

C(q) = -(1/pi) int_q^inf dC1D/dk dk / sqrt(k^2 - q^2) (the inverse Abel transform), exact for the power laws between
the rows. Beyond the last row the slope of the last factor of 2 goes on. Rows of one profile scatter as much as their
mean: they are averaged over `per_decade` logarithmic bins first; None takes them as they are. Flagged rows that come out
negative are left out.

Raises
------
InvalidInput
    A density of zero, a spectrum that no isotropic surface can have (it rises too steeply).
)");
  bind_rows(line, "C1D [m^3]");
  m.def(
      "line_spectrum",
      [](const py::object& surface, const Option& window, const Option& detrend) {
        const How h = how(window, detrend);
        if (py::isinstance<LineScan>(surface)) {
          const auto& scan = surface.cast<const LineScan&>();
          const py::gil_scoped_release release;
          return line_spectrum(scan, h.window, h.detrend);
        }
        const auto& map = object_of<HeightMap>(surface, "surface", "a LineScan or a HeightMap");
        const py::gil_scoped_release release;
        return line_spectrum(map, h.window, h.detrend);
      },
      py::arg("surface"), py::kw_only(), py::arg("window") = "split-cosine-bell", py::arg("detrend") = "plane",
      R"(One-dimensional spectrum C1D [m^3] of a line scan, or averaged over the rows of a map.

Each row is detrended (offset, straight line, parabola) and windowed as a scan of its own.

Parameters
----------
surface : LineScan or HeightMap
    Without drop-outs.
window, detrend
    As in `power_spectrum`.

Returns
-------
LineSpectrum
    Two-sided, at positive wavenumbers [1/m]: sum(density * count) / rows times 2 pi / length is the mean square height.
    `standard_error` takes rows nearer than half a wavelength as one.

Raises
------
InvalidInput
    Drop-outs, fewer than 4 points along x.
)");
  m.def(
      "merge_spectra",
      [](const Many<"spectra">& spectra, OptionalNumber<"per_decade"> per_decade) {
        std::vector<TabulatedSpectrum> all;
        for (const py::handle& one : spectra.value)
          all.push_back(object_of<TabulatedSpectrum>(py::reinterpret_borrow<py::object>(one),
                                                     ("spectra[" + std::to_string(all.size()) + "]").c_str(),
                                                     "a TabulatedSpectrum"));
        const py::gil_scoped_release release;
        return merge_spectra(all, per_decade);
      },
      py::arg("spectra"), py::kw_only(), py::arg("per_decade") = py::none(),
      R"(One spectrum of several scans of a surface, at one or several magnifications.

Parameters
----------
spectra : iterable of TabulatedSpectrum
per_decade : float, optional
    Logarithmic bins in a factor 10 of wavenumber [1/m], as in `log_binned`, in which rows of all spectra meet; rows that
    are flagged for the window or Nyquist are left out of bins that have others. Without it all spectra must have the
    same wavenumbers, and are averaged row by row.

Returns
-------
TabulatedSpectrum
    Weighted by `count` where the spectra have it.

Raises
------
InvalidInput
    Nothing to merge, different wavenumbers without `per_decade`, counts in some of the spectra only.
)");
}

}  // namespace asperity::python
