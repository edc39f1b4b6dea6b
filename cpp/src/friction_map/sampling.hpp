// The coordinates of a friction map, x = ln v and z = ln p - s(x), or slanted ones (slant.hpp), and what is sampled in
// them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "friction_map/load_shift.hpp"
#include "friction_map/slant.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

struct MapPlace {
  double x, z;
};

/// Points of the box: [Pa], [m/s], [K].
struct MapPoints {
  std::vector<double> pressure, velocity, temperature;
  void add(double p, double v, double T) {
    pressure.push_back(p);
    velocity.push_back(v);
    temperature.push_back(T);
  }
};

/// A number at a share of the way between the logarithms of two sides.
inline double between(const std::array<double, 2>& sides, double share) {
  return std::clamp(std::exp((1 - share) * std::log(sides[0]) + share * std::log(sides[1])), sides[0], sides[1]);
}

struct MapSample {
  std::array<double, 2> f;  // ln mu_H (0 without hysteresis), ln A/A0
  double error;             // of f, the solver's estimate
  double across = 0;        // the force across over mu_H
};

/// Of a map with the heat that friction makes.
struct MapHeat {
  const TemperatureShift* shift;
  const Heating* heating;
  std::optional<Adhesion> adhesion;
  std::array<double, 2> range;  // temperatures of the background that the map holds [K]
  double height;                // the one of this frame: a temperature, or the share of the way of a slanted line
};

/// InvalidInput, with the temperature and the velocity, where the heat has more than one steady state at a point.
void refuse_folds(const FlashFriction& friction);

class MapFrame {
 public:
  /// Refuses a box in which a part has no contact.
  MapFrame(const Spectrum& spectrum, const Rubber& rubber, ContactModel model, const MapRequest& request,
           std::optional<MapHeat> heat = {});

  /// The temperatures of the background that the map holds [K]; 0 without heat.
  [[nodiscard]] std::array<double, 2> temperature() const { return heat_ ? heat_->range : std::array<double, 2>{0, 0}; }
  /// The third coordinate, T0; or the share of the way along lines of constant v a_T, x being ln p and z ln(v a_T).
  /// Or the angle from the direction of the model, up to half a turn.
  [[nodiscard]] std::array<double, 2> heights() const {
    return slant_ ? std::array<double, 2>{0, 1} : turns_ ? std::array<double, 2>{0, std::numbers::pi} : temperature();
  }
  /// Whether the third coordinate is the direction of sliding.
  [[nodiscard]] bool turns() const { return turns_; }
  /// Whether there are forces across the sliding.
  [[nodiscard]] bool directional() const { return directional_; }
  /// The same of the force across over mu_H, beside zeros, in the place of the two functions.
  [[nodiscard]] MapFrame of_across() const;
  [[nodiscard]] const std::optional<Slant>& slant() const { return slant_; }
  /// Those between which a_T is smooth: with the ends the rows of a table of shift factors.
  [[nodiscard]] std::vector<double> height_cuts() const;
  /// By how much ln a_T is off in the middles between nodes, over which cubics with its slopes go; exact along slanted
  /// lines.
  [[nodiscard]] double error_of_shift(std::span<const double> nodes) const;
  /// The same at another one.
  [[nodiscard]] MapFrame at_height(double height) const;
  [[nodiscard]] std::array<double, 2> x() const {
    return slant_ ? std::array<double, 2>{y_lo_, y_hi_} : std::array<double, 2>{x_lo_, x_hi_};
  }
  /// z of the box's sides at an x.
  [[nodiscard]] std::array<double, 2> z(double x) const;
  [[nodiscard]] bool in_box(const MapPlace& place) const;
  [[nodiscard]] std::uint32_t band(double z) const;
  [[nodiscard]] std::array<double, 2> ln_velocity() const { return {x_lo_, x_hi_}; }
  [[nodiscard]] double ln_pressure(int side) const { return side == 0 ? y_lo_ : y_hi_; }
  /// Where bands of one state begin and end, in z, rising: all of the box lies between the first and the last.
  [[nodiscard]] const std::vector<double>& cuts() const { return cuts_; }
  /// s(x): 0, or ln E* of the Greenwood-Williamson correction as a cubic spline.
  [[nodiscard]] double log_modulus_offset(double x) const { return spline(x).value; }
  [[nodiscard]] ValueAndSlope spline(double x) const;
  /// Its smallest and largest value at the nodes.
  [[nodiscard]] std::array<double, 2> offsets() const;
  /// ln E* itself, or 0.
  [[nodiscard]] double log_modulus(double x) const;
  /// ln p_T of the Greenwood-Williamson correction over ln(p / E*); 0 for the others.
  [[nodiscard]] const LoadShift& load_shift() const { return load_shift_; }
  /// The node of s between two places that the cubic through their values and slopes leaves most, if there is one.
  [[nodiscard]] std::optional<double> least_smooth(double from, double to) const;
  /// s and s' at nodes, for the file; empty where s is 0.
  [[nodiscard]] const std::vector<double>& log_modulus_nodes() const { return offset_; }
  [[nodiscard]] bool hysteresis() const { return hysteresis_; }
  /// Whether any of a rectangle with its lower corner there is in the box; one at its very edge is.
  [[nodiscard]] bool touches_box(const MapPlace& corner, const MapPlace& size) const;
  /// What the solver is asked for.
  [[nodiscard]] double solver_rtol() const { return model_.rtol; }
  /// The same with a solver that is asked for less.
  [[nodiscard]] MapFrame with_solver_rtol(double rtol) const;

  [[nodiscard]] std::vector<MapSample> sample(std::span<const MapPlace> places, unsigned threads = 1) const;
  /// At a height for each, where there are several.
  [[nodiscard]] std::vector<MapSample> sample_at(std::span<const MapPlace> places, std::span<const double> height,
                                                 unsigned threads) const;
  /// With heat, at ln v, ln p and a temperature [K] for each, whatever the coordinates are.
  [[nodiscard]] std::vector<MapSample> sample_points(std::span<const MapPlace> points,
                                                     std::span<const double> temperature, unsigned threads) const;
  /// At a place (ln v, ln p) without the shift of a Greenwood-Williamson correction. With it mu_H and A are those at
  /// p p_T, and mu_H is divided by p_T.
  [[nodiscard]] std::vector<MapSample> sample_unshifted(std::span<const MapPlace> places, unsigned threads) const;

 private:
  [[nodiscard]] std::vector<MapSample> sample(const ContactModel& model, const std::vector<double>& pressure,
                                              std::span<const MapPlace> places, unsigned threads) const;
  [[nodiscard]] std::vector<double> velocities_of(std::span<const MapPlace> places) const;
  [[nodiscard]] std::vector<MapSample> samples_of(const Friction& friction, std::span<const double> parts_error) const;
  [[nodiscard]] std::vector<MapSample> with_heat(std::span<const double> pressure, std::span<const double> velocity,
                                                 std::span<const double> temperature, unsigned threads) const;
  void make_log_modulus_offset();
  void cut_bands();

  const Spectrum& spectrum_;
  const Rubber& rubber_;
  ContactModel model_, unshifted_;
  double rtol_;  // of the map
  std::array<double, 2> velocity_;
  double x_lo_, x_hi_, y_lo_, y_hi_;
  std::vector<double> offset_, cuts_;
  LoadShift load_shift_;
  std::optional<MapHeat> heat_;
  std::optional<Slant> slant_;
  bool hysteresis_ = true, turns_ = false, directional_ = false, of_across_ = false;
  double first_direction_;  // of the model [rad]
};

}  // namespace asperity
