// Persson's G along the magnification and the hysteresis that follows from it, by GSL's adaptive integration.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"
#include "contact/theory/s_factor.hpp"
#include "numerics/adaptive_quadrature.hpp"

namespace asperity {

/// One velocity and one pressure on one surface, with s = ln(q / a) on each segment of it that starts at a:
///   dG/ds   = q^4 C I2(v q) / (8 ((1 - nu^2) sigma0 p_T)^2)                     (Eq. 7)
///   dmu_H/ds = q^4 C I1(v q) / (2 (1 - nu^2) sigma0 p_T^2) P(G) [S(P(G))]       (Eq. 22)
/// Panels end wherever the spectrum or the rubber changes its formula, are no longer than 1, and grow by factors of 4
/// from the front in which the contact breaks up: of width 1 / G'(0), or sqrt(2 / G''(0)) on a ramp from zero.
class GslSolver {
 public:
  struct Point {
    double poisson_ratio, pressure, velocity, shift;
  };
  /// `stops`: wavenumbers [1/m] at which panels shall end too. `resolve_front`: for integrals over P(G).
  /// `rule` computes all of them.
  GslSolver(std::span<const Segment> surface, const Excitation& waves, const Point& point,
            std::span<const double> stops, bool resolve_front, double rtol, Adaptive rule);

  /// G at a wavenumber, q0 to q1.
  [[nodiscard]] double g(double wavenumber) const;
  /// The relative error of every such G.
  [[nodiscard]] double relative_error() const { return relative_error_; }

  struct Hysteresis {
    double value = 0, error = 0;   // error of the outer integral alone
    double outside = 0;            // part of value from frequencies outside of the measured range
    std::vector<double> by_panel;  // sums to value
  };
  /// mu_H; `factor` puts S of the uncorrected P into the integrand.
  [[nodiscard]] Hysteresis hysteresis(Form form, const std::optional<SFunction>& factor) const;
  /// int weight(q) dmu_H.
  [[nodiscard]] Integral weighted_hysteresis(Form form, const std::optional<SFunction>& factor,
                                             const std::function<double(double)>& weight) const;
  /// dmu_H / dln q.
  [[nodiscard]] double hysteresis_density(double wavenumber, Form form, const std::optional<SFunction>& factor) const;
  /// How far in s the contact takes to break up from the start of a segment on.
  [[nodiscard]] double front(const Segment& segment) const;
  /// Lower and upper wavenumber of each panel.
  [[nodiscard]] std::vector<std::array<double, 2>> panels() const;

 private:
  struct Panel {
    const Segment* segment;
    double lower, upper;  // in s
    double g_lower;
  };
  [[nodiscard]] double g_rate(const Segment& segment, double s) const;
  void add_knots(const Segment& segment, std::span<const double> knots, std::vector<double>& edges) const;
  void add_segment(const Segment& segment, std::vector<double> edges);
  [[nodiscard]] double g_inside(const Panel& panel, double s) const;
  [[nodiscard]] double hysteresis_rate(const Panel& panel, double s, Form form, const std::optional<SFunction>& factor,
                                       double* outside) const;
  [[nodiscard]] const Panel& panel_at(double wavenumber) const;
  [[nodiscard]] bool reaches_outside(const Panel& panel) const;

  const Excitation& waves_;
  Point point_;
  Adaptive rule_;
  double rtol_, g_rtol_, g_factor_, mu_factor_;
  double g_error_ = 0, relative_error_ = 0;
  std::vector<Panel> panels_;
  double g_end_ = 0;
};

/// How far in ln q the contact takes to break up from q0 on.
double front_width(std::span<const Segment> surface, const Excitation& waves, const GslSolver::Point& point);

}  // namespace asperity
