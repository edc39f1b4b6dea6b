// The two objects that most functions take, from Python's to the core's.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "asperity/errors.hpp"
#include "asperity/rubber.hpp"
#include "asperity/spectrum.hpp"

namespace asperity::python {

inline std::string brief(const pybind11::handle& found) {
  return pybind11::repr(found).cast<std::string>().substr(0, 60);
}

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

}  // namespace asperity::python
