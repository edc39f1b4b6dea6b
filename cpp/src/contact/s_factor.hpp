// The S factor of partial contact: which one a correction puts inside G, and which one on the friction integrand.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// P(G), the share of the nominal area in contact.
double contact_share(double g, Form form);
/// G below which P, and with it S, is 1 to rounding.
double full_contact_g(Form form);

/// S(P) = gamma + rise sqrt(P) + (1 - gamma - rise) P^power; as it stands here that of Eq. 8.
struct SFunction {
  double gamma, rise = 0;
  int power = 2;
  [[nodiscard]] double operator()(double share) const;
};

/// G with S inside it: int_0^G dg / S(P(g)) = G without, solved to rounding. The integral is kept on steps of ln G, as
/// far as points have asked for it.
class SInside {
 public:
  SInside(const SFunction& s, Form form);
  [[nodiscard]] double operator()(double uncorrected);

 private:
  [[nodiscard]] double part(std::size_t index, double x) const;

  SFunction s_;
  Form form_;
  double start_;             // ln G below which S is 1
  std::vector<double> phi_;  // the integral up to each edge
};

/// S inside G up to `wavenumber`, where the correction puts one there.
std::optional<SFunction> s_inside(const Correction& correction, const Spectrum& spectrum,
                                  std::span<const Segment> surface, double wavenumber);

/// S of the uncorrected P in the integrand of Eq. 22, where the correction puts one there.
std::optional<SFunction> s_in_integrand(const Correction& correction);

/// The G that the contact area at `wavenumber` is to be taken at.
class AreaG {
 public:
  AreaG(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface, double wavenumber);
  [[nodiscard]] double operator()(double g);

 private:
  std::optional<SInside> inside_;
};

/// What the boundary-element contacts that corrections were measured on reach from and to: Nayak's parameter, and the
/// load p* = sigma0 / (E* h').
inline constexpr double lowest_measured_nayak = 1.75, highest_measured_nayak = 201, lowest_measured_load = 0.005;

/// How a correction stands to those contacts at one pressure and velocity.
struct MeasuredWorth {
  bool light = false;  // the load is below theirs
  bool worse =
      false;  // an affine shift takes the area further from the truth, as NayakSFactor knows it, than none would
};
/// At one wavenumber.
class Worth {
 public:
  Worth(std::span<const Segment> surface, Form form, double wavenumber);
  /// `g` as the affine shift `p` made it.
  [[nodiscard]] MeasuredWorth operator()(double g, double p);

 private:
  std::span<const Segment> surface_;
  Form form_;
  double wavenumber_;
  std::optional<SInside> best_;
};

}  // namespace asperity
