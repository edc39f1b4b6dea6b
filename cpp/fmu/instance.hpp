// SPDX-License-Identifier: 0BSD
// What the functions of both standards share: an instance with the way its messages take, get and set of many
// variables, the state as bytes, the folder of resources from its address. Nothing that is thrown reaches the host.
#ifndef ASPERITY_FMU_INSTANCE_HPP
#define ASPERITY_FMU_INSTANCE_HPP

#include <charconv>
#include <cstring>
#include <functional>
#include <limits>

#include "model.hpp"

namespace asperity_fmu {

/// The categories of messages, as modelDescription.xml lists them.
constexpr const char *warnings = "logStatusWarning", *errors = "logStatusError";

/// Where an instance is in its life, one bit each.
enum Phase : unsigned { instantiated = 1, initializing = 2, stepping = 4, terminated = 8 };

/// A kind of call and the phases in which both standards allow it (FMI 2.0.4, Section 4.2.4; FMI 3.0, Sections 2.3 and
/// 4.2). Logging, reset, and states that are kept are allowed in all.
struct Call {
  const char* name;
  unsigned phases;
};
constexpr Call setting_up{"the setup of the experiment", instantiated},
    entering{"the beginning of the initialization", instantiated},
    exiting{"the end of the initialization", initializing},
    setting{"setting a variable", instantiated | initializing | stepping},
    reading{"reading a variable", initializing | stepping | terminated}, stepping_on{"a step", stepping},
    terminating{"the termination", stepping};

struct Instance {
  std::string name;
  std::unique_ptr<Model> model;
  std::function<void(Status, const char*)> tell;  // empty where the host does not listen
  Phase phase = instantiated;
  bool warned = false;
  bool tells_warnings = true, tells_errors = true;  // until the host switches them off
  double stop = std::numeric_limits<double>::infinity();

  Status error(const std::string& message) const {
    if (tell && tells_errors) tell(Status::error, message.c_str());
    return Status::error;
  }

  /// An error where the call is not allowed now.
  Status allow(const Call& call) const {
    if ((call.phases & phase) != 0) return Status::ok;
    const char* const now = phase == instantiated   ? "before the initialization"
                            : phase == initializing ? "during the initialization"
                            : phase == stepping     ? "after the initialization"
                                                    : "after the termination";
    return error(std::string(call.name) + " is not allowed " + now);
  }

  Status enter(const Call& call, Phase next) {
    const Status status = allow(call);
    if (status == Status::ok) phase = next;
    return status;
  }

  /// Switches categories of messages on or off, all of them where none is named.
  Status log(bool on, std::size_t n, const char* const names[]) {
    if (n == 0) tells_warnings = tells_errors = on;
    for (std::size_t i = 0; i < n; ++i) {
      const std::string category = names[i] == nullptr ? "" : names[i];
      if (category != warnings && category != errors)
        return error("log category \"" + category + "\" is unknown: must be " + warnings + " or " + errors);
      (category == warnings ? tells_warnings : tells_errors) = on;
    }
    return Status::ok;
  }

  /// The times between which the host will step.
  Status begin(double start, bool has_stop, double end) {
    if (!std::isfinite(start) || (has_stop && !(end >= start)))
      return error("a simulation from " + std::to_string(start) + " to " + std::to_string(end) +
                   " s: must begin at a finite time and end no earlier");
    model->set_time(start);
    stop = has_stop ? end : std::numeric_limits<double>::infinity();
    return Status::ok;
  }

  /// The host hears of it once, until all points are inside again.
  Status outside(Status found) {
    if (found == Status::ok) {
      warned = false;
    } else if (!warned) {
      warned = true;
      if (tell && tells_warnings)
        tell(Status::warning, model->state().settings.clamp != 0
                                  ? "a point lies outside of the map: mu is that of the map's nearest point"
                                  : "a point lies outside of the map: mu is NaN");
    }
    return found;
  }

