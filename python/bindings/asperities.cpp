#include "asperity/asperities.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "correction.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct SeparationTag {
  static constexpr Field fields[] = {
      {"effective", Holds::numbers}, {"rigid", Holds::numbers}, {"state", Holds::names_or_none}};
};

const char* name(ContactState state) {
  switch (state) {
    case ContactState::no_contact:
      return "no contact";
    case ContactState::full:
      return "full";
    default:
      return "partial";
  }
}

Record<SeparationTag> separations(const py::object& pressure, const py::object& modulus,
                                  Number<"rms_height"> rms_height, Number<"q0"> q0, const py::object& peaks,
                                  const Option& reading, OptionalNumber<"z_max"> highest,
                                  OptionalNumber<"z_min"> lowest) {
  const std::optional<double> z_max = highest, z_min = lowest;
  if (z_max.has_value() != z_min.has_value())
    throw InvalidInput(std::string(z_max ? "z_min" : "z_max") + ": must be given with the other of z_max, z_min");
  const Broadcast b = broadcast({{"pressure", pressure}, {"effective_modulus", modulus}});
  const auto heights = peaks.is_none() ? std::vector<double>{} : vector_of(peaks, "peaks");
  if (!peaks.is_none() && heights.empty()) throw InvalidInput("peaks has 0 entries: must be 3 or more");
  const Reading how = reading_of(reading);
  const std::size_t n = b.columns[0].size();
  std::vector<double> effective(n), rigid(n);
  std::vector<ContactState> states;
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i < n; ++i) {
      const Separation d = separation({rms_height, q0, heights}, b.columns[0][i], b.columns[1][i], how);
      effective[i] = d.effective;
      rigid[i] = d.rigid;
      if (z_max) states.push_back(contact_state(d.effective, *z_max, *z_min));
    }
  }
  Record<SeparationTag> record;
  record.values["effective"] = shaped(std::move(effective), b.shape);
  record.values["rigid"] = shaped(std::move(rigid), b.shape);
  record.values["state"] = py::none();
  if (z_max && b.shape.empty()) record.values["state"] = name(states.front());
  if (z_max && !b.shape.empty()) {
    py::list names;
    for (const ContactState s : states) names.append(name(s));
    record.values["state"] =
        py::module_::import("numpy").attr("array")(names, py::arg("dtype") = "U10").attr("reshape")(py::cast(b.shape));
  }
  return record;
}

}  // namespace

void bind_asperities(py::module_& m) {
  m.def(
      "hertz_penetration",
      [](Number<"force"> force, Number<"effective_modulus"> modulus, Number<"radius"> radius) {
        return hertz_penetration(force, modulus, radius);
      },
      py::kw_only(), py::arg("force"), py::arg("effective_modulus"), py::arg("radius"),
      "delta = (9 F^2 / (16 E*^2 R))^(1/3) [m] of a sphere of `radius` [m] under `force` [N], `effective_modulus` "
      "[Pa]: Hertz, Eq. 14 with the square of F that it lost in print. InvalidInput where the force is negative or one "
      "of the others not positive.");

  bind_record<SeparationTag>(m, "Separation", R"(What `separation` returns; scalars for scalar arguments.

effective : d~ [m], the effective separation above the mean plane.
rigid : d [m].
state : "no contact" (d~ >= z_max), "partial" or "full" (d~ <= z_min); None where z_max, z_min were not given.
)");
  m.def("separation", &separations, py::kw_only(), py::arg("pressure"), py::arg("effective_modulus"),
        py::arg("rms_height"), py::arg("q0"), py::arg("peaks") = py::none(), py::arg("reading") = "implicit",
        py::arg("z_max") = py::none(), py::arg("z_min") = py::none(),
        R"(Separation of the mean planes in the (improved) Greenwood-Williamson model (Eqs 16-20).

sigma0 = (4/3) E* sqrt(R) n_a <(z - d)^1.5> over macro-asperities of n_a = q0^2 / (2 pi^2 sqrt 3) a unit area and
radius R = 1 / (q0^2 sqrt 2 h_rms).

Parameters
----------
pressure, effective_modulus : array_like
    sigma0 and E* [Pa]; they broadcast.
rms_height, q0 : float
    h_rms [m] and wavenumber [1/m] of the macro-asperities.
peaks : array_like, shape (n,), optional
    Their heights [m] above the mean plane instead of a Gaussian, n >= 3.
reading : {"implicit", "added"}
    Of Eqs 19-20. "implicit": Eq. 20 is solved for d~, so the interaction cancels, and d = d~ - sigma0 sqrt(A_a) / E*.
    "added": d is the plain Greenwood-Williamson separation, d~ = d + sigma0 sqrt(A_a) / E*; it turns upward again at
    high load on soft rubber and is unphysical there. sqrt(A_a) = 2 pi / q0.
z_max, z_min : float, optional
    Highest and lowest point of the profile [m]; they set `state`.

Returns
-------
Separation

Raises
------
InvalidInput

Notes
-----
d~ is no gap: it falls to -5 h_rms where the true gap is still positive. Beyond 3 h_rms the theory has left its range.
)");
}

}  // namespace asperity::python
