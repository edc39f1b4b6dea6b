// One pass of the fixed point: from a temperature profile to the heat that it leaves and the rise that this makes.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "asperity/dma.hpp"
#include "contact/theory/theory.hpp"
#include "heat/angular_slopes.hpp"
#include "heat/heat_grid.hpp"
#include "heat/kernel.hpp"

namespace asperity {

/// a_T and its slope at a temperature [K], held where what is known of it ends: while a temperature is searched for, it
/// may go beyond. Whether the result lies inside is for the caller to check.
ShiftValue held_shift(const TemperatureShift& shift, double temperature);

/// p_T with the slope of its logarithm over the temperature [1/K].
struct HotShift {
  Shift shift;
  double slope = 0;
};

/// That of corrections by Greenwood-Williamson's model follows |E(q0 v a_T)| with the a_T of what q0 feels; those of
/// the others stay.
HotShift hot_shift(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                   const ShiftValue& value, double poisson_ratio, double pressure, double velocity);

/// What all points of a computation share.
struct HeatScene {
  const Spectrum& spectrum;
  std::span<const Segment> surface;
  const Rubber& rubber;  // at the reference of the shift
  const TemperatureShift& shift;
  const Heating& heating;
  const ContactModel& model;
  double macro_wavenumber;  // q_m, inside of the band [1/m]
};

/// One pressure, velocity and background temperature.
struct HeatPoint {
  double pressure, velocity, temperature;
  double adhesion_per_area;  // mu_A over A/A0 at q1, 0 without
};

/// theta -> F(theta), the rise at the grid's temperature points [K], with its Jacobian and what is known on the way.
class FlashMap {
 public:
  FlashMap(const HeatScene& scene, const HeatGrid& grid);
  void start(const HeatPoint& point);
  /// A pass; theta at the temperature points [K].
  void operator()(const Eigen::VectorXd& theta);
  /// A pass with ln kappa of PartialContact given too, and the slopes of F and of what the rule of kappa is off, a row
  /// more, over theta and ln kappa, a column more.
  void operator()(const Eigen::VectorXd& theta, double log_kappa);
  [[nodiscard]] Eigen::MatrixXd jacobian_with_kappa();
  [[nodiscard]] double off_rule() const { return contact_->off_rule(); }
  /// ln kappa of the last pass, none but with PartialContact; from that of another one the next roots are sought.
  [[nodiscard]] std::optional<double> log_kappa() const { return contact_->log_kappa(); }
  void begin_at_kappa_of(const FlashMap& other) {
    if (const auto known = other.log_kappa()) contact_->begin_at(*known);
  }

  /// A pass with one a_T for all roughness.
  void at_one_shift(double log_a_T);
  /// What the contact was in the last pass; the heat of another one, which over its macro-asperities is the rise [K] at
  /// the last temperature point; and the share of that rise that q_m feels.
  struct ContactHeat {
    Eigen::VectorXd part;  // as Theory has it
    double area = 0, macro_area = 1;
  };
  [[nodiscard]] ContactHeat contact_heat() const;
  [[nodiscard]] double last_heat(const ContactHeat& contact) const;
  [[nodiscard]] double macro_share(const ContactHeat& contact) const;

