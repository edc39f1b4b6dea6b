#include "asperity/friction_map.hpp"

#include <pybind11/stl.h>

#include <locale>
#include <sstream>

#include "arguments.hpp"
#include "arrays.hpp"
#include "asperity/build_friction_map.hpp"
#include "contact.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

/// A stream whose decimal point no locale changes.
std::ostringstream plain_text() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(12);
  return text;
}

/// A map and the bytes that it was read from.
struct Map {
  std::vector<unsigned char> file;
  FrictionMap map;
};

Map from_bytes(std::vector<unsigned char> file, const std::string& name) {
  Map result{std::move(file), {}};
  std::string why;
  if (!result.map.read(result.file.data(), result.file.size(), why)) throw InvalidInput(name + ": " + why);
  return result;
}

py::bytes to_bytes(const Map& m) { return {reinterpret_cast<const char*>(m.file.data()), m.file.size()}; }

Map from_python_bytes(const py::bytes& bytes, const std::string& name) {
  const std::string_view view = bytes;
  return from_bytes({view.begin(), view.end()}, name);
}

std::string path_of(const py::object& path) {
  const std::string name = py::module_::import("os").attr("fsencode")(path).cast<std::string>();
  if (name.find('\0') != std::string::npos) throw InvalidInput("path = " + brief(path) + ": must not hold a NUL");
  return name;
}

std::array<double, 2> box(const py::object& given, const char* name) {
  const std::vector<double> sides = vector_of(given, name);
  if (sides.size() != 2) throw InvalidInput(std::string(name) + " = " + brief(given) + ": must be (lo, hi)");
  return {sides[0], sides[1]};
}

Map build(const py::object& spectrum, const py::object& rubber, const py::object& pressure, const py::object& velocity,
          Number<"rtol"> rtol, Number<"poisson_ratio"> poisson_ratio, const py::object& correction,
          const py::object& adhesion, const Option& form, const Option& method, Whole<"checked"> checked,
          const Named<std::string, "text">& text) {
  if (checked < 0) throw InvalidInput("checked = " + std::to_string(checked.value) + ": must be 0 or more");
  const auto heed_interrupts = [] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  std::string lines = text.value;
  if (lines.empty())
    for (const auto& [name, part] : {std::pair{"spectrum", spectrum}, std::pair{"rubber", rubber},
                                     std::pair{"correction", correction}, std::pair{"adhesion", adhesion}})
      lines += std::string(name) + " = " +
               py::str(" ").attr("join")(py::repr(part).attr("split")()).cast<std::string>() + "\n";
  const MapRequest request{box(pressure, "pressure"),
                           box(velocity, "velocity"),
                           rtol,
                           static_cast<std::size_t>(checked.value),
                           lines,
                           heed_interrupts};
  const ContactModel model = contact_model(poisson_ratio, correction, form_of(form), 1e-6, method);
  const Spectrum surface = spectrum_of(spectrum);
  const Rubber material = rubber_of(rubber);
  std::optional<Adhesion> sticking;
  if (!adhesion.is_none()) sticking = object_of<Adhesion>(adhesion, "adhesion", "an Adhesion or None");
  std::vector<unsigned char> file;
  {
    const py::gil_scoped_release release;
    file = build_friction_map(surface, material, model, sticking, request);
  }
  return from_bytes(std::move(file), "friction_map");
}

/// Where a point is outside of the map, as an error.
[[noreturn]] void refuse(const FrictionMapInfo& info, FrictionMap::Status status, std::size_t i, double pressure,
                         double velocity, double shift, bool scalar) {
  const auto named = [&](const char* name, double value) {
    std::ostringstream text = plain_text();
    text << name;
    if (!scalar) text << '[' << i << ']';
    text << " = " << value;
    return text.str();
  };
  std::ostringstream allowed = plain_text();
  if (status == FrictionMap::Status::pressure_outside) {
    allowed << ": the map covers [" << info.pressure[0] << ", " << info.pressure[1] << "] Pa";
    throw OutOfRange(named("pressure", pressure) + allowed.str());
  }
  if (status == FrictionMap::Status::velocity_outside) {
    allowed << (shift == 1 ? ": the map covers [" : ": shift_factor times it must be in [") << info.velocity[0] << ", "
            << info.velocity[1] << "] m/s";
    throw OutOfRange(named("velocity", velocity) + allowed.str());
  }
  const bool of_pressure = std::isnan(pressure), of_velocity = std::isnan(velocity);
  throw InvalidInput(named(of_pressure   ? "pressure"
                           : of_velocity ? "velocity"
                                         : "shift_factor",
                           of_pressure   ? pressure
                           : of_velocity ? velocity
                                         : shift) +
                     ": must be " + (of_pressure || of_velocity ? "a number" : "positive and finite"));
}

