// The friction map of friction_map.hpp, built to a tolerance and certified.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/export.hpp"
#include "asperity/friction.hpp"
#include "asperity/friction_map.hpp"

namespace asperity {

/// The range of a map and its tolerance.
struct MapRequest {
  std::array<double, 2> pressure, velocity;   // lo, hi [Pa], [m/s]
  double rtol = 1e-4;                         // of mu_H and A/A0, and so of mu with any adhesion
  std::size_t checked = 1'000'000;            // random points on which the finished map is checked
  std::string_view text = {};                 // lines for whoever reads the file, UTF-8
  unsigned threads = 0;                       // at most, 0: as many as the machine has; the bytes are the same
  std::function<void(double)> progress = {};  // told the share of the work that is done, now and then
  std::function<std::vector<Diagnostic>(const std::vector<Diagnostic>&)> words = {};  // says notes as the file has them
};

/// The bytes of a map's file, for FrictionMap::read; `model.rtol` is not used. The map stores ln mu_H and ln A/A0 in
/// bicubic cells, split where they are off by more than rtol / 2 (relative, the solver's own estimate included) on
/// lattices of 5 x 5 or on random points unseen before, 12 a cell; `max_error` is twice the largest error left on
/// either. OutOfRange where the rubber is not known, InvalidInput where there is no contact in a part of the box,
/// NotConverged with what was reached where 100,000 cells are too few. On a directional spectrum cells are cubics
/// between as many directions as rtol asks for, counted from that of `model`, and the file holds lateral / mu_H beside
/// them to the same rtol; with a ScanContact the map has the one direction of `model`.
ASPERITY_EXPORT std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber,
                                                              const ContactModel& model,
                                                              const std::optional<Adhesion>& adhesion,
                                                              const MapRequest& request);

/// The same with the heat that friction makes, for backgrounds of one temperature (both ends equal) or of all between
/// [K]; `rubber` is the one at the reference of `shift`. On a directional spectrum the map has the one direction of
/// `model`. Beside it the file holds the map without heat, to the same
/// rtol, and the distance over which sliding that begins heats up. Over the temperature cells are cubics between as
/// many nodes as rtol asks for; over a range of it and with a measured master curve they are cubics along lines of
/// constant v a_T instead, as mu is rough across them, where `shift` is a law: shift factors have kinks at temperatures
/// of their own, so that such a map takes minutes at 1e-2. InvalidInput where the heat has several steady states in the
/// box, with the temperature and the velocity, and for corrections of Greenwood and Williamson. A point of the solver
/// takes some 0.2 ms, a million for the check some minutes: 5,000 pressures and temperatures with 200 velocities each.
ASPERITY_EXPORT std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber,
                                                              const TemperatureShift& shift, const Heating& heating,
                                                              const ContactModel& model,
                                                              const std::optional<Adhesion>& adhesion,
                                                              std::array<double, 2> temperature,
                                                              const MapRequest& request);

/// Points for `look_up`, each column as long as the result, or of one entry for all. Background and distance, of maps
/// with heat, may be empty where there is one temperature, and for what slid long ago, and so may the direction [rad].
struct MapColumns {
  std::span<const double> pressure, velocity, a_T, background = {}, distance = {}, direction = {};
};

/// FrictionMap::mu at many points, with this machine's vector units; equal to it to 1e-14. Gives the number of the
/// first point without a value, or how many points there are where all have one.
ASPERITY_EXPORT std::size_t look_up(const FrictionMap& map, const MapColumns& points, FrictionMap::Outside outside,
                                    bool shifts_adhesion, std::span<double> mu);

/// A number of MapPoint, or FrictionMap::traction [Pa].
enum class MapQuantity { mu, hysteresis, adhesion, contact_area, traction, lateral };

/// The same of another number than mu.
ASPERITY_EXPORT std::size_t look_up(MapQuantity quantity, const FrictionMap& map, const MapColumns& points,
                                    FrictionMap::Outside outside, bool shifts_adhesion, std::span<double> result);

/// The same of d mu / d ln p and d mu / d ln v, of equal length.
ASPERITY_EXPORT std::size_t look_up_slopes(const FrictionMap& map, const MapColumns& points,
                                           FrictionMap::Outside outside, bool shifts_adhesion,
                                           std::span<double> dmu_dlnp, std::span<double> dmu_dlnv);

}  // namespace asperity
