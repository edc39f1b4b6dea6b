// Persson's G and the hysteresis that follows from it by Gauss-Legendre panels, with an error of its own.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "contact/grid/grid.hpp"
#include "contact/solver/panels.hpp"
#include "contact/theory/contact_integral.hpp"

namespace asperity {

/// With R = I1 / I2 and F of `ContactIntegral` Eq. 22 reads, by parts,
///   mu_H = 4 (1 - nu^2) sigma0 int R dF = 4 (1 - nu^2) sigma0 (R F at q1 - int F dR),
/// where R does not know the front at all and pressure and shift only scale G.
class PanelSolver {
 public:
  PanelSolver(std::span<const Segment> surface, const Excitation& waves, double poisson_ratio, double rtol);

  /// A velocity, at which any number of points follow.
  void start(double velocity, std::span<const double> stops) { panels_.start(velocity, stops); }

  /// Solves for G, and for mu_H where `contact` is given. NotConverged where the tolerance is not reached.
  void solve(double pressure, double shift, const ContactIntegral* contact);

  struct Hysteresis {
    double value = 0, error = 0;
    double outside = 0;  // part of value from frequencies outside of the measured range
    double lateral = 0;  // the force across the sliding, over the load
  };
  [[nodiscard]] const Hysteresis& hysteresis() const { return hysteresis_; }
  /// G at a wavenumber, q0 to q1, and the relative error of every such G.
  [[nodiscard]] double g(double wavenumber) const;
  [[nodiscard]] double relative_error() const;
  /// dmu_H / dln q where P S is 1.
  [[nodiscard]] double full_density(double wavenumber) const;

  /// The panels in order; their hysteresis sums to the whole.
  [[nodiscard]] std::vector<ContactGrid::PanelSum> shares() const;

 private:
  struct ActivePanel {
    std::size_t panel;
    double g_lower = 0, g_part = 0;  // G at its lower end, at unit load; its own share of the relative error
    double value = 0, error = 0, outside = 0;
  };
  void evaluate(double scale, const ContactIntegral* contact);
  void add_hysteresis(std::size_t index, double scale, const ContactIntegral& contact);
  void refine(bool hysteresis_good, bool g_good);
  [[nodiscard]] const ActivePanel& panel_at(double wavenumber) const;

  Panels panels_;
  double stiffening_, rtol_;
  double scale_ = 0, mu_factor_ = 0, density_factor_ = 0, g_relative_error_ = 0;
  Hysteresis hysteresis_;
  std::vector<ActivePanel> active_, next_;
  struct Ends {
    std::vector<double> g, f, f2;
  } ends_;  // at the upper end of each active panel
};

}  // namespace asperity
