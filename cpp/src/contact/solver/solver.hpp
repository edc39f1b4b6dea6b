// Area and hysteresis at a point by the method asked for: levels of pieces on the rings of a table, Gauss-Legendre
// panels elsewhere and where a result is wanted part by part, or GSL's adaptive integration as the independent check.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/solver/directional_solver.hpp"
#include "contact/solver/gsl_solver.hpp"
#include "contact/solver/level_solver.hpp"
#include "contact/solver/panel_solver.hpp"
#include "contact/solver/partial_panel_solver.hpp"

namespace asperity {

class Solver {
 public:
  using Hysteresis = PanelSolver::Hysteresis;

  /// Solves for G, and where `with_hysteresis` for mu_H with S by `factor`. Panels end at the frequencies `stops`
  /// [rad/s] too, which must outlive this.
  Solver(std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model, bool with_hysteresis,
         const std::optional<SFunction>& factor, std::span<const double> stops = {});

  /// Takes a table of rings in pieces where that holds: G is known at the upper end of the spectrum alone then, which
  /// the surface is to reach up to, and nothing part by part.
  void use_levels_of(const Spectrum& spectrum);

  /// A point; one at the velocity of the point before is cheap. NotConverged where the tolerance is not reached.
  void solve(double pressure, double velocity, double shift);

  [[nodiscard]] const Hysteresis& hysteresis() const {
    return directional_  ? directional_->hysteresis()
           : by_levels_  ? levels_->hysteresis()
           : partial_    ? partial_->hysteresis()
           : gsl_solver_ ? hysteresis_
                         : panel_solver_.hysteresis();
  }
  [[nodiscard]] double hysteresis_density(double wavenumber) const;  // dmu_H / dln q
  [[nodiscard]] double g(double wavenumber) const;
  /// Of every G; `hysteresis` has what that makes of it where the second holds.
  [[nodiscard]] double relative_error() const;
  [[nodiscard]] bool g_error_is_in_hysteresis() const { return directional_ || by_levels_ || partial_; }
  /// Of PartialContact: kappa, A / A0 at the upper end of the spectrum with its relative error, and R at a wavenumber.
  [[nodiscard]] double kappa() const {
    return directional_ ? directional_->sums().kappa : by_levels_ ? levels_->sums().kappa : partial_->kappa();
  }
  [[nodiscard]] double partial_area() const {
    return directional_ ? directional_->sums().share : by_levels_ ? levels_->sums().share : partial_->area();
  }
  [[nodiscard]] double partial_area_error() const {
    return directional_ ? directional_->relative_error()
           : by_levels_ ? levels_->relative_error()
                        : partial_->area_error();
  }
  [[nodiscard]] double stress(double wavenumber) const { return partial_->stress(wavenumber); }
  [[nodiscard]] std::vector<PanelSolver::PanelShare> shares() const;
  /// Share of the hysteresis from strains beyond the last row of factors, to a hundredth.
  [[nodiscard]] double share_of_held_strains() const;

 private:
  void start(double velocity);

  std::span<const Segment> surface_;
  const ContactModel& model_;
  Excitation waves_;
  std::optional<SFunction> factor_;
  std::optional<ContactIntegral> contact_;
  bool with_hysteresis_;
  PanelSolver panel_solver_;
  std::span<const double> stops_;
  double velocity_ = 0, panel_velocity_ = 0;      // of the point before, and of the last that panels were made for
  std::optional<DirectionalSolver> directional_;  // instead of all others
  std::optional<LevelSolver> levels_;
  bool by_levels_ = false;                     // the point
  std::optional<PartialPanelSolver> partial_;  // instead of panel_solver_
  std::vector<double> stop_wavenumbers_;
  std::optional<GslSolver> gsl_solver_;  // by GSL
  Hysteresis hysteresis_;
  std::vector<double> by_panel_;
};

/// GSL's rule of that name.
Adaptive adaptive_rule(Method method);

/// The order in which points of one velocity follow each other.
std::vector<std::size_t> by_velocity(std::span<const double> velocity);

}  // namespace asperity