enum class Policy { error, nan, clamp };

Policy policy_of(const Option& outside) {
  return choice<Policy>("outside", outside, {{"error", Policy::error}, {"nan", Policy::nan}, {"clamp", Policy::clamp}});
}

/// Values at every point, several a point: `at` fills them in and gives the point's status.
template <std::size_t N, class At>
std::array<py::object, N> look_up(const Map& m, const py::object& pressure, const py::object& velocity,
                                  const py::object& shift_factor, bool shift_adhesion, const Option& outside, At at) {
  const auto policy = policy_of(outside);
  const Broadcast b = broadcast({{"pressure", pressure}, {"velocity", velocity}, {"shift_factor", shift_factor}});
  const auto& [p, v, shift] = std::tie(b.columns[0], b.columns[1], b.columns[2]);
  std::array<std::vector<double>, N> columns;
  for (auto& column : columns) column.resize(p.size());
  {
    const py::gil_scoped_release release;
    const auto how = policy == Policy::clamp ? FrictionMap::Outside::clamp : FrictionMap::Outside::nan;
    for (std::size_t i = 0; i < p.size(); ++i) {
      std::array<double, N> values;
      const auto status = at(m.map, p[i], v[i], how, MapTemperature{shift[i], shift_adhesion}, values);
      const bool fails = policy == Policy::error
                             ? status != FrictionMap::Status::ok
                             : policy == Policy::clamp && status == FrictionMap::Status::not_a_number;
      if (fails) refuse(m.map.info(), status, i, p[i], v[i], shift[i], b.shape.empty());
      for (std::size_t k = 0; k < N; ++k) columns[k][i] = values[k];
    }
  }
  std::array<py::object, N> result;
  for (std::size_t k = 0; k < N; ++k) result[k] = shaped(std::move(columns[k]), b.shape);
  return result;
}

/// For `look_up`: what `get` takes from a point, N numbers.
template <std::size_t N, class Get>
auto of_point(Get get) {
  return [get](const FrictionMap& map, double p, double v, FrictionMap::Outside how, const MapTemperature& temperature,
               std::array<double, N>& values) {
    MapPoint point;
    const auto status = map.at(p, v, point, how, temperature);
    values = get(point);
    return status;
  };
}

/// For `look_up`: a traction is there without load and at rest too.
FrictionMap::Status traction_at(const FrictionMap& map, double p, double v, FrictionMap::Outside how,
                                const MapTemperature& temperature, std::array<double, 1>& traction) {
  traction[0] = map.traction(p, v, how, temperature);
  MapPoint point;
  return std::isnan(traction[0]) ? map.at(p, v, point, how, temperature) : FrictionMap::Status::ok;
}

/// mu alone, by the vector units.
py::object mu_of(const Map& m, const py::object& pressure, const py::object& velocity, const py::object& shift_factor,
                 Flag<"shift_adhesion"> shift_adhesion, const Option& outside) {
  const auto policy = policy_of(outside);
  const Views b = views({{"pressure", pressure}, {"velocity", velocity}, {"shift_factor", shift_factor}});
  const MapColumns points{b.view(0), b.view(1), b.view(2)};
  Array mu(b.shape);
  const std::span<double> all(mu.mutable_data(), static_cast<std::size_t>(mu.size()));
  {
    const py::gil_scoped_release release;
    const auto how = policy == Policy::clamp ? FrictionMap::Outside::clamp : FrictionMap::Outside::nan;
    const std::size_t i = look_up(m.map, points, how, shift_adhesion, all);
    if (policy != Policy::nan && i < all.size()) {
      const auto at = [&](std::span<const double> column) { return column[column.size() > 1 ? i : 0]; };
      const double p = at(points.pressure), v = at(points.velocity), shift = at(points.shift);
      MapPoint point;
      const auto status = m.map.at(p, v, point, how, {shift, shift_adhesion});
      refuse(m.map.info(), status, i, p, v, shift, b.shape.empty());
    }
  }
  if (b.shape.empty()) return py::float_(all[0]);
  return mu;
}

struct SlopesTag {
  static constexpr Field fields[] = {{"dmu_dlnp", Holds::numbers}, {"dmu_dlnv", Holds::numbers}};
};

/// Lines of the text that begin with "note: ".
std::vector<std::string> notes_of(const std::string& text) {
  std::vector<std::string> notes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("note: ", 0) == 0) notes.push_back(line.substr(6));
  return notes;
}

}  // namespace

