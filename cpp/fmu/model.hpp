// SPDX-License-Identifier: 0BSD
// What an instance of the FMU is, whatever the standard: a friction map and n contact points, each with a pressure
// and a velocity, and on a map with heat a temperature and the distance that it has slid. Outputs are looked up when
// they are asked for and kept until an input changes.
//
// Friction that begins to slide is cold, and heats up over the map's sliding length. A step adds |v| times its length
// to the distance; sliding begins anew where `reset` is true, at rest, and where the velocity changes its sign.
#ifndef ASPERITY_FMU_MODEL_HPP
#define ASPERITY_FMU_MODEL_HPP

#include <array>
#include <asperity/friction_map.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace asperity_fmu {

/// Value references. Those of a point are numbered on by `stride` from point to point where there are no arrays.
enum Variable : std::uint32_t {
  time = 0,
  pressure = 1,
  velocity = 2,
  temperature = 3,
  reset = 4,
  direction = 5,
  mu = 8,
  mu_hysteresis = 9,
  mu_adhesion = 10,
  contact_area = 11,
  traction = 12,
  dmu_dlnp = 13,
  dmu_dlnv = 14,
  inside = 15,
  slid_distance = 16,
  lateral = 17,
  lateral_traction = 18,
  a_T = 24,
  max_error = 25,
  clamp = 26,
  memory = 27,
};
constexpr std::uint32_t stride = 32, first_output = mu, last_output = lateral_traction;

inline bool is_of_a_point(std::uint32_t variable) {
  return (variable >= pressure && variable <= direction) || (variable >= first_output && variable <= last_output);
}
inline bool is_switch(std::uint32_t variable) { return variable == reset || variable == clamp || variable == memory; }
inline bool is_real_output(std::uint32_t variable) {
  return (variable >= first_output && variable < inside) || variable == lateral || variable == lateral_traction;
}

// All that changes in an instance, what get and set of its state keep: numbers alone, since they are written as such.

struct Point {
  double pressure = 0, velocity = 0, temperature = 0;
  double distance = 0, sign = 0;  // slid since rest [m], and which way
  double reset = 0, direction = 0;
};
struct Settings {
  double time = 0, a_T = 1, clamp = 1, memory = 1;
};
struct State {
  Settings settings;
  std::vector<Point> points;
};
static_assert(sizeof(Point) == 7 * sizeof(double) && sizeof(Settings) == 4 * sizeof(double));

/// Empty where it cannot be read. Streams would make the FMU three times as large.
inline std::string read_file(const std::filesystem::path& path) {
#ifdef _WIN32
  std::FILE* const opened = _wfopen(path.c_str(), L"rb");
#else
  std::FILE* const opened = std::fopen(path.c_str(), "rb");
#endif
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(opened, [](std::FILE* f) { return std::fclose(f); });
  std::string content;
  char block[65536];
  if (file)
    for (std::size_t n = 0; (n = std::fread(block, 1, sizeof block, file.get())) > 0;) content.append(block, n);
  return content;
}