  [[nodiscard]] Status get(std::uint32_t variable, std::size_t point, double& value) {
    if (variable == inside) return error("`inside` is an integer");
    const Status status = is_switch(variable) ? Status::error : model->get(variable, point, value);
    return status == Status::error ? error("value reference " + std::to_string(variable) + " is no number to be read")
                                   : status;
  }

  [[nodiscard]] Status get_integer(std::uint32_t variable, std::size_t point, int& value) {
    if (variable != inside) return error("`inside` is the only integer");
    double found = 0;
    const Status status = model->get(variable, point, found);
    value = static_cast<int>(found);
    return status;
  }

  [[nodiscard]] Status set(std::uint32_t variable, std::size_t point, double value) {
    return !is_switch(variable) && model->set(variable, point, value)
               ? Status::ok
               : error("value reference " + std::to_string(variable) + " is no input: it cannot be set");
  }

  template <class Boolean>
  [[nodiscard]] Status get_switch(std::uint32_t variable, std::size_t point, Boolean& on) {
    double number = 0;
    if (!is_switch(variable) || model->get(variable, point, number) == Status::error)
      return error("value reference " + std::to_string(variable) + " is no Boolean");
    on = number != 0;
    return Status::ok;
  }

  [[nodiscard]] Status set_switch(std::uint32_t variable, std::size_t point, bool on) {
    return is_switch(variable) && model->set(variable, point, on ? 1 : 0)
               ? Status::ok
               : error("value reference " + std::to_string(variable) + " is no Boolean that can be set");
  }

  /// Adds seed times d output / d input.
  [[nodiscard]] Status add_slope(std::uint32_t output, std::uint32_t input, std::size_t point, double seed,
                                 double& sum) const {
    if (!is_real_output(output) || !(input == pressure || input == velocity ||
                                     ((input == temperature || input == direction) && model->has(input))))
      return error("there is no derivative of value reference " + std::to_string(output) + " by " +
                   std::to_string(input) +
                   ": must be of a real output by pressure, velocity, temperature or direction");
    sum += seed * model->slope(output, input, point);
    return Status::ok;
  }

  Status reset() {
    model->start_anew();
    phase = instantiated;
    warned = false;
    stop = std::numeric_limits<double>::infinity();
    return Status::ok;
  }

  // States that the host keeps; it gives an old one back to be written over, or null.

  Status keep(void** kept) const {
    if (*kept == nullptr) *kept = new State;
    *static_cast<State*>(*kept) = model->state();
    return Status::ok;
  }

  Status restore(const void* kept) {
    if (kept == nullptr) return error("there is no state to go back to");
    const State& state = *static_cast<const State*>(kept);
    if (state.points.size() != model->points()) return error("the state is one of another number of points");
    model->restore(state);
    return Status::ok;
  }

  Status forget(void** kept) const {
    delete static_cast<State*>(*kept);
    *kept = nullptr;
    return Status::ok;
  }

  // As bytes, numbers of this machine, since a state is read by the program that wrote it.

  [[nodiscard]] std::size_t bytes() const { return sizeof(Settings) + model->points() * sizeof(Point); }

  Status size_of(const void* kept, std::size_t* size) const {
    if (kept == nullptr) return error("there is no state to be written");
    if (static_cast<const State*>(kept)->points.size() != model->points())
      return error("the state is one of another number of points");
    *size = bytes();
    return Status::ok;
  }

  Status write(const void* kept, void* to, std::size_t size) const {
    std::size_t needed = 0;
    if (size_of(kept, &needed) != Status::ok) return Status::error;
    if (size < needed) return error("a state needs " + std::to_string(needed) + " bytes");
    const State& state = *static_cast<const State*>(kept);
    std::memcpy(to, &state.settings, sizeof(Settings));
    std::memcpy(static_cast<char*>(to) + sizeof(Settings), state.points.data(), needed - sizeof(Settings));
    return Status::ok;
  }

