// Corrections for partial contact, side by side: the S factor and the affine shifts p_T (Eqs 8-11, 13, 21).
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "asperity/asperities.hpp"
#include "asperity/export.hpp"
#include "asperity/rubber.hpp"
#include "asperity/scan_contact.hpp"
#include "asperity/spectrum.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// Persson 2001 as it stands.
struct NoCorrection {
  bool operator==(const NoCorrection&) const = default;
};

/// S = gamma + (1 - gamma) P^2 (Eq. 8). On the friction: a factor of the integrand of Eq. 22, with the
/// uncorrected P. On the area: inside G, int_0^G dg / S(P(g)) = G_uncorrected, for the area and the adhesion.
struct SFactor {
  enum class AppliesTo { friction, area, both };
  double gamma = 0.5;
  AppliesTo applies_to = AppliesTo::friction;
  bool operator==(const SFactor&) const = default;
};

/// S inside G that knows the width of the spectrum's band, for the area and the adhesion: S = gamma + 0.29 sqrt(P) +
/// (0.71 - gamma) P^13, gamma = 0.63 (1 - 0.50 alpha^(-1/4)), alpha Nayak's parameter up to the wavenumber at which the
/// area is asked for; fitted to boundary-element contacts. On the friction the S of Eq. 8 with `friction_gamma` and the
/// uncorrected P.
struct NayakSFactor {
  double friction_gamma = 0.40;
  bool operator==(const NayakSFactor&) const = default;
};

/// P = erf(1 / (2 sqrt(G (gamma + (1 - gamma) P)))), implicit in P, for the area and the adhesion; Eq. 22 is left
/// alone. With form = interpolated the P of that form at the same G.
struct ImplicitSFactor {
  double gamma = 0.45;
  bool operator==(const ImplicitSFactor&) const = default;
};

/// This project's own rule, made on exact sliding contacts: area and friction from one sum rule over the stress of all
/// waves, which knows that the pressure varies by as much as the stress does. With G, I1 and I2 of Persson's theory,
/// A(q) = erf(1 / (2 sqrt(kappa G))) and A1 that at q1: the integrand of Eq. 22 is multiplied by R = A / (1 + Z)^2,
/// Z = Q A^2 g', g' = K I2 w = dG / d ln q with the mean w of q^4 C over two units of ln q, and edges of contacts carry
/// T = 3.55 A1 (1 - A1^(1/4)) K I2(v q_e) w_e max(1, 0.1 / rho) (I2(v q) / I2(v q_e))^1.25 (q_e / q)^3 from q_e to 33
/// q_e, ln q_e the mean of ln q over the last tenth of M = int q^3 C dq, w_e w(q_e) or M / 20 if that is more, rho = K
/// I2(v q_e) M / G(q1). kappa is such that 2 (int R dG + int T d ln q) is B times the variance of Persson's pressure
/// over sigma0^2. Q = 0.67 (4 w_e / M)^0.2 kappa^(1/4) (1 - A1)^(1/8) (1 + 6.3 (1 - A1^(1/10))^3), B = 1 + (0.105 A1 +
/// 0.45 max(0, 1 - 1 / rho)^4) (1 - A1^8). The area is A1. Exact form only.
struct PartialContact {
  bool operator==(const PartialContact&) const = default;
};

/// C -> C / p^2 (Eq. 11) with a given p >= 1.
struct AffineShift {
  double p;
  bool operator==(const AffineShift&) const = default;
};

/// p_T1 = z_max / (z_max - <h_peaks>) (Eq. 13).
struct LocalPeaks {
  std::vector<double> heights;       // of the peaks, above the mean plane [m]
  std::optional<double> z_max = {};  // highest point of the profile [m]; unset: the highest peak
  bool operator==(const LocalPeaks&) const = default;
};

/// p_T2 = (z_max - z_min) / (z_max - d~) (Eq. 21 as its text says), d~ of the improved Greenwood-Williamson
/// model at E* = |E(q0 v)| / (1 - nu^2). z_max, z_min are the height profile's own, R and n_a those of
/// MacroAsperities; `peaks`, where given, stand in for the Gaussian heights (Section 3.2).
struct GreenwoodWilliamson {
  double z_max, z_min;             // [m] about the mean plane
  std::vector<double> peaks = {};  // [m]
  Reading reading = Reading::implicit;
  std::optional<double> rms_height = {}, q0 = {};  // of the macro-asperities; unset: the spectrum's, q0 its roll-off
  bool operator==(const GreenwoodWilliamson&) const = default;
};

/// The article's Conclusions: the profile is shifted by p_T1 first, and Greenwood-Williamson runs on what
/// results, whose z_max, z_min and rms height are those of the profile divided by p_T1; p_T = p_T1 p_T2.
struct PeaksThenGreenwoodWilliamson {
  LocalPeaks peaks;
  double z_max, z_min;
  Reading reading = Reading::implicit;
  std::optional<double> rms_height = {}, q0 = {};
  bool operator==(const PeaksThenGreenwoodWilliamson&) const = default;
};

using Correction = std::variant<NoCorrection, SFactor, NayakSFactor, AffineShift, LocalPeaks, GreenwoodWilliamson,
                                PeaksThenGreenwoodWilliamson, PartialContact, ScanContact, ImplicitSFactor>;

ASPERITY_EXPORT void validate(const Correction& correction);

/// p_T1 of Eq. 13.
ASPERITY_EXPORT double shift_factor(const LocalPeaks& peaks);

/// An affine shift at one velocity and pressure.
struct Shift {
  double p = 1;                                // infinite without contact
  double relative_error = 0;                   // of p
  ContactState state = ContactState::partial;  // always partial where no Greenwood-Williamson model is asked
  double separation_over_rms = 0;              // d~ / h_rms, beyond 3 the model has left its range
};
/// The p_T that `correction` sets; 1 for those that shift nothing.
ASPERITY_EXPORT Shift affine_shift(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber,
                                   double pressure, double velocity, double poisson_ratio);

}  // namespace asperity
