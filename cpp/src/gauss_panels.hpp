// What of G and of the hysteresis depends on the velocity alone, on Gauss-Legendre panels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"
#include "legendre.hpp"
#include "segments.hpp"

namespace asperity {

/// On s = ln(q / a) of a segment that starts at a: dG/ds = q^4 C I2(v q) / (8 (1 - nu^2)^2) at unit pressure, and
/// R = I1 / I2, which is smooth wherever the rubber is. The variable of a panel is t with s = start + linear t +
/// square t^2: the square root that F(G) has behind a front is smooth in it, and so is R above a knot of a table.
struct Panel {
  enum Row : std::size_t { cumulative, slope, outside_slope, rows };

  const Segment* segment;
  double start, linear, square;
  double lower, upper;  // in t
  bool at_front;        // G is 0 at its lower end
  const LegendreRule* rule;
  std::size_t data = 0;             // where its rows start: int dG to the nodes, weight times dR and dR_outside
  std::size_t child = 0;            // the first of two, 0 where it was not split
  double g_total = 0, g_error = 0;  // int dG and its error
  double g_slope = 0;               // dG/ds near the upper end
  double r_lower = 0, r_upper = 0;  // R at the ends
  double outside_lower = 0, outside_upper = 0;
  bool any_outside = false;
  double g_tail[LegendreRule::tails] = {}, r_tail[LegendreRule::tails] = {};  // last coefficients of dG and R

  [[nodiscard]] double s(double t) const { return start + t * (linear + square * t); }
  [[nodiscard]] double t(double s) const;
};

/// Error of the Gauss rule of n nodes, from the last Legendre coefficients of a function as large as `size`.
double gauss_error(const double* tail, double size, std::size_t n);

/// The panels of one velocity: `roots` in order, some of them split, down to where somebody asked. What a panel holds
/// depends on its place alone, so that no result depends on what was asked before.
class GaussPanels {
 public:
  GaussPanels(std::span<const Segment> surface, const Rubber& rubber, double poisson_ratio, double rtol);
  /// Starts anew for a velocity; `stops` are wavenumbers [1/m] at which panels shall end too.
  void start(double velocity, std::span<const double> stops);

  [[nodiscard]] std::span<const std::size_t> roots() const { return roots_; }
  [[nodiscard]] const Panel& operator[](std::size_t panel) const { return panels_[panel]; }
  [[nodiscard]] const double* row(const Panel& panel, Panel::Row row) const {
    return &data_[panel.data + row * panel.rule->n];
  }
  /// The first of the two halves of a panel; the second follows it.
  [[nodiscard]] std::size_t children(std::size_t panel);
  /// int dG from the panel's lower end to s.
  [[nodiscard]] double g_to(const Panel& panel, double s) const;
  [[nodiscard]] AngularIntegrals angular(double wavenumber) const {
    return angular_integrals(rubber_, velocity_ * wavenumber);
  }

 private:
  struct Nodes;
  void sample(const Panel& panel, double upper, Nodes& nodes) const;
  void fill(Panel& panel);
  std::size_t add(Panel panel);
  void find_edges(const Segment& segment, std::span<const double> stops, std::span<const double> knots);
  [[nodiscard]] std::size_t nodes_for(const Panel& panel) const;

  std::span<const Segment> surface_;
  const Rubber& rubber_;
  double g_factor_, rtol_, velocity_ = 0;
  std::vector<std::size_t> roots_;
  std::vector<Panel> panels_;
  std::vector<double> data_, edges_;
};

}  // namespace asperity
