// The coordinates of a friction map, x = ln v and z = ln p - s(x), or slanted ones, and what is sampled in them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

/// Of rtol, what each of the steps from the solver to cells may be off by.
inline constexpr double step_share = 1.0 / 20;

/// Steps along a curve between which its ends are looked for.
inline constexpr int curve_steps = 16;

/// Polynomials of one variable on intervals, halved until each keeps a tolerance; the intervals never cross a cut,
/// where the function has a kink.
class LoadShift {
 public:
  struct Sample {
    double value, error;
  };
  /// 0 everywhere.
  LoadShift() = default;
  /// `exact` between the first and the last of the cuts.
  LoadShift(const std::function<Sample(double z)>& exact, std::span<const double> cuts, double tolerance);

  [[nodiscard]] bool any() const { return !pieces_.empty(); }
  /// The last interval that begins below z, or the one that ends there.
  [[nodiscard]] ValueAndSlope operator()(double z) const { return on(pieces_, z); }
  /// On the side of a cut that a band (from 0) is on.
  [[nodiscard]] ValueAndSlope operator()(double z, std::size_t band) const {
    return any() ? on(std::span(pieces_).subspan(bands_[band], bands_[band + 1] - bands_[band]), z) : on(pieces_, z);
  }
  /// The largest error that was found.
  [[nodiscard]] double error() const { return error_; }
  /// Of z + ln p_T.
  [[nodiscard]] std::array<double, 2> range() const { return range_; }

 private:
  static constexpr std::size_t n = 16;
  struct Piece {
    double lower, upper;
    std::array<double, n> power;  // of -1 to 1 over the interval
    [[nodiscard]] ValueAndSlope operator()(double z) const;
  };
  static ValueAndSlope on(std::span<const Piece> pieces, double z);
  void add(const std::function<Sample(double z)>& exact, double lower, double upper, double tolerance, int depth);

  std::vector<Piece> pieces_;       // in order
  std::vector<std::size_t> bands_;  // the first piece of each, and their number
  double error_ = 0;
  std::array<double, 2> range_{};
};

/// A measured modulus has a kink at each of its rows, so that mu is rough over w = ln v + ln a_T(T0), at a constant v
/// over T0 too, and smooth over T0 at a constant w. With ln a_T = a t / (1 + b t), t = T0 - lowest, which all laws are,
/// ln v and ln a_T are between sides of their own, and on each line of constant w in the box ln a_T goes from `lower`
/// to `upper`: w and the share of this way are two coordinates between constant sides. Where a line changes the side
/// that it begins or ends on, the share has a kink over w: there maps are cut.
class Slant {
 public:
  Slant(const std::array<double, 2>& ln_velocity, const std::array<double, 2>& temperature,
        const TemperatureShift& shift)
      : x_(ln_velocity), coldest_(temperature[0]), hottest_(temperature[1]) {
    const ShiftValue first = shift_at(shift, coldest_), last = shift_at(shift, hottest_);
    const double range = hottest_ - coldest_, whole = std::log(10) * (last.log10_a_T - first.log10_a_T);
    a_ = std::log(10) * first.slope;
    b_ = (a_ * range / whole - 1) / range;
    sides_ = {std::fmin(0, whole), std::fmax(0, whole)};
  }

  [[nodiscard]] std::array<double, 2> coefficients() const { return {a_, b_}; }
  /// The sides of ln a_T, 0 one of them.
  [[nodiscard]] const std::array<double, 2>& log_a_T() const { return sides_; }

  /// w where lines change the sides, and its own sides.
  [[nodiscard]] std::vector<double> cuts() const {
    const double least = x_[0] + sides_[0], most = x_[1] + sides_[1];
    const double way = std::fmin(x_[1] - x_[0], sides_[1] - sides_[0]);
    // of a box that is as long as wide, the two are one
    const double between = std::fmax(most - way, least + way * (1 + rounding_error));
    return {least, least + way, between, most};
  }

  struct Point {
    double ln_velocity, temperature;
  };
  [[nodiscard]] Point at(double w, double share) const {
    const double lower = std::fmax(sides_[0], w - x_[1]), upper = std::fmin(sides_[1], w - x_[0]);
    const double log_a_T = lower + share * (upper - lower);
    return {w - log_a_T, std::clamp(coldest_ + log_a_T / (a_ - b_ * log_a_T), coldest_, hottest_)};
  }

 private:
  std::array<double, 2> x_, sides_{};
  double coldest_, hottest_, a_ = 0, b_ = 0;
};

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
  /// `turns`: in all directions, where there is one. Refuses a box in which a part has no contact.
  MapFrame(const Spectrum& spectrum, const Rubber& rubber, ContactModel model, const MapRequest& request, bool turns,
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
  /// ln a_T of the map without heat and its slope over T0, at each of several nodes of it; or a and b of the slant.
  [[nodiscard]] std::vector<double> log_a_T(std::span<const double> nodes) const;
  /// Between which it is.
  [[nodiscard]] std::array<double, 2> log_a_T_sides() const;
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
  [[nodiscard]] ValueAndSlope log_a_T_at(double temperature) const;
  [[nodiscard]] double velocity_at(double x) const;
  [[nodiscard]] std::vector<MapSample> solve(const ContactModel& model, const MapPoints& at, unsigned threads) const;
  [[nodiscard]] std::vector<MapSample> samples_of(const Friction& friction, std::span<const double> parts_error) const;
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
