// The root of PartialContact's rule, from sums over nodes and what lies beyond the end of the roughness.
#pragma once

#include "contact/theory/edges.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/partial_loops.hpp"
#include "spectrum/roughness_window.hpp"

namespace asperity {

/// kappa, with the areas and sums that belong to it (contact/theory/partial_contact_rule.hpp).
struct ContactSums {
  double kappa = 1;
  double share = 1;                   // A1
  double variance = 0, friction = 0;  // int R dG + int T d ln x, and with I1 / I2 in them; over those of unit load
  double edges = 0, obstacle = 0;     // the factors of T and Z
  double share_slope = 0, friction_slope = 0;  // of ln A1 and ln friction over ln kappa
  double slope = 0;                            // of ln F - ln variance, which is 0 at the root
  double missed = 0;                           // and is up to this off it, as Newton's steps end
};

/// The end of the roughness, at unit load: q_e [1/m], K w_e and K M, and the first factor of Z.
struct RoughnessEnd {
  double wavenumber, window, total, factor;
  RoughnessEnd(const RoughnessWindow& window, double g_factor);
  /// What is known of a velocity with G(q1) and I2(v q_e).
  [[nodiscard]] partial_contact::Band band(double g, double i2) const { return {factor, 1 - g / (total * i2)}; }
};

/// The same at a velocity: G1, the window's g' / I2, and what lies beyond.
struct PartialEnd {
  double g = 0, window = 0;
  partial_contact::Band band;
  EdgeIntegrals tail;
};

/// A kappa to start from that knows no other point: it is 0.3 to 2 where it was seen.
inline constexpr double usual_kappa = 0.75;
/// NotConverged where there is no root. `result` has room for the numbers of each node.
ContactSums partial_root(const PartialNodes& nodes, const PartialEnd& end, double scale, double rtol, double start,
                         const PartialColumns& result);

}  // namespace asperity
