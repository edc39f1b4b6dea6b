// Arrays between NumPy and the core: contiguous float64 in, arrays that own their numbers out.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "asperity/errors.hpp"
#include "asperity/watch.hpp"

namespace asperity::python {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline std::span<const double> span_of(const Array& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

inline std::vector<double> vector_of(const Array& array) { return {array.data(), array.data() + array.size()}; }

/// A vector as an array of `shape` (by default its own), without a copy.
template <class T>
py::array array_of(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
  auto* const owned = new std::vector<T>(std::move(values));
  const py::capsule keeper(owned, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  if (shape.empty()) shape.push_back(static_cast<py::ssize_t>(owned->size()));
  return py::array_t<T>(std::move(shape), owned->data(), keeper);
}

/// Throws what a signal's handler raises, KeyboardInterrupt for Ctrl-C.
inline void heed_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// The GIL released while the core computes, and signals heeded. A guard of bound functions.
class Released {
  py::gil_scoped_release release_;
  Watch watch_{&heed_signals};
};

/// f() with the GIL released.
template <class F>
auto released(F f) {
  const Released guard;
  return f();
}

/// The vector that f() returns as an array; f runs with the GIL released.
template <class F>
py::array computed(F f) {
  return array_of(released(f));
}

/// Notes as those of the package, and back.
py::tuple tuple_of(const std::vector<Diagnostic>& notes);
std::vector<Diagnostic> notes_of(const py::iterable& notes);

}  // namespace asperity::python

namespace pybind11::detail {
/// An enumerator of the core from its number.
template <class Enum>
struct type_caster_enum_type_enabled<Enum, std::enable_if_t<std::is_enum_v<Enum>>> : std::false_type {};
template <class Enum>
struct type_caster<Enum, std::enable_if_t<std::is_enum_v<Enum>>> {
  static constexpr auto name = const_name("int");
  template <class>
  using cast_op_type = Enum;

  bool load(handle from, bool) {
    value_ = static_cast<Enum>(from.cast<int>());
    return true;
  }
  operator Enum() const { return value_; }  // NOLINT: pybind11 asks for a conversion

 private:
  Enum value_{};
};
}  // namespace pybind11::detail
