// Array traffic between NumPy and the core: array-likes in, arrays of their broadcast shape out.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/errors.hpp"

namespace asperity::python {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

/// What was found, in one short line.
inline std::string brief(const py::handle& found) {
  auto text = py::repr(found)[py::slice(0, 60, 1)].cast<std::string>();  // characters, which are never cut apart
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Any real array-like as float64, or InvalidInput in the name of the argument.
inline Array real_array(const py::handle& values, const std::string& name) {
  if (PyFloat_Check(values.ptr())) {  // the common scalar, without asking NumPy
    Array scalar(Shape{});
    *scalar.mutable_data() = PyFloat_AS_DOUBLE(values.ptr());
    return scalar;
  }
  const py::array any = py::array::ensure(values);
  if (!any || std::string("biuf").find(any.dtype().kind()) == std::string::npos) {
    PyErr_Clear();
    throw InvalidInput(name + " = " + brief(values) + ": must be a number or an array of real numbers");
  }
  return Array::ensure(any);
}

/// A one-dimensional array-like as a vector.
inline std::vector<double> vector_of(const py::handle& values, const std::string& name) {
  const Array array = real_array(values, name);
  if (array.ndim() != 1) throw InvalidInput(name + " has " + std::to_string(array.ndim()) + " dimensions: must have 1");
  return {array.data(), array.data() + array.size()};
}

/// Arguments that have one shape together, as NumPy brings them to it.
struct Views {
  Shape shape;
  std::vector<Array> arrays;  // one an argument: of that shape, or of one entry that holds everywhere

  std::span<const double> view(std::size_t i) const {
    return {arrays[i].data(), static_cast<std::size_t>(arrays[i].size())};
  }
};

/// An array in a shape that it fits into.
inline Array expanded(const Array& a, const Shape& shape) {
  Array result(shape);
  const std::size_t rank = shape.size();
  std::vector<py::ssize_t> index(rank, 0);
  double* const to = result.mutable_data();
  for (py::ssize_t i = 0; i < result.size(); ++i) {
    py::ssize_t offset = 0;
    for (py::ssize_t k = 0; k < a.ndim(); ++k) {
      const py::ssize_t j = a.shape(k) == 1 ? 0 : index[rank - static_cast<std::size_t>(a.ndim() - k)];
      offset = offset * a.shape(k) + j;
    }
    to[i] = a.data()[offset];
    for (std::size_t k = rank; k-- > 0;) {
      if (++index[k] < shape[k]) break;
      index[k] = 0;
    }
  }
  return result;
}

inline Views views(std::initializer_list<std::pair<const char*, py::handle>> arguments) {
  Views result;
  for (const auto& [name, values] : arguments) result.arrays.push_back(real_array(values, name));
  std::size_t rank = 0;
  for (const Array& a : result.arrays) rank = std::max(rank, static_cast<std::size_t>(a.ndim()));
  result.shape.assign(rank, 1);
  bool fits = true;
  for (const Array& a : result.arrays)
    for (py::ssize_t i = 0; i < a.ndim(); ++i) {
      py::ssize_t& side = result.shape[rank - static_cast<std::size_t>(a.ndim() - i)];
      if (a.shape(i) != 1 && side != 1 && side != a.shape(i)) fits = false;
      if (a.shape(i) != 1) side = a.shape(i);
    }
  if (!fits) {
    std::string shapes;
    std::size_t at = 0;
    for (const auto& [name, values] : arguments)
      shapes.append(shapes.empty() ? "" : ", ")
          .append(name)
          .append(" ")
          .append(py::str(result.arrays[at++].attr("shape")).cast<std::string>());
    throw InvalidInput("shapes " + shapes + ": must broadcast together");
  }
  py::ssize_t size = 1;
  for (const py::ssize_t side : result.shape) size *= side;
  for (Array& a : result.arrays)
    if (a.size() != 1 && a.size() != size) a = expanded(a, result.shape);
  return result;
}

/// The same with every argument in full.
struct Broadcast {
  Shape shape;
  std::vector<std::vector<double>> columns;  // one an argument, flattened
};

inline Broadcast broadcast(std::initializer_list<std::pair<const char*, py::handle>> arguments) {
  const Views views_of = views(arguments);
  Broadcast result{views_of.shape, {}};
  std::size_t size = 1;
  for (const py::ssize_t side : result.shape) size *= static_cast<std::size_t>(side);
  for (std::size_t i = 0; i < views_of.arrays.size(); ++i) {
    const std::span<const double> view = views_of.view(i);
    if (view.size() == size) {
      result.columns.emplace_back(view.begin(), view.end());
    } else {
      result.columns.emplace_back(size, view[0]);
    }
  }
  return result;
}

/// The vector as an array that owns it, or a float where the shape is that of a scalar.
template <class T>
py::object shaped(std::vector<T> values, const Shape& shape) {
  if (shape.empty()) return py::cast(values.front());
  auto* const owned = new std::vector<T>(std::move(values));
  const py::capsule keeper(owned, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(shape, owned->data(), keeper);
}

/// What an attribute gives: arrays that cannot be written to.
inline py::object frozen(py::object value) {
  if (py::isinstance<py::array>(value)) value.attr("setflags")(py::arg("write") = false);
  return value;
}

/// The vector as a one-dimensional array that owns it, for an attribute.
inline py::object flat(std::vector<double> values) {
  const Shape shape{static_cast<py::ssize_t>(values.size())};
  return frozen(shaped(std::move(values), shape));
}

/// A property or a method without arguments, computed with the GIL released.
template <class S, class F>
auto released(F f) {
  return [f](const S& self) {
    const py::gil_scoped_release release;
    return f(self);
  };
}

/// f of all entries, in the shape of the argument; computed with the GIL released.
template <class F>
py::object over_array(const py::handle& values, const std::string& name, F f) {
  const Array array = real_array(values, name);
  auto result = [&] {
    const std::span<const double> entries(array.data(), static_cast<std::size_t>(array.size()));
    const py::gil_scoped_release release;
    return f(entries);
  }();
  return shaped(std::move(result), Shape(array.shape(), array.shape() + array.ndim()));
}

/// f of each entry, likewise.
template <class F>
py::object map_array(const py::handle& values, const std::string& name, F f) {
  return over_array(values, name, [&](std::span<const double> entries) {
    std::vector<decltype(f(0.0))> result(entries.size());
    std::ranges::transform(entries, result.begin(), f);
    return result;
  });
}

}  // namespace asperity::python
