// The errors of G and of the hysteresis on a Gauss-Legendre panel, estimated from the last Legendre coefficients known.
#pragma once

#include <cstddef>

#include "contact/solver/panels.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

/// The larger of coefficients k and k + 1 of a row of them, as one of a pair may vanish.
double larger(const double* tail, std::size_t k);

/// The part of the integral over a function as large as `size` that the rule of n nodes leaves out: its coefficients
/// from degree 2 n on, estimated from those half way to n and at n, to which the last ones fall by `decay` a degree.
/// ln(size / coefficient) grows with the degree like n for an analytic function, and by `growth` at most from n to 2 n.
double beyond_rule(double size, const double* tail, double decay, double growth);
inline constexpr double analytic = 2;

/// F on a panel at one pressure, and the sum that the panel's value is made of: int F dR, or by parts once more int F2
/// d(dR/dG).
struct OnPanel {
  bool by_parts_twice;
  double g_lower, g_upper, f_upper, f2_upper;  // at its ends
  double rise;                                 // of F over the panel
  double g[LegendreRule::most], f[LegendreRule::most],
      f2[LegendreRule::most];  // at the nodes; F less that at the lower end
  double first_slope;          // weight times derivative, of the function differentiated, at the first node
  double by_g[LegendreRule::tails], by_r[LegendreRule::tails];
  PanelSums sums;
};

/// Three errors add up: the effect on the value of the coefficients of dG and R after the last ones; the error of the
/// rule on F dR, as F may be rougher than either; and the foot of a front. `scale` takes dG to the pressure, `gamma` is
/// that of S.
double hysteresis_error(const Panel& panel, const OnPanel& at, double scale, double gamma);

}  // namespace asperity
