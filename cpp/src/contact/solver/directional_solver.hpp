// Area, hysteresis and the force across of a directional spectrum, as sums over its harmonics.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "contact/grid/directions.hpp"
#include "contact/grid/grid.hpp"
#include "contact/grid/roughness_pieces.hpp"
#include "contact/solver/panel_solver.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

/// Two levels of pieces of rings solve a point, as LevelSolver does for spectra that are means over directions; the
/// difference of both tells the error.
class DirectionalSolver {
 public:
  static constexpr double least_rtol = 1e-7;

  /// `spectrum` has rows with harmonics; all of them must outlive it.
  DirectionalSolver(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model);

  /// A point; one at the velocity of the point before is cheap. NotConverged where the tolerance is not reached.
  void solve(double pressure, double velocity, double shift);

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return hysteresis_; }
  [[nodiscard]] const ContactSums& sums() const { return sums_; }
  [[nodiscard]] double g() const { return g_; }  // at q1, before kappa
  [[nodiscard]] double relative_error() const { return error_; }

 private:
  struct Level {
    std::unique_ptr<ContactGrid> grid;
    std::unique_ptr<Theory> theory;
    Directions::Rings rings;
    double velocity = 0;
    std::vector<double> frequency, i1, i2, across, i1_outside;
  };
  void begin(double velocity);
  Level& at_velocity(std::size_t number);
  void take_moduli(Level& level, bool first);
  void take_edges(const RoughnessPieces& pieces);
  [[nodiscard]] double lateral(const Level& level, const ContactSums& sums, double scale) const;
  [[nodiscard]] double outside(const Level& level, const ContactSums& sums) const;

  const Spectrum& spectrum_;
  const TabulatedSpectrum& table_;
  const Rubber& rubber_;
  std::optional<Rubber> unlimited_;  // instead of it: a series without the range that it was fitted on
  const ContactModel& model_;
  double stiffening_;
  bool with_edges_;  // PartialContact
  Directions directions_;
  std::array<Level, RoughnessPieces::levels_with_rows> levels_;
  double velocity_ = 0;
  std::size_t used_ = 0;  // harmonics
  double rest_ = 0;       // what the others may have, relative
  EdgeIntegrals edges_;
  double edges_across_ = 0;
  AngularHarmonics at_points_;  // of cells
  std::vector<double> loss_, square_, points_;
  ContactSums sums_;
  PanelSolver::Hysteresis hysteresis_;
  double g_ = 0, error_ = 0;
};

}  // namespace asperity
