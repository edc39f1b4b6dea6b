// The rule of PartialContact by GSL's adaptive integration: slow, and independent of the panels that it checks.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/solver/gsl_solver.hpp"
#include "contact/solver/partial_solver.hpp"
#include "spectrum/roughness_window.hpp"

namespace asperity {

class GslPartialSolver : public PartialProfileSolver {
 public:
  GslPartialSolver(std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model,
                   std::span<const double> stops);

  void solve(double pressure, double velocity) override;
  [[nodiscard]] double stress(double wavenumber) const override;
  [[nodiscard]] double hysteresis_density(double wavenumber) const override;
  [[nodiscard]] std::vector<PanelSolver::PanelShare> shares() const override;

 private:
  /// Of a function f(R, dG / d ln q, I1 / I2 or I1 outside / I2) over the band at some root.
  enum class Of { variance, friction, outside };
  [[nodiscard]] Integral over_band(const PartialRoot& root, Of of, std::vector<double>* by_panel) const;
  [[nodiscard]] Integral beyond(double lower, double upper, Of of) const;

  std::span<const Segment> surface_;
  const Rubber& rubber_;
  const ContactModel& model_;
  std::span<const double> stops_;
  RoughnessWindow window_;
  Adaptive rule_;
  double g_factor_ = 0, mu_factor_ = 0, velocity_ = 0;
  std::vector<double> stop_wavenumbers_;
  std::optional<GslSolver> g_;
  std::vector<double> by_panel_;
};

}  // namespace asperity
