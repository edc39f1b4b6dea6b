// One pass of the fixed point: from a temperature profile to the heat that it leaves and the rise that this makes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "asperity/contact.hpp"
#include "asperity/dma.hpp"
#include "contact/s_factor.hpp"
#include "contact/solver/contact_integral.hpp"
#include "heat/angular_slopes.hpp"
#include "heat/grid.hpp"
#include "heat/kernel.hpp"

namespace asperity {

/// What all points of a computation share.
struct HeatScene {
  const Spectrum& spectrum;
  std::span<const Segment> surface;
  const Rubber& rubber;  // at the reference of the shift
  const TemperatureShift& shift;
  const Heating& heating;
  const ContactModel& model;
  std::optional<SFunction> factor;  // S of the integrand of Eq. 22
  double macro_wavenumber;          // q_m, inside of the band [1/m]
};

/// One pressure, velocity and background temperature.
struct HeatPoint {
  double pressure, velocity, temperature;
  double shift_factor;       // p_T
  double adhesion_per_area;  // mu_A over A/A0 at q1, 0 without
};

/// theta -> F(theta), the rise at the grid's temperature points [K], with its Jacobian and what is known on the way.
class FlashMap {
 public:
  FlashMap(const HeatScene& scene, const HeatGrid& grid);
  void start(const HeatPoint& point);
  /// A pass; theta at the temperature points [K].
  void operator()(const Eigen::VectorXd& theta);

  [[nodiscard]] const HeatGrid& grid() const { return grid_; }
  [[nodiscard]] const Eigen::VectorXd& rise() const { return rise_; }          // F
  [[nodiscard]] const Eigen::MatrixXd& jacobian() const { return jacobian_; }  // dF_i / dtheta_j
  [[nodiscard]] double hysteresis() const { return hysteresis_; }
  [[nodiscard]] double contact_area() const { return area_; }
  [[nodiscard]] double adhesion() const { return area_ * point_.adhesion_per_area; }
  [[nodiscard]] double macro_area() const { return macro_area_; }
  [[nodiscard]] const Eigen::RowVectorXd& slope_of_mu() const { return slope_of_mu_; }  // d(mu_H + mu_A) / dtheta
  /// Reduced frequencies v q a_T(T(q)) at the nodes [rad/s], and the temperatures there [K].
  [[nodiscard]] const std::vector<double>& reduced_frequency() const { return reduced_; }
  [[nodiscard]] const Eigen::VectorXd& temperature() const { return temperature_; }
  /// Heat f of the nodes, with which the rise is sum_j f_j g(q, q_j) where it is steady [K/s], and that of the surface
  /// [K m/s], which makes the rise times 2 q t N.
  [[nodiscard]] Eigen::VectorXd heat_of_nodes() const;
  [[nodiscard]] double heat_of_surface() const;
  /// The parts R_j m_j of mu_H that the nodes have.
  [[nodiscard]] std::vector<double> contributions() const;
  /// G at the lower end of a panel and at u in [-1, 1] on it.
  [[nodiscard]] double g_on(std::size_t panel, double u) const;
  /// v q a_T at a temperature.
  [[nodiscard]] double reduced_frequency(double wavenumber, double temperature) const;

 private:
  void frequencies(const Eigen::VectorXd& theta);
  void contact();
  void measure();
  void heat();

  const HeatScene& scene_;
  const HeatGrid& grid_;
  ContactIntegral contact_;
  AngularSlopes angular_;
  AreaG area_g_;
  std::optional<SFunction> inside_;
  std::size_t macro_panels_;
  HeatPoint point_{};
  double scale_ = 0, mu_factor_ = 0, per_flux_ = 0;  // per_flux_: v sigma0 / (rho c_v) [K/s m]

  Eigen::MatrixXd kernel_;   // q_j g_ij, and a last row of ones
  Eigen::VectorXd surface_;  // 2 q t N at the temperature points
  std::vector<double> reduced_;
  Eigen::VectorXd temperature_, rate_;  // rate_: d ln a_T / dT at the nodes
  AngularColumns columns_;
  Eigen::VectorXd ratio_, dg_, g_, f_, share_, measure_;
  std::vector<double> g_edge_, f_edge_, share_edge_;  // at the ends of panels, the first at G = 0
  Eigen::VectorXd rise_, hysteresis_rise_;
  Eigen::MatrixXd jacobian_;
  Eigen::RowVectorXd slope_of_mu_;
  double hysteresis_ = 0, area_ = 0, macro_area_ = 1;
};

}  // namespace asperity
