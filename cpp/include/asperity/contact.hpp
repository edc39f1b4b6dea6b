// Real contact area and contact pressure at every magnification (Eqs 1-8, Section 6.1).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/correction.hpp"
#include "asperity/export.hpp"
#include "asperity/rubber.hpp"
#include "asperity/spectrum.hpp"
#include "asperity/strain_factors.hpp"

namespace asperity {

/// P(G): exact, erf(1 / (2 sqrt G)); interpolated, Eq. 7's (1 + (pi G)^1.5)^(-1/3), which differs from it by
/// -2.8 % to +2.6 %.
enum class Form { exact, interpolated };

/// How integrals are computed: on Gauss-Legendre panels made for them, or by GSL's adaptive integration (QAG, QAGS,
/// CQUAD), which is slower by hundreds of times and there to check the former. All keep rtol or fail with NotConverged.
enum class Method { gauss, qag, qags, cquad };

/// How the contact is computed.
struct ContactModel {
  double poisson_ratio = 0.5;
  Correction correction = NoCorrection{};
  Form form = Form::exact;
  double rtol = 1e-6;
  Method method = Method::gauss;
  /// The modulus at the strain of each magnification; none: that of small strain.
  std::optional<StrainFactors> strain_factors = std::nullopt;
  /// Of sliding, from x towards y [rad]; only directional spectra and ScanContact differ by it.
  double direction = 0;
};

/// A/A0 for pairs of pressure [Pa] and velocity [m/s], at each of `wavenumber` [1/m] (the last index), or at
/// the upper end of the spectrum where none is given.
ASPERITY_EXPORT std::vector<double> contact_area(const Spectrum& spectrum, const Rubber& rubber,
                                                 const ContactModel& model, std::span<const double> pressure,
                                                 std::span<const double> velocity,
                                                 std::span<const double> wavenumber = {});

/// Where the theory or its input leaves its range at these pressures and velocities, in sentences.
ASPERITY_EXPORT std::vector<Diagnostic> contact_notes(const Spectrum& spectrum, const Rubber& rubber,
                                                      const ContactModel& model, std::span<const double> pressure,
                                                      std::span<const double> velocity);

/// By how much exact contacts of maps with such heights differ from PartialContact; none where the heights are about
/// Gaussian.
ASPERITY_EXPORT std::optional<Diagnostic> note_on_heights(const HeightShape& heights);

/// <sigma> = sigma0 A0 / A (Eq. 1) [Pa], arguments as for contact_area.
ASPERITY_EXPORT std::vector<double> mean_pressure(const Spectrum& spectrum, const Rubber& rubber,
                                                  const ContactModel& model, std::span<const double> pressure,
                                                  std::span<const double> velocity,
                                                  std::span<const double> wavenumber = {});

/// The correction factor of Section 6.1: S A / A0 with the uncorrected A for the S factor on the friction,
/// otherwise (A_m / A0) / p_T^2 with the corrected one.
ASPERITY_EXPORT std::vector<double> correction_factor(const Spectrum& spectrum, const Rubber& rubber,
                                                      const ContactModel& model, std::span<const double> pressure,
                                                      std::span<const double> velocity,
                                                      std::span<const double> wavenumber);

/// P(sigma) [1/Pa] for triples of stress [Pa], pressure and velocity at one wavenumber: the solution of Eq. 4,
/// a Gaussian of variance 2 G sigma0^2 about sigma0 minus its mirror image, for sigma > 0; the delta at
/// sigma = 0 is left out. Its integral is A/A0, its first moment sigma0. Exact form only.
ASPERITY_EXPORT std::vector<double> pressure_distribution(const Spectrum& spectrum, const Rubber& rubber,
                                                          const ContactModel& model, std::span<const double> stress,
                                                          std::span<const double> pressure,
                                                          std::span<const double> velocity, double wavenumber);

}  // namespace asperity
