// Area and hysteresis of a measured spectrum on levels of nodes, at the cost of a smooth one.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "contact/grid/grid.hpp"
#include "contact/grid/roughness_pieces.hpp"
#include "contact/solver/panel_solver.hpp"
#include "contact/theory/edges.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

/// One theory of the contact on pieces of rings, with a rubber of one temperature. Two levels solve each point: the
/// coarser one starts the root of the finer one, and the difference of both tells the error.
class LevelSolver {
 public:
  /// Tables of fewer rows are as quick on panels, and lesser tolerances not reached.
  static constexpr std::size_t least_rows = 8;
  static constexpr double least_rtol = 1e-7;
  /// Whether tables like this one are solved on levels.
  static bool serves(const Spectrum& spectrum, const ContactModel& model);

  /// `spectrum` is one that it serves; all of them must outlive it.
  LevelSolver(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model);

  /// A point; one at the velocity of the point before is cheap. False where the tolerance is not reached.
  [[nodiscard]] bool solve(double pressure, double velocity, double shift);

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return hysteresis_; }
  [[nodiscard]] const ContactSums& sums() const { return sums_; }
  /// G at the end of the spectrum, before kappa; the relative error of it and of the area, which PartialContact has
  /// among its sums.
  [[nodiscard]] double g() const { return g_; }
  /// The share of friction from beyond a wavenumber [1/m], all of the edges' or nothing.
  [[nodiscard]] double share_beyond(double wavenumber) const;
  [[nodiscard]] double relative_error() const { return error_; }

 private:
  struct Level {
    const RoughnessPieces* pieces = nullptr;
    std::unique_ptr<const RoughnessPieces> cut;  // where the waves' factors have kinks
    std::unique_ptr<ContactGrid> grid;
    std::unique_ptr<Theory> theory;
    std::vector<std::array<Eigen::Index, 2>> common_ends;  // of pieces of the level before, and of this one
    std::vector<ModulusFactors> factors;                   // none where all are 1
    double velocity = 0;
    std::vector<double> frequency, i1, i2;
    std::vector<double> i1_outside;  // of unmeasured frequencies; of a Prony series on the coarsest level alone
  };
  Level& at_velocity(std::size_t number, double velocity);
  void take_moduli(Level& level, double velocity);
  static void take_common_ends(Level& fine, const Level& coarse);
  [[nodiscard]] static double apart(const Level& coarse, const Level& fine);
  [[nodiscard]] double beside_knots(const Level& level, const ContactSums& sums);
  [[nodiscard]] double outside_share(const Level& level, const ContactSums& sums) const;

  const Spectrum& spectrum_;
  const TabulatedSpectrum& table_;
  const Rubber& rubber_;
  const ContactModel& model_;
  double stiffening_;
  bool with_edges_;  // PartialContact
  std::array<Level, RoughnessPieces::levels> levels_;
  double velocity_ = 0;
  Excitation waves_;
  Edges edges_of_;
  EdgeIntegrals edges_;
  std::optional<Rubber> analytic_;  // a Prony series, without the range that it was fitted on
  std::vector<double> frequency_, i1_, i2_, of_loss_, outside_at_points_;  // at the points of cells
  std::vector<double> at_nodes_;
  std::vector<double> of_i1_, of_i2_;  // what the rule misses of I1 and I2 at the nodes
  bool known_in_part_ = false, any_outside_ = false;
  ContactSums sums_;
  PanelSolver::Hysteresis hysteresis_;
  const Level* solved_ = nullptr;  // the finer of the last two
  double g_ = 0, error_ = 0;
};

}  // namespace asperity
