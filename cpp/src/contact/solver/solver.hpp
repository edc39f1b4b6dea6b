// Area and hysteresis at a point by the method asked for: levels of nodes, or GSL's adaptive integration as the
// independent check.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/solver/gsl_solver.hpp"
#include "contact/solver/level_solver.hpp"

namespace asperity {

class Solver {
 public:
  using Hysteresis = LevelSolver::Hysteresis;

  struct Options {
    bool hysteresis = true;              // or G alone
    bool parts = false;                  // what a wavenumber has is asked for too; else the surface is the whole one
    std::span<const double> stops = {};  // frequencies at which panels end too [rad/s], which must outlive the solver
  };
  /// `surface` is that of the spectrum, or a part of it from its lower end on.
  Solver(const Spectrum& spectrum, std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model,
         const Options& options);

  /// A point; one at the velocity of the point before is cheap. Errors of others take a part of the tolerance.
  /// NotConverged where it is not reached.
  void solve(double pressure, double velocity, double shift, double others = 0);

  [[nodiscard]] const Hysteresis& hysteresis() const { return levels_ ? levels_->hysteresis() : hysteresis_; }
  [[nodiscard]] double hysteresis_density(double wavenumber) const;  // dmu_H / dln q
  [[nodiscard]] double g(double wavenumber) const;
  /// Of every G; `hysteresis` has what that makes of it where the second holds.
  [[nodiscard]] double relative_error() const;
  [[nodiscard]] bool g_error_is_in_hysteresis() const { return levels_.has_value(); }
  /// Of PartialContact: kappa, A / A0 at the upper end of the spectrum with its relative error, and R at a wavenumber.
  [[nodiscard]] double kappa() const { return sums().kappa; }
  [[nodiscard]] double partial_area() const { return sums().share; }
  [[nodiscard]] double partial_area_error() const { return levels_->relative_error(); }
  [[nodiscard]] double stress(double wavenumber) const { return levels_->stress(wavenumber); }
  [[nodiscard]] std::vector<PanelSum> shares() const;
  /// Share of the hysteresis from strains beyond the last row of factors, to a hundredth.
  [[nodiscard]] double share_of_held_strains() const;

 private:
  [[nodiscard]] const ContactSums& sums() const { return levels_->sums(); }

  std::span<const Segment> surface_;
  const ContactModel& model_;
  Excitation waves_;
  std::optional<SFunction> factor_;
  Options options_;
  std::optional<LevelSolver> levels_;
  std::optional<GslSolver> gsl_solver_;  // of the point
  Hysteresis hysteresis_;                // by GSL, as its panels
  std::vector<double> by_panel_;
};

/// GSL's rule of that name.
Adaptive adaptive_rule(Method method);

/// The order in which points of one velocity follow each other.
std::vector<std::size_t> by_velocity(std::span<const double> velocity);

}  // namespace asperity
