// Value semantics for bound classes from one list of field names: repr, ==, pickle, pattern matching.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "asperity/errors.hpp"

namespace asperity::python {

namespace py = pybind11;

/// `fields` are the constructor's keywords, each also a read-only attribute.
inline void value_semantics(py::handle cls, std::vector<std::string> fields) {
  const auto method = [&](const char* name, auto f) {
    py::setattr(cls, name, py::cpp_function(f, py::name(name), py::is_method(cls)));
  };
  py::tuple names(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) names[i] = fields[i];
  py::setattr(cls, "__match_args__", names);
  method("__repr__", [fields](const py::object& self) {
    std::string text = py::type::of(self).attr("__name__").cast<std::string>() + "(";
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += (i ? ", " : "") + fields[i] + "=" + py::repr(self.attr(fields[i].c_str())).cast<std::string>();
    return text + ")";
  });
  method("__eq__", [fields](const py::object& self, const py::object& other) -> py::object {
    if (!py::type::of(other).is(py::type::of(self))) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    const py::object same = py::module_::import("numpy").attr("array_equal");
    for (const auto& field : fields) {
      const py::object a = self.attr(field.c_str()), b = other.attr(field.c_str());
      if (py::isinstance<py::array>(a) != py::isinstance<py::array>(b)) return py::bool_(false);
      if (py::isinstance<py::array>(a) != py::isinstance<py::array>(b)) return py::bool_(false);
      const bool numeric = py::isinstance<py::array>(a) && a.attr("dtype").attr("kind").cast<std::string>() != "U";
      const bool equal =
          py::isinstance<py::array>(a) ? same(a, b, py::arg("equal_nan") = numeric).cast<bool>() : a.equal(b);
      if (!equal) return py::bool_(false);
    }
    return py::bool_(true);
  });
  py::setattr(cls, "__hash__", py::none());
  method("__reduce__", [fields](const py::object& self) {
    py::dict values;
    for (const auto& field : fields) values[field.c_str()] = self.attr(field.c_str());
    return py::make_tuple(py::module_::import("asperity._core").attr("_rebuild"),
                          py::make_tuple(py::type::of(self), values));
  });
}

/// A result: named values that the core computed. `Tag::names` lists the fields.
template <class Tag>
struct Record {
  py::dict values;
};

template <class Tag>
py::classh<Record<Tag>> bind_record(py::module_& m, const char* name, const char* doc) {
  py::classh<Record<Tag>> cls(m, name, doc);
  cls.def(py::init([](const py::kwargs& given) {  // for pickle
    Record<Tag> record;
    for (const char* field : Tag::names) {
      if (!given.contains(field)) throw InvalidInput(std::string(field) + ": is missing");
      record.values[field] = given[field];
    }
    if (given.size() != record.values.size())
      throw InvalidInput("unknown field in " + py::repr(given).cast<std::string>());
    return record;
  }));
  for (const char* field : Tag::names)
    cls.def_property_readonly(field, [field](const Record<Tag>& r) { return frozen(r.values[field]); });
  value_semantics(cls, {std::begin(Tag::names), std::end(Tag::names)});
  return cls;
}

}  // namespace asperity::python
