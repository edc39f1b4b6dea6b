#include "asperity/surface.hpp"

#include <pybind11/stl.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "parts.hpp"
#include "surface.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// One of the statistics, computed without the GIL.
template <class F>
auto statistic(F f) {
  return [f](const HeightMap& map) {
    const py::gil_scoped_release release;
    return f(map);
  };
}

/// Keeps a NumPy array alive from inside the core; letting go of it takes the GIL.
std::shared_ptr<const void> keep_alive(py::array array) {
  return {new py::array(std::move(array)), [](const void* p) {
            const py::gil_scoped_acquire gil;
            delete static_cast<const py::array*>(p);
          }};
}

/// float32 stays what it is, in whatever byte order it came; other real types become float64.
py::dtype float_type(const py::dtype& found) {
  return py::dtype(found.kind() == 'f' && found.itemsize() == 4 ? "f4" : "f8");
}

HeightMap make_map(const py::object& heights, const PixelSizeArgument& pixel_size) {
  const py::module_ numpy = py::module_::import("numpy");
  py::object values = heights;
  if (py::isinstance(values, numpy.attr("ma").attr("MaskedArray")))  // masked points are drop-outs
    values =
        numpy.attr("ma").attr("filled")(values.attr("astype")(float_type(values.attr("dtype"))), numpy.attr("nan"));
  py::array array = py::array::ensure(values);
  if (!array || std::string("biuf").find(array.dtype().kind()) == std::string::npos) {
    PyErr_Clear();
    throw InvalidInput("heights = " + brief(heights) + ": must be an array of real numbers");
  }
  const py::dtype type = float_type(array.dtype());
  if (!array.dtype().equal(type)) array = array.attr("astype")(type);
  const bool single = type.itemsize() == 4;
  if (array.ndim() != 2)
    throw InvalidInput("heights has " + std::to_string(array.ndim()) + " dimensions: must have 2, (ny, nx)");
  const py::ssize_t item = array.itemsize();
  const bool packed = array.strides(0) % item != 0 || array.strides(1) % item != 0;  // fields of packed records
  if (packed || !array.attr("flags").attr("aligned").cast<bool>()) array = array.attr("copy")();
  const HeightMap::Data data = single ? HeightMap::Data(static_cast<const float*>(array.data()))
                                      : HeightMap::Data(static_cast<const double*>(array.data()));
  const HeightMap::Strides strides{array.strides(0) / item, array.strides(1) / item};
  const HeightMap::Shape shape{static_cast<std::size_t>(array.shape(0)), static_cast<std::size_t>(array.shape(1))};
  return {data, strides, keep_alive(array), shape, pixel_size_of(pixel_size)};
}

/// A read-only view of the map's own numbers.
py::array heights_view(const py::object& self) {
  const auto& map = self.cast<const HeightMap&>();
  return std::visit(
      [&](const auto* data) {
        using T = std::remove_cvref_t<decltype(*data)>;
        const auto item = static_cast<py::ssize_t>(sizeof(T));
        py::array_t<T> view({static_cast<py::ssize_t>(map.shape()[0]), static_cast<py::ssize_t>(map.shape()[1])},
                            {map.strides()[0] * item, map.strides()[1] * item}, data, self);
        view.attr("setflags")(py::arg("write") = false);
        return py::array(view);
      },
      map.data());
}

const auto detrends = {std::pair{"offset", Detrend::offset}, std::pair{"plane", Detrend::plane},
                       std::pair{"quadratic", Detrend::quadratic}};

}  // namespace

HeightMap::PixelSize pixel_size_of(const PixelSizeArgument& pixel_size) {
  if (const auto* one = std::get_if<double>(&pixel_size)) return {*one, *one};
  return std::get<std::array<double, 2>>(pixel_size);
}

Detrend detrend_of(const std::string& argument, const std::string& name) {
  return choice<Detrend>(argument, name, detrends);
}

