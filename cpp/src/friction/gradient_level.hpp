// Slopes of mu of a point on one level of nodes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/theory/theory.hpp"
#include "friction/gradient_chain.hpp"
#include "heat/angular_slopes.hpp"

namespace asperity {

struct GradientPoint {
  double pressure, velocity;
  double a_T = 1;                                   // without heat
  std::optional<double> shift_rate = std::nullopt;  // d ln a_T / dT [1/K], where there is a temperature
  double temperature = 0;                           // [K], with heat
  double hysteresis = 1, area = 1;                  // those of a scan's contact over those of the theory
};

/// The slopes of ln p_T with the velocity times a_T, of which d ln a_T / dT is the rate and `along` d ln a_T / d ln q
/// where the asperities' wavenumber moves.
ShiftGradient shift_gradient(const GradientScene& scene, double pressure, double velocity, double rate,
                             double along = 0);

/// Adds the slopes over the pressure, the velocity, the temperature and the adhesion: with the number that is in
/// proportion to the pressure, that which is to its inverse and to the adhesion, and the slope over the scale of G.
void add_conditions(const GradientScene& scene, const GradientPoint& point, const ShiftGradient& shift,
                    double hysteresis, double adhesion, double by_scale, PointGradient& result);

/// With a rubber of one temperature.
class GradientLevel {
 public:
  GradientLevel(const GradientScene& scene, std::size_t number);
  PointGradient operator()(const GradientPoint& point, const ShiftGradient& shift);

 private:
  void take_moduli(double velocity);
  const GradientScene& scene_;
  RoughnessWindow window_;
  std::unique_ptr<const RoughnessPieces> cut_;  // where the waves' factors have kinks
  ContactGrid grid_;
  std::unique_ptr<Theory> theory_;
  GradientChain chain_;
  AngularSlopes angular_;
  const RoughnessCells* cells_ = nullptr;  // by which a series is had at all nodes
  std::optional<PanelSlopes> panels_;      // for a measured modulus
  std::optional<FrequencyRange> known_;
  MuSlopes mu_;
  FeltModulus at_points_;  // of the cells
};

}  // namespace asperity