inline std::string first_line(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

/// The number of points of the description whose token this is: the last eight of its hexadecimal digits, before a
/// brace.
inline std::size_t points_of(const std::string& token) {
  constexpr std::size_t digits = 8;
  return token.size() <= digits ? 0
                                : std::strtoull(token.substr(token.size() - digits - 1, digits).c_str(), nullptr, 16);
}

/// With the numbers of both standards.
enum class Status { ok = 0, warning = 1, error = 3 };

class Model {
 public:
  /// From the folder `resources` of the FMU; null, and why not, where its files are not those of a map.
  static std::unique_ptr<Model> load(const std::filesystem::path& resources, std::string& why) {
    const std::size_t points = std::strtoull(read_file(resources / "points.txt").c_str(), nullptr, 10);
    if (points < 1 || points > most_points) {
      why = "resources/points.txt must hold a number of points from 1 to " + std::to_string(most_points);
      return nullptr;
    }
    auto model = std::make_unique<Model>();
    model->token_ = first_line(read_file(resources / "token.txt"));
    if (model->token_.empty()) {
      why = "resources/token.txt must hold the GUID or instantiation token of modelDescription.xml";
      return nullptr;
    }
    if (points != points_of(model->token_)) {
      why = "resources/points.txt has " + std::to_string(points) + " points: must have the " +
            std::to_string(points_of(model->token_)) + " of modelDescription.xml, with which its token ends";
      return nullptr;
    }
    const std::string bytes = read_file(resources / "friction.fmap");
    if (!model->map_.read(bytes.data(), bytes.size(), why)) {
      why = "resources/friction.fmap " + (bytes.empty() ? "cannot be read" : why);
      return nullptr;
    }
    model->state_.points.resize(points);
    model->start_anew();
    return model;
  }

  /// Every point at the middle of the map's box, on logarithmic axes.
  void start_anew() {
    const asperity::FrictionMapInfo& info = map_.info();
    const Point middle{std::sqrt(info.pressure[0] * info.pressure[1]), std::sqrt(info.velocity[0] * info.velocity[1]),
                       (info.temperature[0] + info.temperature[1]) / 2};
    State fresh;
    fresh.points.assign(state_.points.size(), middle);
    restore(std::move(fresh));
  }

  /// What modelDescription.xml calls its guid or its instantiationToken.
  [[nodiscard]] const std::string& token() const { return token_; }
  [[nodiscard]] std::size_t points() const { return state_.points.size(); }
  [[nodiscard]] const State& state() const { return state_; }
  void restore(State state) {
    state_ = std::move(state);
    found_.assign(points(), {});
  }
  void set_time(double now) { state_.settings.time = now; }

  /// False where the map has no such variable.
  [[nodiscard]] bool has(std::uint32_t variable) const {
    const asperity::FrictionMapInfo& info = map_.info();
    if (variable == temperature) return info.temperatures > 1;
    if (variable == direction) return info.turns;
    if (variable == lateral || variable == lateral_traction) return info.directional;
    if (variable == reset || variable == slid_distance || variable == memory) return info.heat;
    return variable != a_T || !info.heat;
  }

  /// False where it cannot be set. Switches are on where they are not 0.
  bool set(std::uint32_t variable, std::size_t point, double value) {
    double* const number = number_of(variable, point);
    if (number == nullptr || variable == time || variable == slid_distance) return false;
    *number = value;
    if (is_of_a_point(variable))
      found_[point].known = false;
    else
      found_.assign(points(), {});
    return true;
  }

  /// A warning where the point lies outside of the map's box or a number is NaN: the value is NaN, or with `clamp`
  /// that of the nearest point of the box.
  Status get(std::uint32_t variable, std::size_t point, double& value) {
    if (!has(variable)) return Status::error;
    if (variable >= first_output && variable <= last_output && variable != slid_distance) {
      Found& found = found_[point];
      if (!found.known) found = look_up(state_.points[point]);
      value = found.values[variable - first_output];
      return found.values[inside - first_output] == 1 ? Status::ok : Status::warning;
    }
    const double* const number = number_of(variable, point);
    if (number == nullptr && variable != max_error) return Status::error;
    value = number == nullptr ? map_.info().max_error : *number;
    return Status::ok;
  }

  /// A warning where a point lies outside.
  Status step(double from, double size) {
    set_time(from + size);
    Status status = Status::ok;
    if (map_.info().heat)
      for (std::size_t i = 0; i < points(); ++i) slide(i, size);
    for (std::size_t i = 0; i < points(); ++i) {
      double is_inside = 0;
      if (get(inside, i, is_inside) != Status::ok) status = Status::warning;
    }
    return status;
  }

  /// d output / d input of a point: in closed form for mu and traction over pressure and
  /// velocity, else by differences over 2e-5 of ln(input), or of the direction, inside of the box. NaN outside.
  [[nodiscard]] double slope(std::uint32_t output, std::uint32_t input, std::size_t point) const {
    const Point at = state_.points[point];
    const Found here = look_up(at);
    const auto value = [](const Found& found, std::uint32_t variable) { return found.values[variable - first_output]; };
    if (value(here, inside) != 1) return std::numeric_limits<double>::quiet_NaN();
    const double sign = at.velocity < 0 ? -1 : 1;
    if (output == mu && input == pressure) return value(here, dmu_dlnp) / at.pressure;
    if (output == mu && input == velocity) return value(here, dmu_dlnv) / at.velocity;
    if (output == traction && input == pressure) return sign * (value(here, mu) + value(here, dmu_dlnp));
    if (output == traction && input == velocity) return sign * at.pressure * value(here, dmu_dlnv) / at.velocity;
    double Point::*const of = input == pressure      ? &Point::pressure
                              : input == velocity    ? &Point::velocity
                              : input == temperature ? &Point::temperature
                                                     : &Point::direction;
    double x[2], f[2];
    for (int side = 0; side < 2; ++side) {
      const double step = side == 0 ? -1e-5 : 1e-5;
      Point moved = at;
      double& changed = moved.*of;
      const double before = changed;
      changed = input == direction ? before + step : before * std::exp(step);
      Found found = look_up(moved);
      x[side] = changed;
      if (value(found, inside) != 1) {
        found = here;
        x[side] = before;
      }
      f[side] = value(found, output);
    }
    return (f[1] - f[0]) / (x[1] - x[0]);
  }

 private:
  static constexpr std::size_t most_points = 1000000;

  /// Where the state has a variable; null where it has none.
  double* number_of(std::uint32_t variable, std::size_t point) {
    Point& at = state_.points[point];
    Settings& settings = state_.settings;
    const std::pair<std::uint32_t, double*> numbers[] = {{time, &settings.time},     {a_T, &settings.a_T},
                                                         {clamp, &settings.clamp},   {memory, &settings.memory},
                                                         {pressure, &at.pressure},   {velocity, &at.velocity},
                                                         {reset, &at.reset},         {temperature, &at.temperature},
                                                         {direction, &at.direction}, {slid_distance, &at.distance}};
    for (const auto& [name, number] : numbers)
      if (name == variable && has(variable)) return number;
    return nullptr;
  }

  struct Found {
    std::array<double, last_output - first_output + 1> values{};
    bool known = false;
  };

  void slide(std::size_t index, double time) {
    Point& point = state_.points[index];
    const double sign = point.velocity > 0 ? 1 : point.velocity < 0 ? -1 : 0;
    if (point.reset != 0 || sign == 0 || sign != point.sign) point.distance = 0;
    point.sign = sign;
    if (sign != 0) point.distance += std::fabs(point.velocity) * time;
    found_[index].known = false;
  }

  [[nodiscard]] Found look_up(const Point& at) const {
    using Map = asperity::FrictionMap;
    const Map::Outside outside = state_.settings.clamp != 0 ? Map::Outside::clamp : Map::Outside::nan;
    asperity::MapPoint found;
    asperity::MapTemperature heat;
    heat.a_T = state_.settings.a_T;
    if (map_.info().temperatures > 1) heat.background = at.temperature;
    if (map_.info().heat && state_.settings.memory != 0) heat.distance = at.distance;
    heat.direction = at.direction;
    const Map::Status status = map_.at(at.pressure, at.velocity, found, outside, heat);
    const double inside_box = status == Map::Status::ok ? 1 : 0, sign = at.velocity < 0 ? -1 : 1;
    const bool is_number = !std::isnan(at.pressure) && !std::isnan(at.velocity);
    const bool is_free = is_number && (at.pressure <= 0 || at.velocity == 0);  // no traction, whatever the map's box
    const double load = sign * at.pressure;
    const double pull = is_free ? 0 : found.mu * load, across = is_free ? 0 : found.lateral * load;
    return {{found.mu, found.hysteresis, found.adhesion, found.contact_area, pull, found.dmu_dlnp, found.dmu_dlnv,
             inside_box, at.distance, found.lateral, across},
            true};
  }

  asperity::FrictionMap map_;
  std::string token_;
  State state_;
  std::vector<Found> found_;
};

}  // namespace asperity_fmu
#endif
