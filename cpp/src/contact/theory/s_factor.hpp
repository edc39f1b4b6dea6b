// The S factor of partial contact: which one a correction puts inside G, and which one on the friction integrand.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// P(G), the share of the nominal area in contact.
double contact_share(double g, Form form);
/// dP / dG.
double contact_slope(double g, Form form);
/// G below which P, and with it S, is 1 to rounding.
double full_contact_g(Form form);

/// S(P) = gamma + rise sqrt(P) + (1 - gamma - rise) P^power; the defaults are those of Eq. 8.
struct SFunction {
  double gamma, rise = 0;
  int power = 2;
  [[nodiscard]] double operator()(double share) const;
};

/// G with S inside it: int_0^G dg / S(P(g)) = G without, solved to rounding. The integral is kept as polynomials on
/// steps of ln G, as far as the points so far needed it.
class SInside {
 public:
  SInside(const SFunction& s, Form form);
  [[nodiscard]] double operator()(double uncorrected);

 private:
  static constexpr std::size_t nodes = 20;
  struct Step {
    double before;                        // the integral up to the lower edge
    std::array<double, nodes + 1> power;  // of t, -1 to 1 over the step: what is added up to there
  };
  void add_step();

  SFunction s_;
  Form form_;
  double start_;  // ln G below which S is 1
  std::vector<Step> steps_;
  double end_;  // the integral up to the last edge
};

/// The S inside G of NayakSFactor.
SFunction nayak_s(double nayak_parameter);

/// The S of the uncorrected P that the correction puts in the integrand of Eq. 22, if any.
std::optional<SFunction> s_in_integrand(const Correction& correction);

/// The G of a contact area, and its slope over the uncorrected G.
struct CorrectedG {
  double g, slope;
};

/// From the uncorrected G to the G of the contact area at `wavenumber`.
class AreaG {
 public:
  AreaG(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface, double wavenumber);
  [[nodiscard]] CorrectedG at(double g) const { return rule_ && g > 0 ? rule_(g) : CorrectedG{g, 1}; }
  [[nodiscard]] double operator()(double g) const { return at(g).g; }

 private:
  std::function<CorrectedG(double)> rule_;  // none: G as it is
};

}  // namespace asperity