void bind_surface(py::module_& m) {
  py::classh<HeightMap> map(m, "HeightMap", R"(Heights of a surface on a regular grid; constant after construction.

Parameters
----------
heights : array_like, shape (ny, nx)
    Heights [m]; NaN (or a masked entry) marks a drop-out. float32 and float64 arrays of any strides are shared,
    not copied, and keep their type: do not change them afterwards. Other real types become float64.
pixel_size : float or (float, float)
    Spacing of the points [m], or (dy, dx) where it differs.

Statistics refer to the mean plane at the mean height of the measured points. Tilt and curvature are part of a
map until `detrend` takes them out.

Raises
------
InvalidInput
    Not two-dimensional, empty, infinite heights, every point a drop-out, pixel size not positive.

Examples
--------
>>> import asperity, numpy as np
>>> HeightMap = asperity.HeightMap
>>> m = HeightMap(np.array([[0.0, 1e-6], [1e-6, 0.0]]), pixel_size=1e-6)
>>> round(m.rms_height * 1e6, 6)
0.5
)");
  map.def(py::init(&make_map), py::arg("heights"), py::kw_only(), py::arg("pixel_size"))
      .def_property_readonly("heights", &heights_view, "Heights [m], shape (ny, nx); a read-only view.")
      .def_property_readonly(
          "pixel_size", [](const HeightMap& s) { return py::make_tuple(s.pixel_size()[0], s.pixel_size()[1]); },
          "(dy, dx) [m].")
      .def_property_readonly("dropout_fraction", &HeightMap::dropout_fraction, "Share of points not measured.")
      .def_property_readonly("rms_height", statistic([](const HeightMap& s) { return s.statistics().rms_height; }),
                             "Root mean square height [m].")
      .def_property_readonly("rms_slope", statistic([](const HeightMap& s) { return s.rms_slope(); }),
                             "sqrt(<(dh/dx)^2> + <(dh/dy)^2>) [-], central differences at inner points.")
      .def_property_readonly("skewness", statistic([](const HeightMap& s) { return s.statistics().skewness; }),
                             "<z^3> / rms^3 [-].")
      .def_property_readonly("kurtosis", statistic([](const HeightMap& s) { return s.statistics().kurtosis; }),
                             "<z^4> / rms^4 [-]; 3 for Gaussian heights.")
      .def_property_readonly("z_max", statistic([](const HeightMap& s) { return s.statistics().z_max; }),
                             "Highest point above the mean plane [m].")
      .def_property_readonly("z_min", statistic([](const HeightMap& s) { return s.statistics().z_min; }),
                             "Lowest point, negative [m].")
      .def("fill_dropouts", &HeightMap::fill_dropouts, py::kw_only(), py::arg("max_fraction") = 0.10,
           py::call_guard<py::gil_scoped_release>(),
           R"(Drop-outs replaced by linear interpolation; a new map.

Between measured points along the row and along the column, the two weighted by the inverse square of their gaps;
repeated until every bracketed point is filled, so that a plane comes back exactly. What lies outside of the
measured hull takes the height of the nearest known point. Measured points stay as they are.

Parameters
----------
max_fraction : float
    Largest share of drop-outs that is accepted; 0.10 after the article's Section 5.2.

Raises
------
InvalidInput
    More drop-outs than that.
)")
      .def(
          "detrend",
          [](const HeightMap& s, const std::string& order) {
            const Detrend d = detrend_of("order", order);
            const py::gil_scoped_release release;
            return s.detrend(d);
          },
          py::arg("order"),
          R"(The map without its least-squares "offset", "plane" or "quadratic" surface; a new map.

Fitted to the measured points; drop-outs stay drop-outs.
)")
      .def("affine_shift", &HeightMap::affine_shift, py::arg("p"), py::call_guard<py::gil_scoped_release>(),
           R"(h_T = (h - z_max) / p + z_max (the article's Eq. 9) of heights above the mean plane; a new map.

Its mean is z_max (1 - 1/p), its highest point stays, its spectrum is C / p^2. `p` >= 1 [-].
)")
      .def(
          "local_peaks",
          [](const HeightMap& s, double min_distance, bool periodic) {
            std::vector<double> peaks;
            {
              const py::gil_scoped_release release;
              peaks = s.local_peaks(min_distance, periodic);
            }
            return shaped(std::move(peaks), {static_cast<py::ssize_t>(peaks.size())});
          },
          py::kw_only(), py::arg("min_distance"), py::arg("periodic") = false,
          R"(Heights [m] above the mean plane of the local peaks, highest first (Section 3.1, for Eq. 13).

Maxima among their eight neighbours, taken from the highest down, each no closer than `min_distance` [m] to one
taken before. On a map that is not periodic, points on the edge are no peaks. A plateau counts once.

Raises
------
InvalidInput
    `min_distance` not positive, drop-outs not filled.
)");
  value_semantics(map, {"heights", "pixel_size"});
}

}  // namespace asperity::python
