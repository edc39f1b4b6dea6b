// Scalars and options that functions take. What is of another kind is refused by the name of its argument, where
// pybind11 would answer with the list of its signatures.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "asperity/errors.hpp"

namespace asperity::python {

/// The name of an argument, as a template's argument.
template <std::size_t n>
struct Name {
  char text[n];
  consteval Name(const char (&from)[n]) { std::copy_n(from, n, text); }  // NOLINT: a literal is a name
};

/// An argument of C++ type T, with its name.
template <class T, Name argument>
struct Named {
  T value;
  operator const T&() const { return value; }  // NOLINT: stands for its value
};

/// One number, or (dy, dx).
using PixelSizeArgument = std::variant<double, std::array<double, 2>>;

template <Name argument>
using Number = Named<double, argument>;
template <Name argument>
using OptionalNumber = Named<std::optional<double>, argument>;
template <Name argument>
using Whole = Named<long long, argument>;
template <Name argument>
using Flag = Named<bool, argument>;
template <Name argument>
using Sentences = Named<std::vector<std::string>, argument>;
template <Name argument>
using Many = Named<py::iterable, argument>;

/// What is allowed of a type, in words.
template <class T>
constexpr const char* kind = nullptr;
template <>
inline constexpr const char* kind<double> = "a number";
template <>
inline constexpr const char* kind<std::optional<double>> = "a number or None";
template <>
inline constexpr const char* kind<long long> = "a whole number";
template <>
inline constexpr const char* kind<std::array<long long, 2>> = "two whole numbers";
template <>
inline constexpr const char* kind<bool> = "True or False";
template <>
inline constexpr const char* kind<std::string> = "a str";
template <>
inline constexpr const char* kind<std::vector<std::string>> = "a tuple of str";
template <>
inline constexpr const char* kind<std::optional<std::vector<std::string>>> = "a tuple of str or None";
template <>
inline constexpr const char* kind<py::iterable> = "an iterable";
template <>
inline constexpr const char* kind<PixelSizeArgument> = "a number or (dy, dx)";

/// An option given by name, as Python gave it: `choice` says what is allowed.
struct Option {
  py::object value;
};

/// A name in double quotes; anything else as Python shows it.
inline std::string quoted(const py::object& found) {
  if (!py::isinstance<py::str>(found)) return brief(found);
  return '"' + found[py::slice(0, 60, 1)].attr("encode")("utf-8", "backslashreplace").cast<std::string>() + '"';
}

template <class T>
using Choices = std::initializer_list<std::pair<const char*, T>>;

template <class T>
[[noreturn]] void refuse_option(const char* argument, const Option& found, Choices<T> allowed, const char* besides) {
  std::string names;
  for (const auto& [name, value] : allowed) names += (names.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  throw InvalidInput(std::string(argument) + " = " + quoted(found.value) + ": must be one of " + names + besides);
}

template <class T>
T choice(const char* argument, const Option& found, Choices<T> allowed, const char* besides = "") {
  if (py::isinstance<py::str>(found.value))
    for (const auto& [name, value] : allowed)
      if (found.value.equal(py::str(name))) return value;
  refuse_option(argument, found, allowed, besides);
}

/// None is no choice.
template <class T>
std::optional<T> choice_or_none(const char* argument, const Option& found, Choices<T> allowed) {
  if (found.value.is_none()) return std::nullopt;
  return choice(argument, found, allowed, ", None");
}

/// The name of an option.
template <class T>
const char* name_of(T found, Choices<T> allowed) {
  for (const auto& [name, value] : allowed)
    if (found == value) return name;
  return "";
}

}  // namespace asperity::python

namespace pybind11::detail {

template <class T, asperity::python::Name argument>
struct type_caster<asperity::python::Named<T, argument>> {
  using Found = asperity::python::Named<T, argument>;
  static constexpr auto name = make_caster<T>::name;
  template <class U>
  using cast_op_type = Found&&;

  bool load(handle from, bool) {
    make_caster<T> caster;
    constexpr bool flag = std::is_same_v<T, bool>;  // of which pybind11 takes whatever has a truth
    const bool known = !std::is_same_v<T, std::string> || PyUnicode_Check(from.ptr());  // not bytes
    if (!known || !caster.load(from, !flag || PyLong_Check(from.ptr())))
      throw asperity::InvalidInput(std::string(argument.text) + " = " + asperity::python::brief(from) + ": must be " +
                                   asperity::python::kind<T>);
    found_.emplace(Found{cast_op<T>(std::move(caster))});
    return true;
  }
  operator Found&&() { return std::move(*found_); }

 private:
  std::optional<Found> found_;
};

template <>
struct type_caster<asperity::python::Option> {
  PYBIND11_TYPE_CASTER(asperity::python::Option, const_name("str"));
  bool load(handle from, bool) {
    value.value = reinterpret_borrow<object>(from);
    return true;
  }
};

}  // namespace pybind11::detail
