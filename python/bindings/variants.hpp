// Arguments that are of no class of the module's own: one of several classes, or a tuple.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <tuple>
#include <variant>

#include "arrays.hpp"
#include "asperity/contact.hpp"
#include "asperity/dma.hpp"
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

/// How the contact is computed: from the tuple (poisson_ratio, correction or None, form, rtol, method, strain factors
/// or None, direction), which is made faster than an object of a class.
struct ModelOfTuple {
  static constexpr auto name = pybind11::detail::const_name("tuple");
  template <class>
  using cast_op_type = const ContactModel&;

  bool load(pybind11::handle from, bool) {
    auto [poisson_ratio, correction, form, rtol, method, strain_factors, direction] = from.cast<
        std::tuple<double, std::optional<Correction>, Form, double, Method, std::optional<StrainFactors>, double>>();
    model_ = {poisson_ratio, correction ? *std::move(correction) : NoCorrection{},
              form,          rtol,
              method,        std::move(strain_factors),
              direction};
    return true;
  }
  operator const ContactModel&() const { return model_; }  // NOLINT: pybind11 asks for a conversion

 private:
  ContactModel model_;
};

}  // namespace asperity::python

namespace pybind11::detail {
template <>
struct type_caster<asperity::Spectrum> : asperity::python::OneOf<asperity::Spectrum> {};
template <>
struct type_caster<asperity::Rubber> : asperity::python::OneOf<asperity::Rubber> {};
template <>
struct type_caster<asperity::TemperatureShift> : asperity::python::OneOf<asperity::TemperatureShift> {};
template <>
struct type_caster<asperity::ContactModel> : asperity::python::ModelOfTuple {};
}  // namespace pybind11::detail
