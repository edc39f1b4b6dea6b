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
  /// Over the band at some root: R dG times 1, I1 / I2, or the part of it from outside of the measured range.
  enum class Of { variance, friction, outside };
  [[nodiscard]] Integral over_band(const ContactSums& root, Of of, std::vector<double>* by_panel) const;
  [[nodiscard]] Integral beyond(double lower, double upper, Of of) const;

  std::span<const Segment> surface_;
  const Rubber& rubber_;
  const ContactModel& model_;
  std::span<const double> stops_;
  RoughnessWindow window_;
  Adaptive rule_;
  double stiffening_, g_factor_ = 0, mu_factor_ = 0, velocity_ = 0;
  RoughnessEnd end_;          // at unit load
  double window_at_end_ = 0;  // of it, at the load
  std::vector<double> stop_wavenumbers_;
  std::optional<GslSolver> g_;
  std::vector<double> by_panel_;
};

}  // namespace asperity
