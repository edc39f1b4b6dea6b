// The parts of G and of the hysteresis that depend on the velocity alone, on Gauss-Legendre panels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"
#include "numerics/gauss_legendre.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// On s = ln(q / a) of a segment that starts at a: dG/ds = q^4 C I2(v q) / (8 (1 - nu^2)^2) at unit pressure, and
/// R = I1 / I2, which is smooth wherever the rubber is. The variable of a panel is t with s = start + linear t +
/// square t^2: the square root that F(G) has behind a front is smooth in it, and so is R above a knot of a table.
struct Panel {
  /// Rows of numbers at the nodes: q [1/m]; dG/du at I2 = 1, u from -1 to 1; int dG up to the node; weight times dR/du;
  /// weight times d(dR/dG)/du; weight times d(I1 outside / I2)/du. The first two know no velocity.
  enum Row : std::size_t { wavenumber, roughness, cumulative, slope, curvature, outside_slope, rows };

  const Segment* segment;
  double start, linear, square;
  double lower, upper;  // in t
  bool at_front;        // G is 0 at its lower end
  bool sqrt_endpoint;   // s - start = t^2 and dG/ds is not 0 there: sqrt(G - G at start) is smooth in t
  bool grows;           // G grows several times over the panel, as far as the roughness tells
  bool tabulated;       // R has knots
  bool by_parts_twice;  // at a front where dR/dG is smooth: not on a ramp from zero, nor with a table, whose last
                        // digits differences would enlarge
  const LegendreRule* rule;
  double decay;            // at which coefficients of dG and R fall at least, from one degree to the next
  double decay_to_n;       // decay over as many degrees as there are nodes
  std::size_t data = 0;    // where its rows start
  std::size_t child = 0;   // the first of two, 0 where it was not split
  std::size_t filled = 0;  // the start that the numbers below belong to
  double g_total = 0, g_error = 0;
  double full = 0, full_error = 0, full_outside = 0;  // int R dG, the hysteresis where P S is 1
  double outside_lower = 0, outside_upper = 0;
  bool any_outside = false;
  double g_tail[LegendreRule::kept] = {};  // coefficients of dG
  /// A function differentiated: at the ends, int |d| of it, its last coefficients, and about that of twice their
  /// degree.
  struct Smooth {
    double lower, upper, change, far, tail[LegendreRule::kept];
  };
  Smooth r = {}, dr_dg = {};  // R, and dR/dG

  [[nodiscard]] double s(double t) const { return start + t * (linear + square * t); }
  [[nodiscard]] double t(double at) const;
};

/// The panels of one velocity: `roots` in order, some of them split. The numbers of a panel depend on its place alone,
/// so that no result depends on the questions asked before.
class Panels {
 public:
  Panels(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio, double rtol);
  /// Starts anew for a velocity; `stops` are wavenumbers [1/m] at which panels shall end too.
  void start(double velocity, std::span<const double> stops);

  [[nodiscard]] std::span<const std::size_t> roots() const { return roots_; }
  [[nodiscard]] const Panel& operator[](std::size_t panel) const { return panels_[panel]; }
  [[nodiscard]] const double* row(const Panel& panel, Panel::Row row) const {
    return &data_[panel.data + row * panel.rule->n];
  }
  /// The first of the two halves of a panel; the second follows it.
  [[nodiscard]] std::size_t children(std::size_t index);
  /// int dG from the panel's lower end to s.
  [[nodiscard]] double g_to(const Panel& panel, double s) const;
  [[nodiscard]] AngularIntegrals angular(double wavenumber) const { return waves_(velocity_ * wavenumber, wavenumber); }

 private:
  void lay_out(std::span<const double> stops);
  double lay_out(const Segment& segment, double knot, double end, double before, double here);
  void find_edges(const Segment& segment, bool front, std::span<const double> stops, std::span<const double> knots);
  std::size_t add(Panel panel);
  void roughness_at_nodes(const Panel& panel, double upper, double* wavenumber, double* roughness) const;
  void fill(Panel& panel);
  static void differentiate(const Panel& panel, const double* f, double* slope, Panel::Smooth& of);

  std::span<const Segment> surface_;
  const Excitation& waves_;
  double g_factor_, rtol_, velocity_ = 0;
  std::size_t starts_ = 0;
  bool laid_out_ = false;  // once for all velocities
  std::vector<std::size_t> roots_;
  std::vector<Panel> panels_;
  std::vector<double> data_, edges_;
};

}  // namespace asperity