void bind_friction_map(py::module_& m) {
  bind_record<SlopesTag>(m, "FrictionSlopes",
                         R"(What `FrictionMap.derivatives` returns. Scalars for scalar arguments, else arrays.

dmu_dlnp : d mu / d ln p [-].
dmu_dlnv : d mu / d ln |v| [-].
)");

  py::classh<Map> map(m, "FrictionMap", R"(mu over pressure and velocity, looked up within a certified error.

Made by `friction_map`, or from a file. Hysteresis and contact area are stored, as bicubic polynomials of ln v and ln p
with continuous first derivatives; the adhesion (Eq. 23) is added in closed form. The C++ header
`asperity/friction_map.hpp`, which needs nothing else, reads the same file and says what each of its bytes means.

Every look-up takes

pressure, velocity : array_like
    [Pa], [m/s]; they broadcast, with `shift_factor` too. mu and its parts are even in the velocity.
shift_factor : array_like
    a_T of another temperature: hysteresis and area are those at a_T v, the adhesion keeps v.
shift_adhesion : bool
    Whether the adhesion is shifted too, as if v0 were v0 / a_T.
outside : {"error", "nan", "clamp"}
    Of points outside of the map, v = 0 and p <= 0 among them: OutOfRange, NaN, or the value at the nearest point of
    the map (derivatives across that side are 0).

and raises OutOfRange, or InvalidInput for a NaN where `outside` is not "nan".
)");
  const auto define = [&](const char* name, auto look, const char* doc) {
    map.def(name, look, py::arg("pressure"), py::arg("velocity"), py::kw_only(), py::arg("shift_factor") = 1.0,
            py::arg("shift_adhesion") = false, py::arg("outside") = "error", doc);
  };
  const auto define_one = [&](const char* name, auto at, const char* doc) {
    define(
        name,
        [at](const Map& self, const py::object& pressure, const py::object& velocity, const py::object& shift_factor,
             Flag<"shift_adhesion"> shift_adhesion, const Option& outside) {
          return look_up<1>(self, pressure, velocity, shift_factor, shift_adhesion, outside, at)[0];
        },
        doc);
  };
  using One = std::array<double, 1>;
  define("mu", &mu_of, "Friction coefficient, hysteresis + adhesion [-].");
  define_one("hysteresis", of_point<1>([](const MapPoint& at) { return One{at.hysteresis}; }), "mu_H (Eq. 22) [-].");
  define_one("adhesion", of_point<1>([](const MapPoint& at) { return One{at.adhesion}; }), "mu_A (Eq. 23) [-].");
  define_one("contact_area", of_point<1>([](const MapPoint& at) { return One{at.contact_area}; }), "A/A0 at q1 [-].");
  define_one("traction", &traction_at,
             "Shear traction sign(v) mu p [Pa]; 0 where v = 0 or p <= 0, whatever the map covers.");
  define(
      "derivatives",
      [](const Map& self, const py::object& pressure, const py::object& velocity, const py::object& shift_factor,
         Flag<"shift_adhesion"> shift_adhesion, const Option& outside) {
        const auto slopes_at = of_point<2>([](const MapPoint& at) { return std::array{at.dmu_dlnp, at.dmu_dlnv}; });
        auto found = look_up<2>(self, pressure, velocity, shift_factor, shift_adhesion, outside, slopes_at);
        Record<SlopesTag> slopes;
        for (std::size_t k = 0; k < 2; ++k) slopes.values[SlopesTag::fields[k].name] = std::move(found[k]);
        return slopes;
      },
      "d mu / d ln p and d mu / d ln |v|, those of the stored polynomials: a `FrictionSlopes`.");
  map.def(
         "save", [](const Map& self, const py::object& path) { write_whole(path_of(path), self.file); },
         py::arg("path"), "Write the map, whole or not at all. InvalidInput where the path cannot be written.")
      .def_static(
          "load",
          [](const py::object& path) {
            const std::string name = path_of(path);
            const py::bytes content = py::module_::import("pathlib").attr("Path")(path).attr("read_bytes")();
            return from_python_bytes(content, name);
          },
          py::arg("path"),
          "Read a map. InvalidInput where the file is damaged, truncated or of another version, OSError where there is "
          "none.")
      .def_static(
          "from_bytes", [](const py::bytes& content) { return from_python_bytes(content, "content"); },
          py::arg("content"), "From the bytes of a file.")
      .def("to_bytes", &to_bytes, "The bytes of a file.")
      .def("__reduce__",
           [](const py::object& self) {
             // a function of the module: pickle finds no static method of a class of C++
             return py::make_tuple(py::module_::import("asperity._core").attr("_map_of"),
                                   py::make_tuple(to_bytes(self.cast<const Map&>())));
           })
      .def(
          "__eq__", [](const Map& self, const Map& other) { return self.file == other.file; }, py::is_operator())
      .def("__repr__", [](const Map& self) {
        const FrictionMapInfo& i = self.map.info();
        std::ostringstream text = plain_text();
        text << "FrictionMap(pressure=(" << i.pressure[0] << ", " << i.pressure[1] << "), velocity=(" << i.velocity[0]
             << ", " << i.velocity[1] << "), max_error=" << i.max_error << ", cells=" << i.cells << ")";
        return text.str();
      });
  m.def("_map_of", [](const py::bytes& content) { return from_python_bytes(content, "content"); });
  py::setattr(map, "__hash__", py::none());
  made_by_call_alone(map);
  const auto property = [&](const char* name, auto get, const char* doc) {
    map.def_property_readonly(
        name, [get](const Map& self) { return get(self.map.info()); }, doc);
  };
  using Info = FrictionMapInfo;
  property(
      "pressure", [](const Info& i) { return py::make_tuple(i.pressure[0], i.pressure[1]); }, "(lo, hi) [Pa].");
  property(
      "velocity", [](const Info& i) { return py::make_tuple(i.velocity[0], i.velocity[1]); }, "(lo, hi) [m/s].");
  property(
      "rtol", [](const Info& i) { return i.rtol; }, "What was asked for [-].");
  property(
      "max_error", [](const Info& i) { return i.max_error; },
      "Twice the largest relative error of hysteresis and area, on 12 unseen points a cell and its lattice [-].");
  property(
      "checked", [](const Info& i) { return i.checked; }, "Random points that the finished map was checked on.");
  property(
      "exceeded", [](const Info& i) { return i.exceeded; }, "How many of them were off by more than `max_error`.");
  property(
      "largest_checked_error", [](const Info& i) { return i.largest_checked_error; },
      "The largest relative error among them [-].");
  property(
      "cells", [](const Info& i) { return i.cells; }, "Number of polynomials.");
  property(
      "notes", [](const Info& i) { return py::tuple(py::cast(notes_of(i.text))); },
      "Where the theory or its input leaves its range, as `friction` notes it on 81 points of the map.");
  property(
      "text", [](const Info& i) { return py::bytes(i.text).attr("decode")("utf-8", "replace"); },
      "What the map was made of, in lines.");
  property(
      "adhesion_law",
      [](const Info& i) -> py::object {
        if (i.shear_stress == 0) return py::none();
        return py::cast(Adhesion{i.shear_stress, i.reference_velocity, i.width});
      },
      "The Adhesion that is added, or None.");

  m.def("friction_map", &build, py::arg("spectrum"), py::arg("rubber"), py::kw_only(), py::arg("pressure"),
        py::arg("velocity"), py::arg("rtol") = 1e-4, py::arg("poisson_ratio") = 0.5, py::arg("correction") = py::none(),
        py::arg("adhesion") = py::none(), py::arg("form") = "exact", py::arg("method") = "gauss",
        py::arg("checked") = 1'000'000, py::arg("text") = "",
        R"(Map of the friction coefficient for simulators: built to `rtol`, certified, looked up in nanoseconds.

Cells are halved until hysteresis and contact area keep rtol / 2 on lattices of 5 x 5 and on random points that nothing
was made from, 12 a cell; then the finished map is checked on more random points. Where a Greenwood-Williamson correction
changes its state (full contact, beyond its range) the map is split along the boundary, where mu has a kink.

Parameters
----------
spectrum, rubber, poisson_ratio, correction, adhesion, form, method
    As for `friction`.
pressure, velocity : (lo, hi)
    The map's box [Pa], [m/s].
rtol : float
    Relative, of hysteresis and area and so of mu, 1e-12 to 0.1. Cells grow in number as rtol^(-1/2).
checked : int
    Random points of the last check; a million take a second with a Prony series.
text : str
    Lines to keep in the file, for whoever reads it; unless given, what stands for the arguments.

Returns
-------
FrictionMap

Raises
------
InvalidInput
    Also where a part of the box has no contact.
OutOfRange
    The box asks for the modulus outside of a measured master curve.
NotConverged
    rtol is not met, with 100,000 cells or on a point of the last check; the message has what was.

Examples
--------
>>> import asperity
>>> road = asperity.SelfAffineSpectrum(rms_height=265.7e-6, hurst=0.87, q0=2000, q1=2e4)
>>> rubber = asperity.PronySeries(equilibrium_modulus=3e6, moduli=[1e9], relaxation_times=[1e-6])
>>> fmap = asperity.friction_map(road, rubber, pressure=(5e4, 5e5), velocity=(1e-4, 1), checked=1000)
>>> round(fmap.mu(81e3, 1e-2), 4)
0.0034
)");
}

}  // namespace asperity::python
