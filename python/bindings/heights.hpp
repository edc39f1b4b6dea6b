// Heights between NumPy and the core: shared in both directions, never copied where their layout allows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "asperity/surface.hpp"

namespace asperity::python {

/// An array's numbers, strides in elements, and what keeps them alive.
struct HeightArray {
  HeightMap::Data data;
  std::vector<std::ptrdiff_t> strides;
  std::vector<std::size_t> shape;
  std::shared_ptr<const void> owner;
};

/// Keeps a NumPy array alive from inside the core; letting go of it takes the GIL.
inline std::shared_ptr<const void> keep_alive(py::array array) {
  return {new py::array(std::move(array)), [](const void* p) {
            const py::gil_scoped_acquire gil;
            delete static_cast<const py::array*>(p);
          }};
}

/// float32 stays what it is, in whatever byte order it came; other real types become float64.
inline py::dtype float_type(const py::dtype& found) {
  return py::dtype(found.kind() == 'f' && found.itemsize() == 4 ? "f4" : "f8");
}

/// The numbers of an array-like of `rank` dimensions, which are called `axes` in the message.
inline HeightArray height_array(const py::object& heights, py::ssize_t rank, const char* axes) {
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
  if (array.ndim() != rank)
    throw InvalidInput("heights has " + std::to_string(array.ndim()) + " dimensions: must have " +
                       std::to_string(rank) + ", " + axes);
  const py::ssize_t item = array.itemsize();
  bool packed = false;  // fields of packed records
  for (py::ssize_t i = 0; i < rank; ++i) packed = packed || array.strides(i) % item != 0;
  if (packed || !array.attr("flags").attr("aligned").cast<bool>()) array = array.attr("copy")();
  HeightArray result{item == 4 ? HeightMap::Data(static_cast<const float*>(array.data()))
                               : HeightMap::Data(static_cast<const double*>(array.data())),
                     {},
                     {},
                     keep_alive(array)};
  for (py::ssize_t i = 0; i < rank; ++i) {
    result.strides.push_back(array.strides(i) / item);
    result.shape.push_back(static_cast<std::size_t>(array.shape(i)));
  }
  return result;
}

/// A read-only view of numbers that `self` holds.
inline py::array view_of(const HeightMap::Data& data, const std::vector<std::size_t>& shape,
                         const std::vector<std::ptrdiff_t>& strides, const py::object& self) {
  return std::visit(
      [&](const auto* first) {
        using T = std::remove_cvref_t<decltype(*first)>;
        std::vector<py::ssize_t> bytes;
        for (const std::ptrdiff_t stride : strides) bytes.push_back(stride * static_cast<py::ssize_t>(sizeof(T)));
        py::array_t<T> view(Shape(shape.begin(), shape.end()), bytes, first, self);
        view.attr("setflags")(py::arg("write") = false);
        return py::array(view);
      },
      data);
}

}  // namespace asperity::python
