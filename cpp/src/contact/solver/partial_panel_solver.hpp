// Area and hysteresis by the rule of PartialContact on Gauss-Legendre panels, known part by part.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/solver/panel_solver.hpp"
#include "contact/solver/partial_panels.hpp"
#include "contact/theory/partial_root.hpp"

namespace asperity {

/// Points of one surface and rubber.
class PartialPanelSolver {
 public:
  /// Panels end at the frequencies `stops` [rad/s] too, which must outlive it.
  PartialPanelSolver(std::span<const Segment> surface, const Excitation& waves, const ContactModel& model,
                     std::span<const double> stops);

  /// A point; one at the velocity of the point before is cheap. NotConverged where the tolerance is not reached.
  void solve(double pressure, double velocity);

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return hysteresis_; }
  [[nodiscard]] double kappa() const { return root_.kappa; }
  /// A / A0 at the end of the spectrum, and its relative error.
  [[nodiscard]] double area() const { return root_.share; }
  [[nodiscard]] double area_error() const { return area_error_; }
  /// G at the end of the spectrum, before kappa.
  [[nodiscard]] double g() const { return g1_; }
  /// R at a wavenumber of the band.
  [[nodiscard]] double stress(double wavenumber) const;
  /// dmu_H / dln q, beyond the end of the roughness with that of the edges.
  [[nodiscard]] double hysteresis_density(double wavenumber) const;
  /// Stretches of ln q in order, then those of the edges; their hysteresis sums to the whole.
  [[nodiscard]] std::vector<PanelSolver::PanelShare> shares() const;

 private:
  struct ActivePanel {
    std::size_t panel;
    double g_lower = 0;                           // G at its lower end, at unit load
    double variance_by_g = 0, friction_by_g = 0;  // relative errors of both sums that an error of G brings on it
    double error = 0;                             // its part of the relative error of mu_H or the area
  };
  void start(double velocity);
  void gather();
  double judge();
  void refine(double allowed);
  [[nodiscard]] const ActivePanel& panel_at(double wavenumber) const;
  [[nodiscard]] double g_at(double wavenumber) const;

  std::span<const Segment> surface_;
  const Excitation& waves_;
  PartialPanels panels_;
  Edges tail_;
  double stiffening_, rtol_, velocity_ = 0;
  std::span<const double> stops_;
  std::vector<double> stop_wavenumbers_;
  ContactSums root_;
  PanelSolver::Hysteresis hysteresis_;
  double g1_ = 0, area_error_ = 0;
  PartialEnd end_;  // at unit load
  double scale_ = 0, mu_factor_ = 0;
  std::vector<ActivePanel> active_, next_;
  std::vector<double> g_, steepness_, weight_, ratio_, stress_;
};

}  // namespace asperity
