// The rule of PartialContact on a measured spectrum, at the cost of a smooth one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "contact/grid/roughness_pieces.hpp"
#include "contact/solver/partial_panel_solver.hpp"
#include "contact/solver/partial_solver.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

/// On the nodes of RoughnessPieces. Two levels of them solve each point: the coarser one starts the root of the finer
/// one, and the difference of both tells the error. Panels where the finest does not reach the tolerance.
class PartialRingSolver : public PartialSolver {
 public:
  /// Tables of fewer rows are as quick on panels, and lesser tolerances not reached.
  static constexpr std::size_t least_rows = 8;
  static constexpr double least_rtol = 1e-7;

  PartialRingSolver(const TabulatedSpectrum& table, std::span<const Segment> surface, const Rubber& rubber,
                    const ContactModel& model);

  void solve(double pressure, double velocity) override;

 private:
  struct Level {
    const RoughnessPieces* pieces = nullptr;
    double velocity = 0;
    PartialEnd end;  // at unit load
    std::vector<double> frequency, i1, i2, g, steepness, weight, ratio, stress;
  };
  Level& at_velocity(std::size_t level, double velocity);
  void take_moduli(Level& level, double velocity);
  [[nodiscard]] double beside_knots(const Level& level, const PartialRoot& root) const;
  [[nodiscard]] double outside_share(const Level& level, const PartialRoot& root) const;
  [[nodiscard]] PartialRoot root(Level& level, double scale, double start) const;
  void by_panels(double pressure, double velocity);

  const TabulatedSpectrum& table_;
  std::span<const Segment> surface_;
  const Rubber& rubber_;
  const ContactModel& model_;
  double stiffening_;
  RoughnessEnd end_;
  std::array<Level, RoughnessPieces::levels> levels_;
  double velocity_ = 0;
  PartialTail tail_of_;
  TailIntegrals tail_;
  std::optional<Rubber> analytic_;  // a Prony series, without the range that it was fitted on
  std::vector<double> frequency_, i1_, i2_, outside_at_points_;  // at the points of cells
  std::vector<double> i1_outside_;                               // at the nodes of the coarsest level, to a hundredth
  bool known_in_part_ = false, any_outside_ = false;
  std::optional<PartialPanelSolver> panels_;
};

}  // namespace asperity
