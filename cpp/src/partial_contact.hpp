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

/// Nayak's parameters of the boundary-element contacts that corrections were measured on, lowest and highest.
inline constexpr double lowest_measured_nayak = 1.75, highest_measured_nayak = 201;

/// Whether an affine shift `p` that made G to `g` at `wavenumber` takes the area further from the truth, as
/// NayakSFactor knows it, than no correction would.
bool shift_worsens_area(double g, double p, Form form, std::span<const Segment> surface, double wavenumber);

}  // namespace asperity
