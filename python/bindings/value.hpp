// Value semantics for bound classes from one list of field names: repr, ==, pickle, pattern matching.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "asperity/errors.hpp"

namespace asperity::python {

namespace py = pybind11;

/// cls.__new__ raises.
void made_by_call_alone(py::handle cls);

/// `fields` are the constructor's keywords, each also a read-only attribute.
inline void value_semantics(py::handle cls, std::vector<std::string> fields) {
  const auto method = [&](const char* name, auto f) {
    py::setattr(cls, name, py::cpp_function(f, py::name(name), py::is_method(cls)));
  };
  py::tuple names(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) names[i] = fields[i];
  py::setattr(cls, "__match_args__", names);
  made_by_call_alone(cls);
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

/// Of three parameters, row by row.
inline std::array<double, 9> covariance_of(const py::object& found) {
  const Array given = real_array(found, "covariance");
  if (given.ndim() != 2 || given.shape(0) != 3 || given.shape(1) != 3)
    throw InvalidInput("covariance has shape " + py::str(given.attr("shape")).cast<std::string>() + ": must be (3, 3)");
  std::array<double, 9> result{};
  std::copy_n(given.data(), 9, result.begin());
  for (std::size_t i = 0; i < 9; ++i)
    if (!std::isfinite(result[i]) || (i % 4 == 0 && result[i] < 0))
      throw InvalidInput("covariance = " + brief(found) + ": must be finite, its diagonal not negative");
  return result;
}

/// The object that __reduce__ took apart. What is no such state is refused in a line.
inline py::object rebuilt(const py::object& cls, const py::object& fields) {
  if (!py::isinstance<py::type>(cls) || !py::hasattr(cls, "__match_args__"))
    throw InvalidInput("pickle: its class = " + brief(cls) + ": must be a class of asperity");
  const auto name = cls.attr("__name__").cast<std::string>();
  if (!py::isinstance<py::dict>(fields))
    throw InvalidInput("pickle: the state of a " + name + " = " + brief(fields) + ": must be a dict");
  const auto state = py::reinterpret_borrow<py::dict>(fields);
  const auto names = cls.attr("__match_args__").cast<py::tuple>();
  bool complete = state.size() == names.size();
  for (const py::handle field : names) complete = complete && state.contains(field);
  if (!complete)
    throw InvalidInput("pickle: the state of a " + name + " = " + brief(fields) + ": must have the fields " +
                       py::str(", ").attr("join")(names).cast<std::string>());
  return cls(**state);
}

/// What a field of a result holds.
enum class Holds { number, numbers, numbers_or_none, whole_numbers, names_or_none, sentences, errors };
struct Field {
  const char* name;
  Holds holds;
};

/// The value as a result keeps it, its own copy where it is an array; or InvalidInput in the name of the field.
inline py::object kept_value(const Field& field, const py::object& found) {
  const auto refuse = [&](const char* allowed) {
    throw InvalidInput(std::string(field.name) + " = " + brief(found) + ": must be " + allowed);
  };
  const auto array_of = [&](const char* kinds) {
    const bool known = py::isinstance<py::array>(found) &&
                       std::string(kinds).find(py::array(found).dtype().kind()) != std::string::npos;
    return known ? py::object(found.attr("copy")()) : py::object();
  };
  switch (field.holds) {
    case Holds::number:
      if (!py::isinstance<py::float_>(found)) refuse("a float");
      break;
    case Holds::numbers_or_none:
      if (found.is_none()) return found;
      [[fallthrough]];
    case Holds::numbers: {
      const Array array = real_array(found, field.name);
      return array.ndim() == 0 ? py::object(py::float_(*array.data())) : py::object(array.attr("copy")());
    }
    case Holds::whole_numbers:
      if (py::object array = array_of("iu")) return array.attr("astype")("i8");
      refuse("an array of whole numbers");
      break;
    case Holds::names_or_none:
      if (found.is_none() || py::isinstance<py::str>(found)) return found;
      if (py::object array = array_of("U")) return array;
      refuse("a name, an array of names or None");
      break;
    case Holds::sentences:
      if (!py::isinstance<py::tuple>(found)) refuse("a tuple of str");
      for (const py::handle one : py::reinterpret_borrow<py::tuple>(found))
        if (!py::isinstance<py::str>(one)) refuse("a tuple of str");
      break;
    case Holds::errors:
      if (!py::isinstance<py::dict>(found)) refuse("a dict of numbers");
      for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(found))
        if (!py::isinstance<py::str>(key) || !py::isinstance<py::float_>(value)) refuse("a dict of numbers");
      break;
  }
  return found;
}

/// A result: named values that the core computed. `Tag::fields` lists them.
template <class Tag>
struct Record {
  py::dict values;
};

template <class Tag>
py::classh<Record<Tag>> bind_record(py::module_& m, const char* name, const char* doc) {
  py::classh<Record<Tag>> cls(m, name, doc);
  cls.def(py::init([](const py::kwargs& given) {  // for pickle
    Record<Tag> record;
    for (const Field& field : Tag::fields) {
      if (!given.contains(field.name)) throw InvalidInput(std::string(field.name) + ": is missing");
      record.values[field.name] = kept_value(field, given[field.name]);
    }
    if (given.size() != record.values.size()) throw InvalidInput("unknown field in " + brief(given));
    return record;
  }));
  std::vector<std::string> names;
  for (const Field& field : Tag::fields) {
    names.emplace_back(field.name);
    cls.def_property_readonly(field.name, [field](const Record<Tag>& r) {
      const py::object value = r.values[field.name];
      return py::isinstance<py::dict>(value) ? value.attr("copy")() : frozen(value);
    });
  }
  value_semantics(cls, std::move(names));
  return cls;
}

}  // namespace asperity::python
