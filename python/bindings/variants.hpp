// Arguments that may be one of several classes of the core, none of which need be default constructible.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <variant>

#include "asperity/rubber.hpp"
#include "asperity/spectrum.hpp"

namespace asperity::python {

template <class Variant>
struct OneOf;

template <class... Classes>
struct OneOf<std::variant<Classes...>> {
  using Variant = std::variant<Classes...>;
  static constexpr auto name = pybind11::detail::const_name("object");
  template <class>
  using cast_op_type = const Variant&;

  bool load(pybind11::handle from, bool) { return (take<Classes>(from) || ...); }
  operator const Variant&() const { return *found_; }  // NOLINT: pybind11 asks for a conversion

 private:
  template <class T>
  bool take(pybind11::handle from) {
    if (!pybind11::isinstance<T>(from)) return false;
    found_.emplace(from.cast<const T&>());
    return true;
  }
  std::optional<Variant> found_;
};

}  // namespace asperity::python

namespace pybind11::detail {
template <>
struct type_caster<asperity::Spectrum> : asperity::python::OneOf<asperity::Spectrum> {};
template <>
struct type_caster<asperity::Rubber> : asperity::python::OneOf<asperity::Rubber> {};
}  // namespace pybind11::detail
