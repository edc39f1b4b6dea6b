// Affine shifts from the surface's asperities: local peaks, Greenwood-Williamson, both.
#include <pybind11/stl.h>

#include <algorithm>

#include "arguments.hpp"
#include "arrays.hpp"
#include "correction.hpp"
#include "parts.hpp"
#include "value.hpp"

namespace asperity::python {

namespace {

struct Profile {
  LocalPeaks peaks;
  std::optional<double> z_min;
};

/// As given, where nobody can change it: a map, or a copy of the heights.
py::object kept(const py::object& source) {
  return py::isinstance<HeightMap>(source) ? source : flat(vector_of(source, "heights_or_map"));
}

/// Peak heights as given, or found on a map; z_max and z_min from the map where it is one.
Profile profile_of(const py::object& source, std::optional<double> min_distance, std::optional<double> z_max) {
  Profile profile;
  if (py::isinstance<HeightMap>(source)) {
    const auto& map = source.cast<const HeightMap&>();
    if (!min_distance) throw InvalidInput("min_distance: must be given with a HeightMap, for instance 2 pi / q0 [m]");
    {
      const py::gil_scoped_release release;
      const HeightStatistics statistics = map.statistics();
      profile.peaks = {map.local_peaks(*min_distance), z_max.value_or(statistics.z_max)};
      profile.z_min = statistics.z_min;
    }
    const std::size_t found = profile.peaks.heights.size();
    if (found < 3)
      throw InvalidInput("min_distance = " + py::str(py::cast(*min_distance)).cast<std::string>() + ": leaves " +
                         std::to_string(found) + " peaks on this map, must leave 3 or more");
  } else {
    profile.peaks.heights = vector_of(source, "heights_or_map");
    if (min_distance) throw InvalidInput("min_distance: only goes with a HeightMap, these are the peaks' heights");
    profile.peaks.z_max = z_max;
    if (profile.peaks.heights.size() < 3)
      throw InvalidInput("heights_or_map has " + std::to_string(profile.peaks.heights.size()) +
                         " entries: must be 3 or more");
  }
  validate(Correction(profile.peaks));
  if (!profile.peaks.z_max) profile.peaks.z_max = std::ranges::max(profile.peaks.heights);
  return profile;
}

/// A float or None.
template <class C>
auto optional_field(std::optional<double> C::*field) {
  return [field](const C& c) { return c.*field; };
}

}  // namespace

void bind_asperity_correction(py::module_& m) {
  py::classh<BoundLocalPeaks> peaks(m, "LocalPeaks", R"(p_T1 = z_max / (z_max - <h_peaks>) (Eq. 13).

Parameters
----------
heights_or_map : array_like, shape (n,), or HeightMap
    Heights of the peaks above the mean plane [m], n >= 3; or a map, on which they are found.
min_distance : float, optional
    Between peaks [m]; needed with a map, and refused without. The article uses lambda0 = 2 pi / q0 and lambda0 / 2.
z_max : float, optional
    Highest point of the profile [m]; by default the map's, or the highest peak.

Raises
------
InvalidInput
    Fewer than 3 peaks, a mean below the mean plane, z_max below the highest peak.

Notes
-----
On the contacts of SFactor, peaks no closer than lambda0 / 2: p_T1 from 1.7 to 2.5; mean error and the worst of the area
44 %, +87 %, of the elastic energy 44 %, -82 %. No closer than lambda0: p_T1 from 2.3 to 4.4; 108 %, +217 % and 65 %,
-94 %. Knowing neither load nor rubber it is right at one load alone.
)");
  peaks
      .def(py::init([](const py::object& source, OptionalNumber<"min_distance"> min_distance,
                       OptionalNumber<"z_max"> z_max) {
             return BoundLocalPeaks{profile_of(source, min_distance, z_max).peaks, kept(source), min_distance};
           }),
           py::arg("heights_or_map"), py::kw_only(), py::arg("min_distance") = py::none(),
           py::arg("z_max") = py::none())
      .def_readonly("heights_or_map", &BoundLocalPeaks::source, "As given.")
      .def_property_readonly(
          "heights", [](const BoundLocalPeaks& s) { return flat(s.heights); }, "Of the peaks [m], shape (n,).")
      .def_readonly("min_distance", &BoundLocalPeaks::min_distance, "Between peaks [m] or None.")
      .def_property_readonly(
          "z_max", [](const BoundLocalPeaks& s) { return s.z_max; }, "Highest point [m].")
      .def_property_readonly(
          "shift_factor", [](const BoundLocalPeaks& s) { return shift_factor(s); }, "p_T1 [-].");
  value_semantics(peaks, {"heights_or_map", "min_distance", "z_max"});

  py::classh<GreenwoodWilliamson> gw(m, "GreenwoodWilliamson", R"(p_T2 = (z_max - z_min) / (z_max - d~) (Eq. 21's text).

d~ is the effective separation (see `separation`) at E* = |E(q0 v)| / (1 - nu^2), so that p_T depends on velocity
and pressure.

Parameters
----------
z_max, z_min : float
    Highest (positive) and lowest (negative) point of the profile about its mean plane [m].
peaks : array_like, shape (n,), optional
    Measured peak heights instead of Gaussian heights in Eq. 16, the article's Section 3.2 for skewed surfaces.
reading : {"implicit", "added"}
    Of Eqs 19-20, see `separation`.
rms_height, q0 : float, optional
    Of the macro-asperities [m], [1/m]; by default the spectrum's, q0 its roll-off where it has one. They set R = 1 / (q0^2 sqrt 2 h_rms) and
    n_a = q0^2 / (2 pi^2 sqrt 3), with `peaks` too. Of a measured spectrum give q0: its lowest bin is one scan length,
    and results that had to take it carry a note.

Notes
-----
d~ <= z_min is full conformity: p_T = 1. d~ >= z_max is no contact: area and friction are 0 and p_T is infinite. Beyond
d~ = 3 h_rms the model has left its range: results carry a note.

On the contacts of SFactor, mean error and the worst. Area: 16 %, +48 % implicit; 14 %, +51 % added. Elastic energy:
32 %, +81 % implicit; 27 %, -81 % added. Its p_T falls with the load as the exact one does, but too fast: the implicit
reading is in full conformity, no correction at all, on all but 5 of 104 contacts from p / (E* h') = 0.1
on, the added one turns back above 0.5.
)");
  gw.def(py::init([](Number<"z_max"> z_max, Number<"z_min"> z_min, const py::object& heights, const Option& reading,
                     OptionalNumber<"rms_height"> rms_height, OptionalNumber<"q0"> q0) {
           GreenwoodWilliamson s{z_max, z_min, {}, reading_of(reading), rms_height, q0};
           if (!heights.is_none()) {
             s.peaks = vector_of(heights, "peaks");
             if (s.peaks.empty()) throw InvalidInput("peaks has 0 entries: must be 3 or more");
           }
           validate(Correction(s));
           return s;
         }),
         py::kw_only(), py::arg("z_max"), py::arg("z_min"), py::arg("peaks") = py::none(),
         py::arg("reading") = "implicit", py::arg("rms_height") = py::none(), py::arg("q0") = py::none())
      .def_readonly("z_max", &GreenwoodWilliamson::z_max, "Highest point [m].")
      .def_readonly("z_min", &GreenwoodWilliamson::z_min, "Lowest point [m].")
      .def_property_readonly(
          "peaks",
          [](const GreenwoodWilliamson& s) { return s.peaks.empty() ? py::object(py::none()) : flat(s.peaks); },
          "Peak heights [m] or None.")
      .def_property_readonly(
          "reading", [](const GreenwoodWilliamson& s) { return name_of_reading(s.reading); }, "Of Eqs 19-20.")
      .def_property_readonly("rms_height", optional_field(&GreenwoodWilliamson::rms_height), "h_rms [m] or None.")
      .def_property_readonly("q0", optional_field(&GreenwoodWilliamson::q0), "q0 [1/m] or None.");
  value_semantics(gw, {"z_max", "z_min", "peaks", "reading", "rms_height", "q0"});

  using Both = BoundPeaksThenGreenwoodWilliamson;
  py::classh<Both> both(m, "PeaksThenGreenwoodWilliamson", R"(p_T = p_T1 p_T2, for skewed surfaces (the Conclusions).

The profile is shifted by p_T1 of its peaks (Eq. 9); Greenwood-Williamson then runs on what results, whose z_max,
z_min and rms height are those of the profile divided by p_T1 (R follows, n_a stays).

Parameters
----------
heights_or_map, min_distance
    As for LocalPeaks.
z_max, z_min : float, optional
    Of the profile before the shift [m]; by default the map's. Without a map z_min must be given, and z_max is the
    highest peak.
reading, rms_height, q0
    As for GreenwoodWilliamson, before the shift.

Notes
-----
On the contacts of SFactor (maps of little skewness, not those it is meant for), peaks no closer than lambda0 / 2, mean
error and the worst: area 67 %, +182 %; elastic energy 45 %, -82 %.
)");
  both.def(py::init([](const py::object& source, OptionalNumber<"min_distance"> min_distance,
                       OptionalNumber<"z_max"> z_max, OptionalNumber<"z_min"> given_z_min, const Option& reading,
                       OptionalNumber<"rms_height"> rms_height, OptionalNumber<"q0"> q0) {
             const Profile profile = profile_of(source, min_distance, z_max);
             const std::optional<double> z_min = given_z_min.value ? given_z_min.value : profile.z_min;
             if (!z_min) throw InvalidInput("z_min: must be given where heights_or_map is no HeightMap");
             Both s{{profile.peaks, *profile.peaks.z_max, *z_min, reading_of(reading), rms_height, q0},
                    kept(source),
                    min_distance};
             validate(Correction(s));
             return s;
           }),
           py::arg("heights_or_map"), py::kw_only(), py::arg("min_distance") = py::none(),
           py::arg("z_max") = py::none(), py::arg("z_min") = py::none(), py::arg("reading") = "implicit",
           py::arg("rms_height") = py::none(), py::arg("q0") = py::none())
      .def_readonly("heights_or_map", &Both::source, "As given.")
      .def_property_readonly(
          "heights", [](const Both& s) { return flat(s.peaks.heights); }, "Of the peaks [m].")
      .def_readonly("min_distance", &Both::min_distance, "Between peaks [m] or None.")
      .def_property_readonly(
          "z_max", [](const Both& s) { return s.z_max; }, "Highest point [m].")
      .def_property_readonly(
          "z_min", [](const Both& s) { return s.z_min; }, "Lowest point [m].")
      .def_property_readonly(
          "reading", [](const Both& s) { return name_of_reading(s.reading); }, "Of Eqs 19-20.")
      .def_property_readonly(
          "rms_height", [](const Both& s) { return s.rms_height; }, "h_rms [m] or None.")
      .def_property_readonly(
          "q0", [](const Both& s) { return s.q0; }, "q0 [1/m] or None.");
  value_semantics(both, {"heights_or_map", "min_distance", "z_max", "z_min", "reading", "rms_height", "q0"});
}

}  // namespace asperity::python
