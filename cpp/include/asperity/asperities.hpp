// Single-scale asperity contact: Hertz, Greenwood-Williamson and its improved form (Eqs 14, 16-20).
#pragma once

#include <span>

#include "asperity/errors.hpp"
#include "asperity/export.hpp"

namespace asperity {

/// Penetration of one sphere, delta = (9 F^2 / (16 E*^2 R))^(1/3) [m]; Eq. 14 with the square it lost in print.
ASPERITY_EXPORT double hertz_penetration(double force, double effective_modulus, double radius);

/// How Eqs 19 and 20 are read. implicit: Eq. 20 is solved for the effective separation d~, so that the
/// interaction cancels and d = d~ - sigma0 sqrt(A_a) / E*. added: d is Greenwood-Williamson's, and
/// d~ = d + sigma0 sqrt(A_a) / E*, which turns upward again at high load on soft rubber.
enum class Reading { implicit, added };

/// Macro-asperities: n_a = q0^2 / (2 pi^2 sqrt 3) a unit area, of radius R = 1 / (q0^2 sqrt 2 h_rms), their
/// heights Gaussian of rms h_rms or given.
struct MacroAsperities {
  double rms_height;                   // h_rms [m]
  double q0;                           // [1/m]
  std::span<const double> peaks = {};  // heights [m] above the mean plane; empty: Gaussian
};

struct Separation {
  double effective;  // d~ [m] above the mean plane
  double rigid;      // d [m]
};

ASPERITY_EXPORT Separation separation(const MacroAsperities& asperities, double pressure, double effective_modulus,
                                      Reading reading = Reading::implicit);

enum class ContactState { no_contact, partial, full };

/// The state of an effective separation on a profile between z_min and z_max.
ASPERITY_EXPORT ContactState contact_state(double effective_separation, double z_max, double z_min);

/// ln int_t^inf (x - t)^(3/2) exp(-x^2 / 2) / sqrt(2 pi) dx, the integral of Eq. 16 in units of the rms height.
ASPERITY_EXPORT double log_gaussian_moment(double t);

}  // namespace asperity
