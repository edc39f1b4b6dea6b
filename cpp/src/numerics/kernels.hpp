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

/// With z = sqrt(G), rest = 1 / (1 + z), F = int P S dG is z^2 rest U, with U smooth in rest on [0, 1]: polynomials in
/// u = `steps` rest - i about each i = 0 ... steps.
struct ContactTable {
  static constexpr std::size_t steps = 128, terms = 8;
  double powers[steps + 1][terms];
};

struct Kernels {
  /// I1 and I2 of a Prony series at n frequencies, n a multiple of `lanes`; no (w tau)^2 may overflow.
  void (*prony)(const PronyTerms& terms, const double* w, std::size_t n, double* i1, double* i2);
  /// The same with dI1/dln w and dI2/dln w; no (w tau)^3 may overflow.
  void (*prony_slopes)(const PronyTerms& terms, const double* w, std::size_t n, double* i1, double* i2, double* slope1,
                       double* slope2);
  /// The same with L_1 to L_count and K_1 to K_count (AngularHarmonics of asperity/rubber.hpp), a row each, `stride`
  /// behind each other.
  void (*prony_harmonics)(const PronyTerms& terms, const double* w, std::size_t n, std::size_t stride,
                          std::size_t count, double* i1, double* i2, double* loss, double* square);
  /// F at n values of G, n a multiple of `lanes`. Below 0 it goes on as it begins, with F = G.
  void (*contact_integral)(const ContactTable& table, const double* g, std::size_t n, double* f);
};

/// Those of this machine's vector units, or the lesser ones that the environment names: ASPERITY_VECTORS=baseline.
const Kernels& kernels();

}  // namespace asperity