  Status read(const void* from, std::size_t size, void** kept) const {
    if (size != bytes()) return error("the bytes are not those of a state of this FMU");
    State state = model->state();
    std::memcpy(&state.settings, from, sizeof(Settings));
    std::memcpy(state.points.data(), static_cast<const char*>(from) + sizeof(Settings), size - sizeof(Settings));
    if (*kept == nullptr) *kept = new State;
    *static_cast<State*>(*kept) = std::move(state);
    return Status::ok;
  }

  [[nodiscard]] Status step(double from, double size) {
    if (!std::isfinite(from) || !std::isfinite(size) || size < 0)
      return error("a step from " + std::to_string(from) + " by " + std::to_string(size) +
                   " s: the time must be finite and the step not negative");
    // the host's sum of steps may be off by rounding
    if (from + size > stop + 1e-3 * size + 1e-12 * std::fabs(stop))
      return error("a step from " + std::to_string(from) + " by " + std::to_string(size) +
                   " s ends after the stop time, " + std::to_string(stop) + " s");
    return outside(model->step(from, size));
  }
};

/// The worse of two.
inline Status worse(Status a, Status b) { return a < b ? b : a; }

/// Runs `function`; what it throws, for want of memory, is an error.
template <class Function>
Status guarded(void* instance, Function function) {
  if (instance == nullptr) return Status::error;
  try {
    return function(*static_cast<Instance*>(instance));
  } catch (...) {
    return Status::error;
  }
}

/// Calls a member.
template <class Act, class... Arguments>
Status call(void* instance, Act act, Arguments... arguments) {
  return guarded(instance, [&](Instance& of) { return (of.*act)(arguments...); });
}

/// The same for a call that is not allowed at all times.
template <class Function>
Status guarded(void* instance, const Call& call, Function function) {
  return guarded(instance, [&](Instance& of) {
    const Status status = of.allow(call);
    return status == Status::ok ? function(of) : status;
  });
}

/// An error where the host asks for variables of a type that there is none of.
inline Status no_variable_of(void* instance, std::size_t n, const char* type) {
  return guarded(instance, [&](Instance& of) {
    return n == 0 ? Status::ok : of.error(std::string("there is no variable of type ") + type);
  });
}

/// The path of a file URI (RFC 8089), or an empty one where it is none.
inline std::filesystem::path path_of_uri(const std::string& uri) {
  if (uri.compare(0, 5, "file:") != 0) return {};
  std::string path;
  for (std::size_t i = 5; i < uri.size(); ++i) {
    const char* const digits = uri.c_str() + i + 1;
    unsigned char code = 0;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      path += static_cast<char>(code);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  if (path.compare(0, 2, "//") == 0) path.erase(0, path.find('/', 2));  // the host, this one
#ifdef _WIN32
  if (path.size() > 2 && path[0] == '/' && path[2] == ':') path.erase(0, 1);  // /C:/...
#endif
  return std::filesystem::u8path(path);
}

/// An instance with its map, or null: the host hears why. `token` is that of the description which the host has read,
/// called `token_name` in its standard: of another FMU than the one in `resources`, references mean something else.
inline Instance* make_instance(const char* name, const char* token, const std::string& token_name,
                               const std::filesystem::path& resources, std::function<void(Status, const char*)> tell) {
  auto made = std::make_unique<Instance>();
  made->name = name == nullptr ? "" : name;
  made->tell = std::move(tell);
  std::string why;
  made->model = Model::load(resources, why);
  if (made->model) {
    const std::string &own = made->model->token(), given = token == nullptr ? "" : token;
    if (given == own) return made.release();
    why = "the " + token_name + " \"" + given + "\" is that of another FMU: must be \"" + own + "\"";
  }
  (void)made->error(why);
  return nullptr;
}

}  // namespace asperity_fmu
#endif
