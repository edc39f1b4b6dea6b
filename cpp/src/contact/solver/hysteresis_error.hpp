// The error of a panel's hysteresis.
#pragma once

#include "contact/solver/panels.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

/// F on a panel at one pressure, and what its value was summed from: int F dR, or by parts once more int F2 d(dR/dG).
struct OnPanel {
  bool twice;
  double g_lower, g_upper, f_upper, f2_upper;  // at its ends
  double rise;                                 // of F over the panel
  double g[LegendreRule::most], f[LegendreRule::most],
      f2[LegendreRule::most];  // at the nodes; F less that at the lower end
  double first_slope;          // weight times derivative, of what is differentiated, at the first node
  double by_g[LegendreRule::tails], by_r[LegendreRule::tails];
  PanelSums sums;
};

/// Three errors add up: what the coefficients of dG and R after the last ones do to the value; that of the rule on F
/// dR, as F may be rougher than either; and the foot of a front. `scale` takes dG to the pressure, `gamma` is that of
/// S.
double hysteresis_error(const Panel& panel, const OnPanel& at, double scale, double gamma);

}  // namespace asperity
