// Spectra given row by row, of a surface or of its profiles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "asperity/spectrum.hpp"
#include "scalars.hpp"
#include "value.hpp"

namespace asperity::python {

template <class S>
S make_rows(const py::object& q, const py::object& c, const py::object& count, const py::object& error,
            const py::object& flag) {
  const auto optional = [](const py::object& values, const char* name) {
    return values.is_none() ? std::vector<double>{} : vector_of(values, name);
  };
  RowQuality quality{optional(count, "count"), optional(error, "standard_error"), {}};
  std::size_t i = 0;
  for (const double bits : optional(flag, "flag")) {
    if (!(bits >= 0 && bits <= 7) || bits != static_cast<std::uint8_t>(bits))
      throw InvalidInput("flag[" + std::to_string(i) + "] = " + py::repr(py::cast(bits)).cast<std::string>() +
                         ": must be a whole number from 0 to 7");
    quality.flag.push_back(static_cast<std::uint8_t>(bits));
    ++i;
  }
  return S(vector_of(q, "wavenumber"), vector_of(c, "density"), std::move(quality));
}

/// A column as an array, or None where the spectrum does not have it.
template <class T>
py::object column(const std::vector<T>& values) {
  if (values.empty()) return py::none();
  return frozen(shaped(std::vector<T>(values), {static_cast<py::ssize_t>(values.size())}));
}

/// The columns, and what is done with them. `density` says what it is and in which unit.
template <class S>
void bind_rows(py::classh<S>& cls, const std::string& density) {
  const std::string text = density + ", shape (n,).";
  cls.def_property_readonly(
         "wavenumber", [](const S& s) { return flat(s.wavenumber()); }, "q [1/m], shape (n,).")
      .def_property_readonly(
          "density", [](const S& s) { return flat(s.density()); }, text.c_str())
      .def_property_readonly(
          "count", [](const S& s) { return column(s.quality().count); }, "Modes in each row, shape (n,), or None.")
      .def_property_readonly(
          "standard_error", [](const S& s) { return column(s.quality().standard_error); },
          "Of the density, in its unit, shape (n,), or None.")
      .def_property_readonly(
          "flag", [](const S& s) { return column(s.quality().flag); },
          "Why a row is not to be trusted, uint8, shape (n,), or None: 1 few periods under the window, 2 near Nyquist, "
          "4 few modes, or their sum.")
      .def_property_readonly(
          "reliable",
          [](const S& s) {
            const auto& flag = s.quality().flag;
            py::array_t<bool> result(static_cast<py::ssize_t>(s.wavenumber().size()));
            for (std::size_t i = 0; i < s.wavenumber().size(); ++i)
              result.mutable_data()[i] = flag.empty() || flag[i] == 0;
            return frozen(result);
          },
          "Where no flag stands, bool, shape (n,).")
      .def(
          "log_binned", [](const S& s, Number<"per_decade"> per_decade) { return log_binned(s, per_decade); },
          py::kw_only(), py::arg("per_decade") = 10.0, py::call_guard<py::gil_scoped_release>(),
          "Count-weighted means over bins of equal width in ln q, from the lowest row on; a new spectrum. Each row is "
          "brought to the bin's mean wavenumber along the local power law. Flagged rows are left out of bins that have "
          "others. Under a Hann window neighbouring rows are alike: the errors of bins are then a quarter too small.");
  value_semantics(cls, {"wavenumber", "density", "count", "standard_error", "flag"});
}

}  // namespace asperity::python
