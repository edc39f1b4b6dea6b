// The parts of PartialContact's integrals that depend on the velocity alone, on Gauss-Legendre panels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/partial_root.hpp"
#include "contact/theory/rule_error.hpp"
#include "numerics/gauss_legendre.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// On y = ln(q / qf), qf where roughness begins: dG/dy = q^4 C I2(v q) / (8 (1 - nu^2)^2) at unit pressure. Near qf the
/// variable of a panel is t = sqrt(y), in which A, a function of sqrt(G), is smooth; further on it is y.
struct PartialPanel {
  /// Rows of numbers at the nodes: q [1/m]; dG/du at I2 = 1, u from -1 to 1; dG/dy at I2 = 1 with the roughness of the
  /// window; then those of a velocity: dG/du; int dG up to the node; g'; I1 / I2; the part of it from outside of the
  /// measured range.
  enum Row : std::size_t { wavenumber, roughness, window, rate, cumulative, steepness, ratio, outside, rows };

  std::size_t segment;
  double lower, upper;  // in y
  bool root;            // t is the variable
  const LegendreRule* rule;
  std::size_t data = 0;    // where its rows start
  std::size_t child = 0;   // the first of two, 0 where it was not split
  std::size_t filled = 0;  // the start that the numbers below belong to
  double g_total = 0, g_error = 0;
  bool any_outside = false;
};

/// The panels of one velocity, `roots` in order. The numbers of a panel depend on its place alone, so that no result
/// depends on the questions asked before.
class PartialPanels {
 public:
  PartialPanels(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio, double rtol);
  /// Starts anew for a velocity; `stops` are wavenumbers [1/m] at which panels shall end too.
  void start(double velocity, std::span<const double> stops);

  [[nodiscard]] std::span<const std::size_t> roots() const { return roots_; }
  [[nodiscard]] const PartialPanel& operator[](std::size_t panel) const { return panels_[panel]; }
  [[nodiscard]] const double* row(const PartialPanel& panel, PartialPanel::Row row) const {
    return &data_[panel.data + row * panel.rule->n];
  }
  /// The first of the two halves of a panel; the second follows it.
  [[nodiscard]] std::size_t children(std::size_t index);
  /// The wavenumber at the end of the panel [1/m].
  [[nodiscard]] double wavenumber_at(double y) const;

  /// What one wavenumber has of a velocity: dG/dy, g' and I1 / I2.
  struct Place {
    double rate, steepness, ratio;
  };
  [[nodiscard]] Place at(double wavenumber) const;
  /// int dG from the panel's lower end to a wavenumber in it.
  [[nodiscard]] double g_to(const PartialPanel& panel, double wavenumber) const;
  [[nodiscard]] const RoughnessEnd& end() const { return end_; }
  [[nodiscard]] double y_of(double wavenumber) const;

 private:
  void lay_out(std::span<const double> stops);
  std::size_t add(PartialPanel panel);
  void nodes_of(const PartialPanel& panel, double upper, double* wavenumber, double* roughness) const;
  void fill(PartialPanel& panel);

  std::span<const Segment> surface_;
  const Excitation& waves_;
  RoughnessWindow window_;
  double g_factor_, velocity_ = 0;
  RoughnessEnd end_;
  std::size_t nodes_;
  double foot_ = 0;            // qf [1/m]
  std::vector<double> start_;  // of each segment, in y
  std::size_t starts_ = 0;
  bool laid_out_ = false;  // once for all velocities
  std::vector<std::size_t> roots_;
  std::vector<PartialPanel> panels_;
  std::vector<double> data_;
};

}  // namespace asperity