  [[nodiscard]] const HeatGrid& grid() const { return grid_; }
  [[nodiscard]] const HeatScene& scene() const { return scene_; }
  [[nodiscard]] const Eigen::VectorXd& rise() const { return rise_; }  // F
  /// Slopes of the last pass: dF_i / dtheta_j, and those of mu_H and A / A0 over theta.
  struct PartSlopes {
    Eigen::RowVectorXd hysteresis, area;
  };
  [[nodiscard]] const Eigen::MatrixXd& jacobian();
  [[nodiscard]] const PartSlopes& part_slopes();
  /// d(mu_H + mu_A) / dtheta.
  [[nodiscard]] Eigen::RowVectorXd slope_of_mu();
  /// The Jacobian times a profile.
  [[nodiscard]] Eigen::VectorXd along(const Eigen::VectorXd& direction);
  /// The slopes of mu of the last pass, at its solution, over all that it is made of but the temperatures, which
  /// follow: those of mu + lambda F at fixed temperatures, lambda = (1 - dF / dtheta)^-T dmu / dtheta.
  struct Adjoint {
    ContactGradient of;
    double by_area = 0;             // over A / A0 itself
    double depth = 0, surface = 0;  // lambda F, as hysteresis and as adhesion make it
    double length = 0;              // over ln l of the kernel
    double macro_wavenumber = 0;    // over ln q_m
    double end = 0;                 // over ln q_e, with which the edges' nodes move as sources of heat
  };
  [[nodiscard]] Adjoint adjoint();
  /// Of all nodes at T(q), and at T0.
  [[nodiscard]] FeltModulus felt();
  [[nodiscard]] FeltModulus felt_cold();
  /// a_T of what the affine shift feels.
  [[nodiscard]] const ShiftValue& also_felt() const { return also_felt_; }
  [[nodiscard]] double also_felt_along() const;  // d ln a_T / d ln q there
  /// How many temperature points there are.
  [[nodiscard]] Eigen::Index rise_size() const { return grid_.to_nodes().cols(); }
  [[nodiscard]] double hysteresis() const { return hysteresis_; }
  /// The force across over the load, and what harmonics that are left out may have of mu_H, relative; 0 without
  /// directions.
  [[nodiscard]] double lateral() const;
  [[nodiscard]] double rest_of_harmonics() const { return rest_of_harmonics_; }
  [[nodiscard]] double contact_area() const { return touches() ? contact_->area() : 0; }
  [[nodiscard]] double adhesion() const { return contact_area() * point_.adhesion_per_area; }
  [[nodiscard]] double macro_area() const { return macro_area_; }
  [[nodiscard]] double g() const { return touches() ? contact_->g() : 0; }  // at q1
  [[nodiscard]] const Shift& shift() const { return shift_.shift; }
  /// Reduced frequencies v q a_T(T(q)) at the nodes of the band [rad/s], and that of a wavenumber at a temperature.
  [[nodiscard]] std::span<const double> reduced_frequency() const { return {reduced_.data(), grid_.band_size()}; }
  [[nodiscard]] double reduced_frequency(double wavenumber, double temperature) const;
  /// Heat f of the nodes, with which the rise is sum_j f_j g(q, q_j) where it is steady [K/s], and that of the surface
  /// [K m/s], which makes the rise times 2 q t N.
  [[nodiscard]] Eigen::VectorXd heat_of_nodes() const;
  [[nodiscard]] double heat_of_surface() const;
  /// The parts of mu_H that the nodes have, and of them those from outside of the measured frequencies.
  [[nodiscard]] Eigen::VectorXd contributions() const;
  [[nodiscard]] double outside_share() const;
  /// dmu_H / dln q at a wavenumber and its temperature.
  [[nodiscard]] double hysteresis_density(double wavenumber, double temperature) const;

 private:
  void take_harmonics();
  void take_frequency(std::size_t node, const ShiftValue& shift);
  [[nodiscard]] Eigen::VectorXd cold_i2();
  void pass(const Eigen::VectorXd& theta, std::optional<double> log_kappa);
  void pass(const ShiftValue& also_felt, std::optional<double> log_kappa = {});
  void heat(std::optional<double> log_kappa);
  [[nodiscard]] double heat_at(const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& kernel,
                               double surface, const ContactHeat& contact) const;
  void take_slopes();
  [[nodiscard]] double heat_at_length(const Eigen::VectorXd& lambda, double log_length) const;
  [[nodiscard]] double edges_along(const Eigen::VectorXd& lambda, double log_wavenumber) const;
  [[nodiscard]] Eigen::MatrixXd slopes_along(const Eigen::MatrixXd& directions, PartSlopes& of_parts,
                                             const std::optional<Eigen::RowVectorXd>& log_kappa = {},
                                             Eigen::RowVectorXd* rule = nullptr);
  [[nodiscard]] bool touches() const { return shift_.shift.state != ContactState::no_contact; }

  const HeatScene& scene_;
  const HeatGrid& grid_;
  Excitation waves_;
  AngularSlopes angular_;
  std::unique_ptr<Theory> contact_;
  std::optional<Rubber> unlimited_;  // a series without the range that it was fitted on
  Excitation unlimited_waves_;
  std::optional<FrequencyRange> known_;
  HeatPoint point_{};
  double mu_factor_ = 0, per_flux_ = 0;  // per_flux_: v sigma0 / (rho c_v) [K/s m]

  HeatKernelTable table_;
  Eigen::MatrixXd kernel_;       // q_j g_ij
  Eigen::VectorXd surface_;      // 2 q t N at the temperature points
  Eigen::RowVectorXd at_macro_;  // from values at the temperature points to that at q_m
  std::vector<double> reduced_;
  Eigen::VectorXd rate_;  // d ln a_T / dT at the nodes, 0 where the frequency is held
  AngularColumns columns_;
  HotShift shift_;
  ShiftValue also_felt_{};
  Eigen::VectorXd theta_;  // of the last pass
  Eigen::VectorXd rise_;
  double hysteresis_ = 0, macro_area_ = 1, rest_of_harmonics_ = 0;
  bool differentiated_ = false, sloped_ = false;
  Eigen::VectorXd log_i2_, log_ratio_;  // slopes over the temperature
  Eigen::MatrixXd jacobian_;
  PartSlopes part_slopes_;
};

/// The distance [m] from rest, at the point's velocity throughout, at which mu has come from that without heat to
/// within 1 / e of that in the end; of the rise at q1 where mu does not change. To about 1 % of the contact's diameter.
double sliding_length(const HeatScene& scene, const HeatPoint& point);

}  // namespace asperity
