// The rule of PartialContact on Gauss-Legendre panels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/solver/partial_panels.hpp"
#include "contact/solver/partial_solver.hpp"

namespace asperity {

class PartialPanelSolver : public PartialProfileSolver {
 public:
  PartialPanelSolver(std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model,
                     std::span<const double> stops);

  void solve(double pressure, double velocity) override;
  [[nodiscard]] double stress(double wavenumber) const override;
  [[nodiscard]] double hysteresis_density(double wavenumber) const override;
  [[nodiscard]] std::vector<PanelSolver::PanelShare> shares() const override;

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
  const Rubber& rubber_;
  PartialPanels panels_;
  Edges tail_;
  double stiffening_, rtol_, velocity_ = 0;
  std::span<const double> stops_;
  std::vector<double> stop_wavenumbers_;
  PartialEnd end_;  // at unit load
  double scale_ = 0, mu_factor_ = 0;
  std::vector<ActivePanel> active_, next_;
  std::vector<double> g_, steepness_, weight_, ratio_, stress_;
};

}  // namespace asperity
