// Slopes of mu of a point on one level of nodes.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/friction.hpp"
#include "contact/grid/roughness_rows.hpp"
#include "contact/theory/roughness_gradient.hpp"
#include "contact/theory/theory.hpp"
#include "heat/angular_slopes.hpp"
#include "rubber/modulus_gradient.hpp"

namespace asperity {

/// All that points of a call share. The rubber is the one at the reference temperature.
struct GradientScene {
  const Spectrum& spectrum;
  const Rubber& rubber;
  const ContactModel& model;
  const std::optional<Adhesion>& adhesion;
  std::span<const Segment> surface;
  const std::vector<double>& rows;  // of C [1/m]
  const ModulusGradient& modulus;
  std::vector<std::string> names;  // of the arguments, and how many numbers each has
  std::vector<std::size_t> counts;
};

struct GradientPoint {
  double pressure, velocity;
  double a_T = 1;
  std::optional<double> shift_rate = std::nullopt;  // d ln a_T / dT [1/K], where there is a temperature
};

/// Slopes of ln p_T over ln of the pressure, of the rms height of the roughness and of each number of a law; over the
/// modulus it has that over the pressure, its sign turned.
struct ShiftGradient {
  double p = 1, pressure = 0, rms_height = 0;
  double macro_wavenumber = 0;  // at which the modulus is asked for, 0 where it is not
  std::vector<double> law;
};

/// d mu / d ln, but for a_T as well.
struct PointGradient {
  Eigen::VectorXd spectrum, storage, loss;  // of each row
  double pressure = 0, velocity = 0, by_a_T = 0;
  double missed = 0;  // what the rows of the modulus have together beside what the nodes have
  std::vector<Eigen::VectorXd> arguments;
};

class GradientLevel {
 public:
  GradientLevel(const GradientScene& scene, std::size_t number);
  PointGradient operator()(const GradientPoint& point, const ShiftGradient& shift);

 private:
  void take_law();
  void take_nayak();
  [[nodiscard]] Eigen::VectorXd by_roughness(const ContactGradient& of, double by_end, double by_area,
                                             const ShiftGradient& shift);
  [[nodiscard]] double at_end(const Eigen::VectorXd& by_node, bool upper) const;
  void add_modulus(const GradientPoint& point, const ContactGradient& of, const ShiftGradient& shift,
                   PointGradient& result);
  void add_law(const ContactGradient& of, const ShiftGradient& shift, const Eigen::VectorXd& by_node,
               PointGradient& result) const;

  const GradientScene& scene_;
  std::size_t number_;
  RoughnessWindow window_;
  ContactGrid grid_;
  std::unique_ptr<Theory> theory_;
  RoughnessGradient roughness_;
  RoughnessRows rows_;
  AngularSlopes angular_;
  std::optional<FrequencyRange> known_;
  std::vector<Eigen::VectorXd> law_;  // d ln C of the nodes over each number of a law
  Eigen::VectorXd nayak_;             // the same of ln alpha over ln C of the nodes
  std::vector<SInside> inside_;       // at an alpha that is less, and more
  std::vector<double> reduced_, by_i1_, by_i2_;
  AngularColumns columns_;
};

/// The numbers of a law by their names, in the order of the slopes.
std::vector<std::string> law_arguments(const SelfAffineSpectrum& law);
/// The law with one of them times a factor.
SelfAffineSpectrum changed_law(const SelfAffineSpectrum& law, std::size_t argument, double factor);

}  // namespace asperity
