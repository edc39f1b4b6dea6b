// Area and hysteresis by the rule of PartialContact, known part by part.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "contact/solver/panel_solver.hpp"
#include "contact/theory/partial_root.hpp"

namespace asperity {

/// Solves points of one surface and rubber.
class PartialProfileSolver {
 public:
  PartialProfileSolver() = default;
  PartialProfileSolver(const PartialProfileSolver&) = delete;
  PartialProfileSolver(PartialProfileSolver&&) = delete;
  PartialProfileSolver& operator=(const PartialProfileSolver&) = delete;
  PartialProfileSolver& operator=(PartialProfileSolver&&) = delete;
  virtual ~PartialProfileSolver() = default;

  /// A point; one at the velocity of the point before is cheap. NotConverged where the tolerance is not reached.
  virtual void solve(double pressure, double velocity) = 0;

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return hysteresis_; }
  [[nodiscard]] double kappa() const { return root_.kappa; }
  /// A / A0 at the end of the spectrum, and its relative error.
  [[nodiscard]] double area() const { return root_.share; }
  [[nodiscard]] double area_error() const { return area_error_; }
  /// G at the end of the spectrum, before kappa.
  [[nodiscard]] double g() const { return g1_; }
  /// R at a wavenumber of the band.
  [[nodiscard]] virtual double stress(double wavenumber) const = 0;
  /// dmu_H / dln q, beyond the end of the roughness with that of the edges.
  [[nodiscard]] virtual double hysteresis_density(double wavenumber) const = 0;
  /// Stretches of ln q in order, then those of the edges; their hysteresis sums to the whole.
  [[nodiscard]] virtual std::vector<PanelSolver::PanelShare> shares() const = 0;

 protected:
  ContactSums root_;
  PanelSolver::Hysteresis hysteresis_;
  double g1_ = 0, area_error_ = 0;
};

/// By the method of the model. Panels end at the frequencies `stops` [rad/s], which must outlive it, too.
std::unique_ptr<PartialProfileSolver> partial_profile_solver(std::span<const Segment> surface, const Rubber& rubber,
                                                             const ContactModel& model,
                                                             std::span<const double> stops = {});

/// R at a place of a band, and T beyond it: what the solvers share.
double partial_stress(const ContactSums& root, double g, double steepness);
/// What lies beyond the end q_e of the roughness, cut at those of the rising `stops` that lie there [1/m].
std::vector<std::array<double, 2>> tail_stretches(double q_e, std::span<const double> stops);
/// d mu_H / dln q of the edges at unit load and window roughness 1, at x = q / q_e; `frequency` is v q_e.
double partial_edges(const ContactSums& root, const Rubber& rubber, double frequency, double x);

}  // namespace asperity
