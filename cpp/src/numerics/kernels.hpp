// The loops that the solver spends its time in, compiled for several vector units; which one runs is decided when the
// program does. All of them compute the same bits: sums have a fixed order, and no compiler may fuse or reorder.
#pragma once

#include <cstddef>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

/// Numbers that the loops take at a time, whatever the vector unit; counts are multiples of it.
inline constexpr std::size_t lanes = 4;

/// E_k, w_k and tau_k of a Prony series, and E_inf.
struct PronyTerms {
  const double *modulus, *weight, *time;
  std::size_t count;
  double equilibrium;
};

/// With z = sqrt(G), rest = 1 / (1 + z):
///   F  = z^2 rest U, F = int P S dG,    F2 = z^4 rest V, F2 = int F dG
/// U and V are smooth in rest on [0, 1]: polynomials in u = `steps` rest - i about each i = 0 ... steps.
struct ContactTable {
  static constexpr std::size_t steps = 128, terms = 8;
  using Powers = double[steps + 1][terms];
  Powers first, second;  // U and V
};

/// The contribution of a panel: sum of `slope` f, and the last coefficients of f.
struct PanelSums {
  double value, tail[LegendreRule::kept];
};

struct Kernels {
  /// I1 and I2 of a Prony series at n frequencies, n a multiple of `lanes`; no (w tau)^2 may overflow.
  void (*prony)(const PronyTerms& terms, const double* w, std::size_t n, double* i1, double* i2);
  /// The same with dI1/dln w and dI2/dln w; no (w tau)^3 may overflow.
  void (*prony_slopes)(const PronyTerms& terms, const double* w, std::size_t n, double* i1, double* i2, double* slope1,
                       double* slope2);
  /// The same with L_1 to L_count and K_1 to K_count (AngularHarmonics of asperity/rubber.hpp), a row of n each.
  void (*prony_harmonics)(const PronyTerms& terms, const double* w, std::size_t n, std::size_t count, double* i1,
                          double* i2, double* loss, double* square);
  /// Integral of the polynomial through f, and its last coefficients.
  void (*add_up)(const LegendreRule& rule, const double* f, double* total, double* tail);
  /// Integral of the polynomial through f, to each node by `columns` of the rule and over all, and its last
  /// coefficients.
  void (*integrate)(const LegendreRule& rule, const double (*columns)[LegendreRule::most], const double* f,
                    double* cumulative, double* total, double* tail);
  /// Weight times derivative of the polynomial through f, its ends, and its last coefficients.
  void (*differentiate)(const LegendreRule& rule, const double* f, double* slope, double* lower, double* upper,
                        double* tail);
  /// G at n nodes: that at the lower end and `cumulative`, at unit load, times `scale`; 1e-300 where it would be 0. An
  /// interpolated G may be below 0 at the first nodes and stays so: its errors there are polynomials of high degree,
  /// which cancel in the sums over a panel. (All that passes from one loop to another is written by loops of one
  /// width.)
  void (*g_at_nodes)(double lower, const double* cumulative, double scale, std::size_t n, double* g);
  /// F, and F2 where there is room for it, at n values of G, n a multiple of `lanes`. Below 0 they go on as they begin,
  /// with F = G and F2 = G^2 / 2.
  void (*contact_integral)(const ContactTable& table, const double* g, std::size_t n, double* f, double* f2);
  /// A panel's part of the sum that its value is taken from, and the coefficients that tell the error of it.
  void (*sum)(const LegendreRule& rule, const double* slope, const double* f, PanelSums& sums);
  /// How much the last coefficients of dG and of R matter, F / G being a bound of P S. Takes f_lower from f: a constant
  /// falls out of all sums, and takes its rounding along.
  void (*error_projection)(const LegendreRule& rule, const double* slope, const double* g, double f_lower, double* f,
                           double* by_g, double* by_r);
};

/// Those of this machine's vector units, or the lesser ones that the environment names: ASPERITY_VECTORS=baseline.
const Kernels& kernels();

}  // namespace asperity
