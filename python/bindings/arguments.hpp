// Objects that functions take, from Python's to the core's, each refused by the name of its argument.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "arrays.hpp"
#include "asperity/errors.hpp"
#include "asperity/rubber.hpp"
#include "asperity/spectrum.hpp"

namespace asperity::python {

inline Spectrum spectrum_of(const pybind11::object& found) {
  if (pybind11::isinstance<SelfAffineSpectrum>(found)) return found.cast<const SelfAffineSpectrum&>();
  if (pybind11::isinstance<TabulatedSpectrum>(found)) return found.cast<const TabulatedSpectrum&>();
  throw InvalidInput("spectrum = " + brief(found) + ": must be a SelfAffineSpectrum or a TabulatedSpectrum");
}

inline Rubber rubber_of(const pybind11::object& found) {
  if (pybind11::isinstance<PronySeries>(found)) return found.cast<const PronySeries&>();
  if (pybind11::isinstance<MasterCurve>(found)) return found.cast<const MasterCurve&>();
  throw InvalidInput("rubber = " + brief(found) + ": must be a PronySeries or a MasterCurve");
}

/// An argument of one class.
template <class T>
const T& object_of(const pybind11::object& found, const char* argument, const char* allowed) {
  if (pybind11::isinstance<T>(found)) return found.cast<const T&>();
  throw InvalidInput(std::string(argument) + " = " + brief(found) + ": must be " + allowed);
}

}  // namespace asperity::python
