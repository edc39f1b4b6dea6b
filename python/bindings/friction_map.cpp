// Friction maps: built, read and looked up.
#include "asperity/friction_map.hpp"

#include <tuple>

#include "arrays.hpp"
#include "asperity/build_friction_map.hpp"
#include "topics.hpp"
#include "variants.hpp"

namespace asperity::python {

namespace {

using Outside = FrictionMap::Outside;

/// `name` stands for the map in the message where the bytes hold none.
FrictionMap read(const py::bytes& content, const std::string& name) {
  const std::string_view bytes = content;
  FrictionMap map;
  std::string why;
  if (!map.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), why))
    throw InvalidInput(name + ": " + why);
  return map;
}

/// (shift, heating, temperatures) of a map with heat.
using Heat = std::tuple<TemperatureShift, Heating, std::array<double, 2>>;

py::bytes build(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                const std::optional<Adhesion>& adhesion, std::array<double, 2> pressure, std::array<double, 2> velocity,
                double rtol, std::size_t checked, const std::string& text, unsigned threads, const py::object& told,
                const std::optional<Heat>& heat, const py::object& words) {
  MapRequest request{pressure, velocity, rtol, checked, text, threads};
  if (!words.is_none())
    request.words = [&words](const std::vector<Diagnostic>& notes) {
      const py::gil_scoped_acquire held;
      return notes_of(words(tuple_of(notes)));
    };
  if (!told.is_none())
    request.progress = [&told](double share) {
      const py::gil_scoped_acquire held;
      told(share);
    };
  const auto file = released([&] {
    if (!heat) return build_friction_map(spectrum, rubber, model, adhesion, request);
    const auto& [shift, heating, temperature] = *heat;
    return build_friction_map(spectrum, rubber, shift, heating, model, adhesion, temperature, request);
  });
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

/// Pressure, velocity, a_T, and temperature, distance and direction or None, as `_query` in look_up.py has them.
using Given = std::tuple<Array, Array, Array, std::optional<Array>, std::optional<Array>, std::optional<Array>>;

/// Points to look up: columns as long as the result, or of one entry for all.
struct Points {
  MapColumns columns;
  std::size_t size;

  explicit Points(const Given& given) : columns{}, size(0) {
    const auto& [p, v, a_T, background, distance, direction] = given;
    const auto span_if = [](const auto& column) { return column ? span_of(*column) : std::span<const double>{}; };
    columns = {span_of(p), span_of(v), span_of(a_T), span_if(background), span_if(distance), span_if(direction)};
    for (const auto& column :
         {columns.pressure, columns.velocity, columns.a_T, columns.background, columns.distance, columns.direction})
      size = std::max(size, column.size());
  }
  [[nodiscard]] static double of(std::span<const double> column, std::size_t i) {
    return column[column.size() > 1 ? i : 0];
  }
  [[nodiscard]] double pressure(std::size_t i) const { return of(columns.pressure, i); }
  [[nodiscard]] double velocity(std::size_t i) const { return of(columns.velocity, i); }
  [[nodiscard]] MapTemperature temperature(std::size_t i, bool shifts_adhesion) const {
    MapTemperature result{of(columns.a_T, i), shifts_adhesion};
    if (!columns.background.empty()) result.background = of(columns.background, i);
    if (!columns.distance.empty()) result.distance = of(columns.distance, i);
    if (!columns.direction.empty()) result.direction = of(columns.direction, i);
    return result;
  }
};

/// (one number at each point, the first point without a value or how many points there are).
template <MapQuantity quantity>
py::tuple column_of(const FrictionMap& map, const Given& given, bool shifts_adhesion, Outside outside) {
  const Points points(given);
  // not cleared: of 1e8 points that takes a second in which no signal is heeded
  py::array_t<double> found(static_cast<py::ssize_t>(points.size));
  const std::span<double> to(found.mutable_data(), points.size);
  const std::size_t first =
      released([&] { return look_up(quantity, map, points.columns, outside, shifts_adhesion, to); });
  return py::make_tuple(found, first);
}

/// (dmu_dlnp, dmu_dlnv: a row each; the first point without them).
py::tuple slopes_of(const FrictionMap& map, const Given& given, bool shifts_adhesion, Outside outside) {
  const Points points(given);
  const std::size_t n = points.size;
  py::array_t<double> found({std::size_t{2}, n});
  const std::span<double> to(found.mutable_data(), 2 * n);
  const std::size_t first =
      released([&] { return look_up_slopes(map, points.columns, outside, shifts_adhesion, to.first(n), to.last(n)); });
  return py::make_tuple(found, first);
}

/// Rows of numbers at each point, and the first point whose first number is none.
template <std::size_t rows, class Numbers>
py::tuple rows_of(const Points& points, const Numbers& numbers) {
  const std::size_t n = points.size;
  py::array_t<double> found({rows, n});
  double* const to = found.mutable_data();
  std::size_t first = n;
  released([&] {
    for (std::size_t i = 0; i < n; ++i) {
      heed_at(i);
      const std::array<double, rows> values = numbers(i);
      if (std::isnan(values[0]) && first == n) first = i;
      for (std::size_t k = 0; k < rows; ++k) to[k * n + i] = values[k];
    }
  });
  return py::make_tuple(found, first);
}

/// (mu, hysteresis, adhesion, area, dmu_dlnp, dmu_dlnv, lateral: a row each; the first point without a value).
py::tuple points_of(const FrictionMap& map, const Given& given, bool shifts_adhesion, Outside outside) {
  const Points points(given);
  return rows_of<7>(points, [&](std::size_t i) {
    MapPoint at;
    map.at(points.pressure(i), points.velocity(i), at, outside, points.temperature(i, shifts_adhesion));
    return std::array{at.mu, at.hysteresis, at.adhesion, at.contact_area, at.dmu_dlnp, at.dmu_dlnv, at.lateral};
  });
}

/// A row of s0 over velocity and temperature.
py::tuple sliding_length_of(const FrictionMap& map, const Given& given, bool /*shifts_adhesion*/, Outside outside) {
  const Points points(given);
  return rows_of<1>(points, [&](std::size_t i) {
    return std::array{map.sliding_length(points.velocity(i), points.temperature(i, false).background, outside)};
  });
}

py::dict info_of(const FrictionMap& map) {
  const FrictionMapInfo& i = map.info();
  py::dict info;
  info["pressure"] = py::make_tuple(i.pressure[0], i.pressure[1]);
  info["velocity"] = py::make_tuple(i.velocity[0], i.velocity[1]);
  info["rtol"] = i.rtol;
  info["max_error"] = i.max_error;
  info["checked"] = i.checked;
  info["exceeded"] = i.exceeded;
  info["largest_checked_error"] = i.largest_checked_error;
  info["cells"] = i.cells;
  info["text"] = py::bytes(i.text);
  info["temperature"] = i.heat ? py::object(py::make_tuple(i.temperature[0], i.temperature[1])) : py::none();
  info["temperatures"] = i.temperatures;
  info["directional"] = i.directional;
  info["turns"] = i.turns;
  info["memory_error"] = i.heat ? py::object(py::float_(i.memory_error)) : py::none();
  info["adhesion"] = py::make_tuple(i.shear_stress, i.reference_velocity, i.width);
  return info;
}

}  // namespace

