// Where the heat of sliding is integrated, and where its temperature is an unknown.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "numerics/gauss_legendre.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// Gauss-Legendre panels in t = sqrt(ln(q / q0)), in which the square root that F(G) has behind the front is smooth,
/// and Chebyshev's points in ln q, both ends among them, for the temperature, which is analytic within pi of the real
/// axis.
class HeatGrid {
 public:
  struct Panel {
    const LegendreRule* rule;
    std::size_t first;    // of its nodes
    double lower, upper;  // in t
    double end;           // q at the upper end [1/m]
    const Segment* segment;
  };

  /// Panels end at `stops` [1/m] too. A level more is two digits more; with knots in the rubber panels are shorter.
  HeatGrid(std::span<const Segment> surface, double poisson_ratio, std::span<const double> stops, std::size_t level,
           bool tabulated);

  [[nodiscard]] std::size_t size() const { return wavenumber_.size(); }
  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }  // [1/m], of the nodes
  /// dG/du at I2 = 1 and unit pressure, u from -1 to 1 on a panel.
  [[nodiscard]] const std::vector<double>& roughness() const { return roughness_; }
  /// Points of the temperature [1/m], rising from q0 to q1.
  [[nodiscard]] const std::vector<double>& temperature_points() const { return points_; }
  /// From values at those points to values at the nodes.
  [[nodiscard]] const Eigen::MatrixXd& to_nodes() const { return to_nodes_; }
  /// The row that takes values at the points to that at a wavenumber.
  [[nodiscard]] Eigen::RowVectorXd row_at(double wavenumber) const;
  /// The number of panels below a wavenumber, which must be the end of one.
  [[nodiscard]] std::size_t panels_below(double wavenumber) const;
  /// q at t.
  [[nodiscard]] double wavenumber_at(double t) const;
  [[nodiscard]] double t_at(double wavenumber) const;

 private:
  void add_front(const Segment& segment, double upper, double end, std::size_t level, bool tabulated);
  void add_panel(const Segment& segment, double lower, double upper, double end, std::size_t nodes);

  double g_factor_, start_;  // ln q where the roughness begins
  double lowest_, highest_;  // ln q0, ln q1
  std::vector<Panel> panels_;
  std::vector<double> wavenumber_, roughness_, points_, log_points_;
  Eigen::MatrixXd to_nodes_;
};

/// int l_j du from -1 to u, l_j the polynomial that is 1 at node j of the rule.
void integrals_to(const LegendreRule& rule, double u, double* weights);

}  // namespace asperity
