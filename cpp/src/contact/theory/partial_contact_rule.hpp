// The rule of PartialContact: how the stress of waves falls short of complete contact, on the band and beyond the end
// of its roughness. With K = 1 / (8 ((1 - nu^2) sigma0)^2), c = q^4 C, M = int c d ln q over the band, w(q) = (int c d
// ln q from q / e to e q) / 2, c being 0 off the band, ln q_e the mean of ln q over that last part of the band that has
// a tenth of M, rho = K I2(v q_e) M / G(q1), A(q) = erf(1 / (2 sqrt(kappa G(q)))) and A1 that at q1
//   R(q) = A / (1 + Z)^2, the stress on the band over that of complete contact, with
//     Z = obstacle (4 w_e / M)^0.2 kappa^(1/4) (1 - A1)^(1/8) (1 + light (1 - A1^(1/10))^3) A^2 g'(q),
//     g' = K I2(v q) w(q), w_e = max(w(q_e), M / 20), as if all of that tenth stood in one window;
//   T(x) = edges A1 (1 - A1^(1/4)) K I2(v q_e) w_e max(1, last / rho) (I2(v q) / I2(v q_e))^1.25 x^-3, that of
//     the edges of contacts, x = q / q_e from 1 to tail_end. Where roughness has directions spots are long: T is times
//     (h_r / h_c)^(crossed cos^2), the rms slopes along the ridges and across them, and the angle of sliding to the way
//     across them: who slides along the ridges crosses as many edges as on isotropic roughness. T and g' have the
//     harmonics of all roughness, which shapes the spots. Light contacts are less like ridges than the roughness is:
//     the force across has A^steering of R dG.
// kappa is the one at which the stress has the variance of Persson's pressure distribution, F(g) = int_0^g A dg, but
// for a factor near 1:
//   int R dG + int T d ln x = F(kappa G(q1)) (1 + (spread A1 + stiff max(0, 1 - 1 / rho)^4) (1 - A1^8)).
// last is that tenth. rho is below it where a rubber that stiffens meets faint waves beyond q_e that have nearly all of
// G, and w(q_e) below its share where q_e falls in a gap: without both limits the last equation has several roots
// there. In complete contact R = 1, T = 0 and kappa = 1. The form came from the stress spectra of exact sliding
// contacts, the numbers were fitted to their area and friction. F and G as in B. N. J. Persson, J. Chem. Phys. 115,
// 3840 (2001).
#pragma once

#include <cmath>

namespace asperity::partial_contact {

inline constexpr double last = 0.1;
inline constexpr double obstacle = 0.67, light = 6.3, edges = 3.55, spread = 0.105, stiff = 0.45;
inline constexpr double steering = 0.125;
/// Beyond q_e: where it ends, the power of x, and that of I2 beside the one in G.
inline constexpr double tail_end = 33, tail_power = 3, tail_excess = 0.25;

/// R of A and Z; partial_loops.inc has the same for many nodes.
inline double stress(double share, double of_waves) { return share / ((1 + of_waves) * (1 + of_waves)); }

/// What the surface and the rubber have beside G: (4 w_e / M)^0.2, 1 - 1 / rho, which may be negative, and the edges
/// over those of isotropic roughness.
struct Band {
  double end_factor = 1, excess = 0, edges = 1;
};

/// Those edges by the first harmonics about the velocity: <cos 2 phi> and <sin 2 phi> of the slope variance.
inline double crossed_edges(double along, double across) {
  constexpr double crossed = 0.4;
  const double size = std::fmin(1, std::hypot(along, across));
  return size > 0 ? std::pow((1 - size) / (1 + size), crossed * (1 + along / size) / 4) : 1;
}

/// A factor, and the slope of its logarithm over ln kappa.
struct Factor {
  double value, log_slope;
};

/// All that depends on g = kappa G(q1) and kappa.
struct AtEnd {
  double share, share_slope;  // A1, and d A1 / d ln kappa
  double integral;            // F(g)
  Factor obstacle;            // Z / (A^2 g')
  Factor edges;               // T x^3 / g'(q_e) where I2 is that at q_e
  Factor spread;              // beside F

  AtEnd(double g, double kappa, const Band& band);
};

inline AtEnd::AtEnd(double g, double kappa, const Band& band) {
  const double s = 0.5 / std::sqrt(g), bell = std::exp(-s * s), root_pi = 1.7724538509055160273;
  const double rest = std::erfc(s);  // 1 - A1 in its own digits
  share = s < 0.5 ? std::erf(s) : 1 - rest;
  share_slope = -s * bell / root_pi;
  integral = s < 1 ? g * share + std::sqrt(g) * bell / root_pi - rest / 2
                   : g + (std::sqrt(g) * bell / root_pi - (0.5 + g) * rest);

  // 1 - A1^p without cancellation, and its slope
  const double log_share = rest < 0.5 ? std::log1p(-rest) : std::log(share), log_slope = share_slope / share;
  const auto below_one = [&](double p) {
    const double power = std::expm1(p * log_share);
    return Factor{-power, -p * (1 + power) * log_slope};
  };
  const auto [tenth, tenth_slope] = below_one(0.1);
  const double far = 1 + light * tenth * tenth * tenth;
  obstacle = {partial_contact::obstacle * band.end_factor * std::sqrt(std::sqrt(kappa * std::sqrt(rest))) * far,
              0.25 + (rest > 0 ? -0.125 * share_slope / rest : 0) + 3 * light * tenth * tenth * tenth_slope / far};
  const auto [fourth, fourth_slope] = below_one(0.25);
  edges = {partial_contact::edges * band.edges * share * fourth * std::fmax(1, last * (1 - band.excess)),
           log_slope + (fourth > 0 ? fourth_slope / fourth : 0)};
  const auto [eighth, eighth_slope] = below_one(8);
  const double excess = std::fmax(0, band.excess), square = excess * excess,
               part = partial_contact::spread * share + stiff * square * square;
  const double value = 1 + part * eighth;
  spread = {value, (partial_contact::spread * share_slope * eighth + part * eighth_slope) / value};
}

}  // namespace asperity::partial_contact
