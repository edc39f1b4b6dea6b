// The S factor of partial contact: which one a correction puts inside G, and which one on the friction integrand.
#pragma once

#include <optional>
#include <span>

#include "asperity/contact.hpp"
#include "segments.hpp"

namespace asperity {

/// P(G), the share of the nominal area in contact.
double contact_share(double g, Form form);

/// S(P) = gamma + rise sqrt(P) + (1 - gamma - rise) P^power; as it stands here that of Eq. 8.
struct SFunction {
  double gamma, rise = 0, power = 2;
  [[nodiscard]] double operator()(double share) const;
};

/// G with S inside it: int_0^G dg / S(P(g)) = `uncorrected`.
double g_with_s_inside(double uncorrected, const SFunction& s, Form form, double rtol);

/// S inside G up to `wavenumber`, where the correction puts one there.
std::optional<SFunction> s_inside(const Correction& correction, std::span<const Segment> surface, double wavenumber);

/// S of the uncorrected P in the integrand of Eq. 22, where the correction puts one there.
std::optional<SFunction> s_in_integrand(const Correction& correction);

/// The G that the contact area at `wavenumber` is to be taken at.
double area_g(double g, const ContactModel& model, std::span<const Segment> surface, double wavenumber);

/// What the boundary-element contacts that corrections were measured on reach from and to: Nayak's parameter, and the
/// load p* = sigma0 / (E* h').
inline constexpr double lowest_measured_nayak = 1.75, highest_measured_nayak = 201, lowest_measured_load = 0.005;

/// How a correction stands to those contacts at one pressure and velocity.
struct MeasuredWorth {
  bool light = false;  // the load is below theirs
  bool worse =
      false;  // an affine shift takes the area further from the truth, as NayakSFactor knows it, than none would
};
/// `g` at `wavenumber` as the affine shift `p` made it.
MeasuredWorth measured_worth(double g, double p, Form form, std::span<const Segment> surface, double wavenumber);

}  // namespace asperity
