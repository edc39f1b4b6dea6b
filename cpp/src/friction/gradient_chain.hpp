// From slopes of mu over what nodes have to those over what was given.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/friction.hpp"
#include "contact/grid/roughness_rows.hpp"
#include "contact/theory/roughness_gradient.hpp"
#include "contact/theory/strain_gradient.hpp"
#include "contact/theory/theory.hpp"
#include "friction/correction_gradient.hpp"
#include "friction/ring_gradient.hpp"
#include "heat/angular_slopes.hpp"
#include "rubber/modulus_gradient.hpp"
#include "rubber/series_gradient.hpp"

namespace asperity {

/// All that points of a call share. The rubber is the one at the reference temperature, the spectrum has the rows of a
/// law that knows directions, and `harmonics` of its rings matter.
struct GradientScene {
  const Spectrum& spectrum;
  const SelfAffineSpectrum* law;
  const Rubber& rubber;
  const ContactModel& model;
  const std::optional<Adhesion>& adhesion;
  std::span<const Segment> surface;
  const Excitation& waves;
  std::size_t harmonics;
  std::vector<double> shares;       // as Directions has them
  const std::vector<double>& rows;  // of C [1/m]
  const ModulusGradient& modulus;
  const std::optional<SeriesSlopes>& terms;  // of a series
  std::vector<double> of_top = {};  // d ln of a law's C at the roll-off or at k = q0 over its numbers, with directions
};

inline constexpr double of_harmonics = 1e-5;  // what those may have that are left out

/// Slopes of ln p_T over ln of the pressure and of what it has of the roughness; over the modulus it has that over the
/// pressure, its sign turned.
struct ShiftGradient {
  double p = 1, pressure = 0;
  double rms_height = 0, wavenumber = 0;  // of the roughness: over its rms height, and its q0 or rolloff
  double macro_wavenumber = 0;            // at which the modulus is asked for, 0 where it is not
  double velocity = 0;                    // v a_T there [m/s]
  double rate = 0;                        // d ln a_T / dT there [1/K]
  double along = 0;                       // d ln a_T / d ln q there
  std::vector<double> correction;         // over each of its numbers
};

/// The slopes of mu, or of a number that stands for it, at the nodes of a grid.
struct MuSlopes {
  ContactGradient of;
  double by_area = 0, g = 0;  // over A / A0 itself, and G at q1
  double end = 0;             // over ln q_e, beside what is felt there
  double by_lengths = 0;      // over all those of heat together, q_m a length's inverse
  FeltModulus felt, cold;     // the latter at T0, where `of` asks for it
};

/// d mu / d ln, but for the temperature.
struct PointGradient {
  Eigen::VectorXd spectrum, storage, loss;  // of each row
  double pressure = 0, velocity = 0, temperature = 0;
  double by_frequency = 0, by_temperature = 0;  // by all frequencies, and by those as they follow the temperature
  /// What the rows of the modulus have together beside what the nodes have, or slopes over less of it beside those
  /// that were taken: the larger.
  double missed = 0;
  std::vector<Eigen::VectorXd> arguments;  // of the law, the series, the factors of strain and the correction
};

/// On one grid, which must outlive it.
class GradientChain {
 public:
  GradientChain(const GradientScene& scene, const ContactGrid& grid);
  [[nodiscard]] PointGradient operator()(const MuSlopes& mu, const ShiftGradient& shift);

 private:
  void take_law();
  void take_nayak();
  [[nodiscard]] Eigen::VectorXd by_roughness(const MuSlopes& mu, double by_end, const ShiftGradient& shift);
  void take_directional_law();
  [[nodiscard]] double at_end(const Eigen::VectorXd& by_node) const;
  [[nodiscard]] double by_frequency_of(const MuSlopes& mu, const ShiftGradient& shift) const;
  void add_modulus(const MuSlopes& mu, const ShiftGradient& shift, PointGradient& result) const;
  void add_law(const MuSlopes& mu, const ShiftGradient& shift, const Eigen::VectorXd& by_node, double at_q1,
               PointGradient& result) const;

  const GradientScene& scene_;
  const ContactGrid& grid_;
  RoughnessGradient roughness_;
  RoughnessRows rows_;
  std::optional<StrainGradient> strain_;
  std::optional<FrequencyRange> known_;
  std::optional<RingGradient> rings_;
  std::vector<Eigen::VectorXd> law_;        // d ln C of the nodes over each number of a law
  std::vector<Eigen::MatrixXd> law_rings_;  // and, with directions, of their harmonics
  IntegralSlopes integrals_;
  Eigen::VectorXd nayak_;        // the same of ln alpha over ln C of the nodes
  std::vector<SInside> inside_;  // at an alpha that is less, and more
  std::optional<GammaGradient> gamma_;
};

/// The numbers of a law by their names, in the order of the slopes.
std::vector<std::string> law_arguments(const SelfAffineSpectrum& law);
/// Of a law that knows directions, at a kept rms height.
std::vector<double> slopes_of_top(const SelfAffineSpectrum& law);

}  // namespace asperity
