// Friction with the heat that it makes, at points of pressure, velocity and temperature; and by a model of two
// temperatures, where its steady state seems to be the only one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "contact/grid/cell_sums.hpp"
#include "heat/fixed_point.hpp"
#include "heat/flash_map.hpp"

namespace asperity {

/// With one temperature T0 + tau for all roughness the contact depends on v a_T alone: what it is at a few values of
/// that serves all velocities of a curve. With F(tau) the rise at q1 that it makes, tau / F(tau) is the eps of the
/// march, but for the profile. Of that the macro-asperities count for most, as F goes as 1 / P_m: they have their own
/// temperature, T0 + tau theta(q_m) / theta(q1).
class UniformHeat {
 public:
  explicit UniformHeat(const HeatScene& scene) : scene_(scene) {}
  /// Another pressure or temperature, or another grid.
  void forget();
  /// The rise at which eps passes 1 [K]; none where it may do so more than once, by a margin for the profile, or not up
  /// to twice the highest rise. The map has to be at the point.
  std::optional<double> only_rise(FlashMap& map, const HeatPoint& point);

 private:
  struct Step {
    double rise, log_rise, log_a;  // tau, ln tau, ln a_T at T0 + tau
  };
  void take_steps(double background);

  const HeatScene& scene_;
  std::vector<Step> steps_;
  std::map<long, FlashMap::ContactHeat> contacts_;  // by ln(v a_T) in steps
};

/// The results at one point.
struct HotPoint {
  double hysteresis = 0, adhesion = 0, contact_area = 0;
  double error_estimate = 0;  // of mu
  double lateral = 0;
  double parts_error = 0;  // relative, of mu_H and of A / A0, the larger
  double extrapolated_share = 0;
  double temperature = 0;  // T(q1) [K]
  double macro_area = 0, gain = 0;
  int branches = 1;
  Shift shift;
  double g = 0;  // at q1
};

/// Solves each point on two grids, the second finer by two digits, and on finer ones until two agree; their difference
/// is the error of the coarser, and the finer is what is returned. Points follow each other from low to high velocity.
class FlashSolver {
 public:
  /// `stops`: wavenumbers [1/m] at which panels shall end too, for contributions.
  FlashSolver(const HeatScene& scene, Branch branch);
  HotPoint operator()(const HeatPoint& point);
  /// Ends panels at these wavenumbers [1/m] too, from the next point on.
  void set_stops(std::vector<double> stops);
  /// Forgets the point before, where a new curve begins.
  void forget();
  /// Passes on the grid of a level, two digits more for each.
  FlashMap& map_of(std::size_t level);

  /// The grid on which the last point was solved, with the rise at its temperature points [K].
  [[nodiscard]] FlashMap& finest_map() { return map_of(finest_); }
  /// The one before it, at its own solution.
  [[nodiscard]] FlashMap& coarser_map() { return map_of(finest_ - 1); }
  [[nodiscard]] const Eigen::VectorXd& rise() const { return theta_; }
  /// Of the last point: T(q) [K], dmu_H/dln q, and mu_H from each panel with its ends [1/m].
  [[nodiscard]] double temperature_at(double wavenumber) const;
  [[nodiscard]] double hysteresis_density(double wavenumber) const;
  [[nodiscard]] std::vector<PanelSum> shares() const;

 private:
  struct Level {
    std::unique_ptr<const RoughnessPieces> cut;  // where the waves' factors have kinks
    std::unique_ptr<HeatGrid> grid;
    std::unique_ptr<FlashMap> map;
    Eigen::MatrixXd up, down;  // between the level below and this one
  };
  /// Whether the modulus is one of measured rows.
  [[nodiscard]] bool has_rows() const { return std::holds_alternative<MasterCurve>(scene_.rubber); }
  [[nodiscard]] Eigen::VectorXd guess(double velocity) const;
  void begin_next_below();
  bool end_panel_where_held(const HeatPoint& point, const Eigen::VectorXd& theta);
  void check_temperatures(const FlashMap& map, const FixedPoint& found, const HeatPoint& point,
                          double in_doubt = 1e-12) const;

  const HeatScene& scene_;
  Branch branch_;
  std::optional<RoughnessWindow> window_;  // with PartialContact
  std::vector<double> kinks_, stops_;      // wavenumbers [1/m]
  std::optional<FrequencyRange> known_;
  std::optional<double> held_from_;  // [1/m]
  std::vector<Level> levels_;
  std::size_t first_level_ = 0, level_ = 0;  // of the coarser grid
  HeatPoint point_{};
  struct Solved {
    double velocity;
    std::size_t level;
    Eigen::VectorXd theta;
  };
  std::vector<Solved> before_;  // the last two on the coarser grid, rising in velocity
  Tangent tangent_;
  Eigen::VectorXd theta_;  // of the last point on the finest grid
  std::size_t finest_ = 0;
  UniformHeat uniform_;
  std::size_t uniform_level_ = 0;
};

/// q_m: as given, or 2 pi / diameter held to the band.
double macro_wavenumber(const Heating& heating, const Spectrum& spectrum);

}  // namespace asperity
