// The loops that the solver spends its time in, compiled for several vector units; which one runs is decided when the
// program does. All of them compute the same bits: sums have a fixed order, and no compiler may fuse or reorder.
#pragma once

#include <cstddef>

#include "legendre.hpp"

namespace asperity {

/// E_k, w_k and tau_k of a Prony series, and E_inf.
struct PronyTerms {
  const double *modulus, *weight, *time;
  std::size_t count;
  double equilibrium;
};

/// With z = sqrt(G), y = z / (1 + z), rest = 1 / (1 + z):
///   F  = z y (gamma U1 + (1 - gamma) rest U3)            F = int P S dG
///   F2 = z^3 y (gamma U1 + (1 - gamma) rest U3)          F2 = int F dG, with tables of its own
/// U of P and of P^3, smooth in y on [0, 1], as polynomials on equal steps of it.
struct FrontTable {
  static constexpr std::size_t steps = 128, terms = 8;
  using Steps = double[steps][terms];
  const Steps *one, *three;
  double gamma;
  bool second;  // F2
};

/// What a panel adds: sum of `slope` f, sum of |slope|; and, for each of the last Legendre coefficients, how much those
/// of dG and of R matter, and those of f.
struct PanelSums {
  double value, change;
  double by_g[LegendreRule::tails], by_r[LegendreRule::tails], f_tail[LegendreRule::kept];
};

struct Kernels {
  const char* name;
  /// I1 and I2 of a Prony series at n frequencies, n a multiple of 4; no (w tau)^2 may overflow.
  void (*prony)(const PronyTerms& terms, const double* w, std::size_t n, double* i1, double* i2);
  /// Integral of the polynomial through f, and its last coefficients.
  void (*add_up)(const LegendreRule& rule, const double* f, double* total, double* tail);
  /// Integral of the polynomial through f, to each node and over all, and its last coefficients.
  void (*integrate)(const LegendreRule& rule, const double* f, double* cumulative, double* total, double* tail);
  /// Weight times derivative of the polynomial through f, its ends, and its last coefficients.
  void (*differentiate)(const LegendreRule& rule, const double* f, double* slope, double* lower, double* upper,
                        double* tail);
  /// F or F2 at n values of G, n a multiple of 4.
  void (*front)(const FrontTable& table, const double* g, std::size_t n, double* f);
  /// f at the nodes with `slope`, and `passed`, how much a change of G matters at each.
  void (*sum)(const LegendreRule& rule, const double* slope, const double* f, const double* passed,
              PanelSums& sums);
};

/// Those of this machine's vector units, or the lesser ones that the environment names: ASPERITY_VECTORS=baseline.
const Kernels& kernels();

}  // namespace asperity
