#include "asperity/surface.hpp"

#include <pybind11/stl.h>

#include <cmath>

#include "arrays.hpp"
#include "heights.hpp"
#include "parts.hpp"
#include "surface.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// What maps and line scans can do alike.
template <class S>
void bind_heights(py::classh<S>& cls) {
  cls.def_property_readonly("dropout_fraction", &S::dropout_fraction, "Share of points not measured.")
      .def_property_readonly("rms_height", released<S>([](const S& s) { return s.statistics().rms_height; }),
                             "Root mean square height [m].")
      .def_property_readonly("rms_slope", released<S>([](const S& s) { return s.rms_slope(); }),
                             "sqrt(<(dh/dx)^2> + <(dh/dy)^2>) [-], central differences at inner points.")
      .def_property_readonly("skewness", released<S>([](const S& s) { return s.statistics().skewness; }),
                             "<z^3> / rms^3 [-].")
      .def_property_readonly("kurtosis", released<S>([](const S& s) { return s.statistics().kurtosis; }),
                             "<z^4> / rms^4 [-]; 3 for Gaussian heights.")
      .def_property_readonly("z_max", released<S>([](const S& s) { return s.statistics().z_max; }),
                             "Highest point above the mean plane [m].")
      .def_property_readonly("z_min", released<S>([](const S& s) { return s.statistics().z_min; }),
                             "Lowest point, negative [m].")
      .def(
          "height_histogram",
          [](const S& s, Whole<"bins"> bins) {
            if (bins < 1) throw InvalidInput("bins = " + std::to_string(bins.value) + ": must be from 1 to 10^6");
            HeightHistogram histogram;
            {
              const py::gil_scoped_release release;
              histogram = s.height_histogram(static_cast<std::size_t>(bins.value));
            }
            return py::make_tuple(flat(std::move(histogram.edges)), flat(std::move(histogram.density)));
          },
          py::kw_only(), py::arg("bins") = 100,
          "(edges, density) of the heights about their mean in equal `bins`: [m], shape (bins + 1,), and [1/m], shape "
          "(bins,), whose integral is 1. InvalidInput where all heights are the same.")
      .def(
          "fill_dropouts", [](const S& s, Number<"max_fraction"> most) { return s.fill_dropouts(most); }, py::kw_only(),
          py::arg("max_fraction") = 0.10, py::call_guard<py::gil_scoped_release>(),
          R"(Drop-outs replaced by linear interpolation; a new object.

On a map between measured points along the row and along the column, weighted by the cube of (1 / a + 1 / b), a and b the
distances to the two; where neither has both immediate neighbours along the diagonals too. A plane comes back exactly. On a
line scan between the neighbours. What lies outside of the measured hull takes the height of its nearest point. Measured
points stay as they are. On synthetic maps this was nearer to the truth than linear interpolation on triangles.

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
          [](const S& s, const Option& order) {
            const auto d = choice<Detrend>("order", order, detrends);
            const py::gil_scoped_release release;
            return s.detrend(d);
          },
          py::arg("order"),
          R"(The heights without its least-squares "offset", "plane" or "quadratic" surface; a new object.

Of a line scan: offset, straight line, parabola.

Fitted to the measured points; drop-outs stay drop-outs.
)")
      .def(
          "affine_shift", [](const S& s, Number<"p"> p) { return s.affine_shift(p); }, py::arg("p"),
          py::call_guard<py::gil_scoped_release>(),
          R"(h_T = (h - z_max) / p + z_max (the article's Eq. 9) of heights above the mean plane; a new object.

Its mean is z_max (1 - 1/p), its highest point stays, its spectrum is C / p^2. `p` >= 1 [-].
)")
      .def(
          "local_peaks",
          [](const S& s, Number<"min_distance"> min_distance, Flag<"periodic"> periodic) {
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
}

HeightMap make_map(const py::object& heights, const Named<PixelSizeArgument, "pixel_size">& pixel_size) {
  const HeightArray h = height_array(heights, 2, "(ny, nx)");
  const py::gil_scoped_release release;  // every height is looked at
  return {h.data, {h.strides[0], h.strides[1]}, h.owner, {h.shape[0], h.shape[1]}, pixel_size_of(pixel_size)};
}

/// A read-only view of the map's own numbers.
py::array heights_view(const py::object& self) {
  const auto& map = self.cast<const HeightMap&>();
  return view_of(map.data(), {map.shape()[0], map.shape()[1]}, {map.strides()[0], map.strides()[1]}, self);
}

void require_spacing(double spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw InvalidInput("spacing = " + py::repr(py::cast(spacing)).cast<std::string>() +
                       ": must be positive and finite");
}

}  // namespace

HeightMap::PixelSize pixel_size_of(const PixelSizeArgument& pixel_size) {
  if (const auto* one = std::get_if<double>(&pixel_size)) return {*one, *one};
  return std::get<std::array<double, 2>>(pixel_size);
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
          "(dy, dx) [m].");
  bind_heights(map);
  value_semantics(map, {"heights", "pixel_size"});

  py::classh<LineScan> line(m, "LineScan",
                            R"(Heights of a surface along a line, at equal distances; constant after construction.

Parameters
----------
heights : array_like, shape (n,)
    Heights [m]; NaN (or a masked entry) marks a drop-out. Shared, not copied, as those of a HeightMap.
spacing : float
    Distance of the points [m].

Statistics refer to the mean height of the measured points.

Raises
------
InvalidInput
    Not one-dimensional, empty, infinite heights, every point a drop-out, spacing not positive.
)");
  line.def(py::init([](const py::object& heights, Number<"spacing"> spacing) {
             const HeightArray h = height_array(heights, 1, "(n,)");
             require_spacing(spacing);
             const py::gil_scoped_release release;
             return LineScan(h.data, h.strides[0], h.owner, h.shape[0], spacing);
           }),
           py::arg("heights"), py::kw_only(), py::arg("spacing"))
      .def_property_readonly(
          "heights",
          [](const py::object& self) {
            const HeightMap& row = self.cast<const LineScan&>().row();
            return view_of(row.data(), {row.shape()[1]}, {row.strides()[1]}, self);
          },
          "Heights [m], shape (n,); a read-only view.")
      .def_property_readonly("spacing", &LineScan::spacing, "[m].");
  bind_heights(line);
  value_semantics(line, {"heights", "spacing"});
}

}  // namespace asperity::python
