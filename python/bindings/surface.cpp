// Height maps and line scans. Their heights are shared with NumPy in both directions and never copied here.
#include "asperity/surface.hpp"

#include "arrays.hpp"
#include "topics.hpp"

namespace asperity::python {

namespace {

/// The numbers of a float32 or float64 array, and its keeper; letting go of the array takes the GIL.
struct Heights {
  explicit Heights(py::array array)
      : data(array.itemsize() == 4 ? HeightMap::Data(static_cast<const float*>(array.data()))
                                   : HeightMap::Data(static_cast<const double*>(array.data()))),
        owner(new py::array(array), [](const void* held) {
          const py::gil_scoped_acquire gil;
          delete static_cast<const py::array*>(held);
        }) {
    for (py::ssize_t i = 0; i < array.ndim(); ++i) {
      strides.push_back(array.strides(i) / array.itemsize());
      shape.push_back(static_cast<std::size_t>(array.shape(i)));
    }
  }
  HeightMap::Data data;
  std::shared_ptr<const void> owner;
  std::vector<std::ptrdiff_t> strides;
  std::vector<std::size_t> shape;
};

/// A view of the numbers that `self` holds: the rows of `map`, or its one row where `self` is a line scan.
py::array view_of(const HeightMap& map, bool line, const py::object& self) {
  return std::visit(
      [&](const auto* first) -> py::array {
        const auto item = static_cast<py::ssize_t>(sizeof(*first));
        std::vector<py::ssize_t> shape, strides;
        for (std::size_t i = line ? 1 : 0; i < 2; ++i) {
          shape.push_back(static_cast<py::ssize_t>(map.shape()[i]));
          strides.push_back(map.strides()[i] * item);
        }
        return py::array_t<std::remove_cvref_t<decltype(*first)>>(shape, strides, first, self);
      },
      map.data());
}

/// What maps and line scans can do alike.
template <class S>
void bind_scan(py::classh<S>& cls) {
  const auto statistic = [&](const char* name, double HeightStatistics::*which) {
    cls.def_property_readonly(name, [which](const S& s) { return released([&] { return s.statistics().*which; }); });
  };
  statistic("rms_height", &HeightStatistics::rms_height);
  statistic("skewness", &HeightStatistics::skewness);
  statistic("kurtosis", &HeightStatistics::kurtosis);
  statistic("z_max", &HeightStatistics::z_max);
  statistic("z_min", &HeightStatistics::z_min);
  using Guarded = py::call_guard<Released>;
  cls.def_property_readonly("dropout_fraction", &S::dropout_fraction)
      .def_property_readonly("rms_slope", [](const S& s) { return released([&] { return s.rms_slope(); }); })
      .def("height_histogram",
           [](const S& s, std::size_t bins) {
             HeightHistogram found = released([&] { return s.height_histogram(bins); });
             return py::make_tuple(array_of(std::move(found.edges)), array_of(std::move(found.density)));
           })
      .def("fill_dropouts", &S::fill_dropouts, Guarded())
      .def("detrend", &S::detrend, Guarded())
      .def("affine_shift", &S::affine_shift, Guarded())
      .def("local_peaks", [](const S& s, double min_distance, bool periodic) {
        return computed([&] { return s.local_peaks(min_distance, periodic); });
      });
}

}  // namespace

void bind_surface(py::module_& m) {
  py::classh<HeightMap> map(m, "HeightMap");
  map.def(py::init([](const py::array& heights, HeightMap::PixelSize pixel_size) {
       const Heights h(heights);
       return released([&] {  // every height is looked at
         return HeightMap(h.data, {h.strides[0], h.strides[1]}, h.owner, {h.shape[0], h.shape[1]}, pixel_size);
       });
     }))
      .def_property_readonly("heights",
                             [](const py::object& self) { return view_of(self.cast<const HeightMap&>(), false, self); })
      .def_property_readonly("pixel_size",
                             [](const HeightMap& s) { return py::make_tuple(s.pixel_size()[0], s.pixel_size()[1]); });
  bind_scan(map);

  py::classh<LineScan> line(m, "LineScan");
  line.def(py::init([](const py::array& heights, double spacing) {
        const Heights h(heights);
        return released([&] { return LineScan(h.data, h.strides[0], h.owner, h.shape[0], spacing); });
      }))
      .def_property_readonly(
          "heights", [](const py::object& self) { return view_of(self.cast<const LineScan&>().row(), true, self); })
      .def_property_readonly("spacing", &LineScan::spacing);
  bind_scan(line);
}

}  // namespace asperity::python