void bind_friction_map(py::module_& m) {
  py::classh<FrictionMap>(m, "FrictionMap")
      .def(py::init(&read))
      .def("info", &info_of)
      .def("mu", &column_of<MapQuantity::mu>)
      .def("hysteresis", &column_of<MapQuantity::hysteresis>)
      .def("adhesion", &column_of<MapQuantity::adhesion>)
      .def("contact_area", &column_of<MapQuantity::contact_area>)
      .def("traction", &column_of<MapQuantity::traction>)
      .def("lateral", &column_of<MapQuantity::lateral>)
      .def("slopes", &slopes_of)
      .def("mu_at",
           [](const FrictionMap& map, double p, double v) {
             const double a_T = 1;
             double mu = 0;
             look_up(map, {{&p, 1}, {&v, 1}, {&a_T, 1}}, Outside::nan, false, {&mu, 1});
             return mu;
           })
      .def("points", &points_of)
      .def("sliding_length", &sliding_length_of)
      .def("status", [](const FrictionMap& map, double p, double v, double a_T, double background, double distance,
                        double direction, bool shifts_adhesion, Outside outside) {
        MapPoint at;
        return static_cast<int>(map.at(p, v, at, outside, {a_T, shifts_adhesion, background, distance, direction}));
      });
  m.def("build_friction_map", &build);
}

}  // namespace asperity::python
