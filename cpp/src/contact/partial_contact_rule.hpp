// The rule of PartialContact: how the stress of waves falls short of complete contact, on the band and beyond its end.
// With A(q) = erf(1 / (2 sqrt(kappa G(q)))) and A1 that at q1
//   R(q) = A / (1 + Z)^2,  Z = inside sqrt(1 - A1) A^2 g'(q)                 the stress on the band, of a complete contact
//   T(x) = beyond A1 (1 - A1)^1.5 g'(q1) (I2(v q) / I2(v q1)) x^-3          beyond it, x = q / q1 from 1 to tail_end
// where g' = dG / d ln q with q^4 C as its mean over a unit of ln q about q, as far as that lies on the band. kappa is
// the one at which the stress has the variance of Persson's pressure distribution, F(g) = int_0^g A dg:
//   int R dG + int T d ln x = F(kappa G(q1)).
// In complete contact R = 1, T = 0 and kappa = 1. The constants were fitted to the area and friction of exact sliding
// contacts; the form came from their stress spectra. F and G as in B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#pragma once

#include <cmath>
#include <numbers>

namespace asperity::partial_contact {

/// Fitted to 80 exact contacts of random-phase surfaces with 0.02 < A < 0.95 (tests/reference/sliding_contacts.csv).
inline constexpr double inside = 0.57, beyond = 0.80;
inline constexpr double tail_end = 33, tail_power = 3;
/// Half the length in ln q of the window about q.
inline constexpr double half_window = 0.5;

/// R of A and Z; partial_loops.inc has the same for many nodes.
inline double stress(double share, double obstacle) { return share / ((1 + obstacle) * (1 + obstacle)); }

/// A1 at g = kappa G(q1), 1 - A1 in its own digits, d A1 / d ln g, and F(g).
struct End {
  double share, rest, share_slope, integral;
  explicit End(double g) {
    const double s = 0.5 / std::sqrt(g), bell = std::exp(-s * s), root_pi = 1.7724538509055160273;
    rest = std::erfc(s);
    share = s < 0.5 ? std::erf(s) : 1 - rest;
    share_slope = -s * bell / root_pi;
    integral = s < 1 ? g * share + std::sqrt(g) * bell / root_pi - rest / 2
                     : g + (std::sqrt(g) * bell / root_pi - (0.5 + g) * rest);
  }
};

/// A factor, and the slope of its logarithm over ln kappa.
struct Factor {
  double value, log_slope;
};

/// Z / (A^2 g').
inline Factor obstacle(const End& at) {
  return {inside * std::sqrt(at.rest), at.rest > 0 ? -at.share_slope / (2 * at.rest) : 0};
}

/// T x^3 I2(v q1) / (g'(q1) I2(v q)).
inline Factor edges(const End& at) {
  return {beyond * at.share * at.rest * std::sqrt(at.rest),
          at.rest > 0 ? at.share_slope * (1 / at.share - 1.5 / at.rest) : 0};
}

}  // namespace asperity::partial_contact
