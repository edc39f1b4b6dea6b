// Rubber friction: hysteresis (Eq. 22), adhesion (Eq. 23) and their sum (Eq. 24).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/contact.hpp"
#include "asperity/dma.hpp"
#include "asperity/export.hpp"
#include "asperity/heating.hpp"

namespace asperity {

/// mu_A = (tau_f0 / sigma0) (A / A0) exp(-c log10(v / v0)^2).
struct Adhesion {
  double shear_stress;               // tau_f0 [Pa]
  double reference_velocity = 6e-3;  // v0 [m/s]
  double width = 0.1;                // c [-]
  bool operator==(const Adhesion&) const = default;
};

ASPERITY_EXPORT void validate(const Adhesion& adhesion);

/// Where the hysteresis comes from. Tables are row-major: a row a point.
struct Contributions {
  std::vector<double> wavenumber;    // [1/m], n of them
  std::vector<double> dmu_dlnq;      // points x n
  std::vector<double> decade_edges;  // angular frequencies v q [rad/s], m + 1 powers of ten
  std::vector<double> decade_share;  // points x m, shares of the hysteresis
};

/// One entry a point.
struct Friction {
  std::vector<double> pressure, velocity;    // [Pa], [m/s]
  std::vector<double> mu;                    // hysteresis + adhesion
  std::vector<double> hysteresis, adhesion;  // mu_H, mu_A
  std::vector<double> contact_area;          // A/A0 at q1
  std::vector<double> shift_factor;          // p_T, 1 where nothing is shifted, infinite without contact
  std::vector<double> error_estimate;        // absolute, of mu
  std::vector<double> extrapolated_share;    // of mu_H, from frequencies outside of the measured range
  std::vector<double> lateral;      // force across over the load: -sigma0 (mu s + lateral n) on the moving body
  std::vector<double> model_error;  // relative, of mu_H on exact sliding contacts; NaN where nothing is known
  std::vector<double> temperature;  // as given [K]; empty without
  std::vector<Diagnostic> notes;    // where the theory or its input leaves its range
  std::optional<Contributions> contributions;
};

/// Values of `extrapolated_share` above which a note says so, and above which that note is fatal.
inline constexpr double noted_extrapolation = 0.05, fatal_extrapolation = 0.5;

/// These notes on points of any number, at which velocities [m/s] they hold.
ASPERITY_EXPORT std::vector<Diagnostic> extrapolation_notes(std::span<const double> velocity,
                                                            std::span<const double> share);

/// The columns of Friction, in the order in which they are shown.
inline constexpr std::vector<double> Friction::*friction_columns[] = {
    &Friction::mu,           &Friction::hysteresis,     &Friction::adhesion,
    &Friction::contact_area, &Friction::shift_factor,   &Friction::pressure,
    &Friction::velocity,     &Friction::error_estimate, &Friction::extrapolated_share,
    &Friction::model_error,  &Friction::lateral};

/// Everything a friction curve needs beside the surface, the rubber and the velocities.
struct Conditions {
  double pressure;  // sigma0 [Pa]
  double poisson_ratio = 0.5;
  Correction correction = NoCorrection{};
  std::optional<Adhesion> adhesion = std::nullopt;
  Form form = Form::exact;
  double rtol = 1e-6;
  bool contributions = false;
  Method method = Method::gauss;
  std::optional<StrainFactors> strain_factors = std::nullopt;
  double direction = 0;  // of sliding, from x towards y [rad]
};

/// The friction curve at one pressure.
ASPERITY_EXPORT Friction friction(const Spectrum& spectrum, const Rubber& rubber, const Conditions& conditions,
                                  std::span<const double> velocity);

/// For pairs of pressure and velocity. NotConverged where the relative tolerance of mu is not reached. At most
/// `threads` share the points, a hundred or more each; the numbers are the same for any of them.
ASPERITY_EXPORT Friction friction(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                  const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                                  std::span<const double> velocity, bool contributions = false, unsigned threads = 1);

/// The same at a temperature [K] for each point: the rubber, given at the reference of `shift`, is shifted by a_T(T).
/// Eq. 23 knows no temperature.
ASPERITY_EXPORT Friction friction(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                  const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                  std::span<const double> pressure, std::span<const double> velocity,
                                  std::span<const double> temperature, bool contributions = false,
                                  unsigned threads = 1);

/// Friction with the heat that it makes, and without.
struct FlashFriction {
  Friction hot;                             // its temperature is that of the roughness at q1 [K]
  Friction cold;                            // its temperature is the one given
  std::vector<double> macro_area;           // P_m
  std::vector<double> gain;                 // eigenvalue of the rise over the temperature, of the largest size
  std::vector<int> branches;                // solutions at the point, 1 but for a thermal runaway
  std::vector<double> temperature_profile;  // with contributions: points x wavenumbers [K]
  // relative, of the hot mu_H and A/A0, the larger of both; error_estimate is of their sum, of which mu_H may be a
  // small part
  std::vector<double> parts_error;
};

/// Hysteresis and adhesion warm the rubber, whose modulus follows its temperature at each wavenumber T(q), steadily:
/// the fixed point of Persson's model of 2006. `rubber` is the one at the reference of `shift`, `temperature` [K] that
/// of the background. Corrections by Greenwood-Williamson's model follow the modulus at the temperature that q0 feels,
/// and PartialContact's rule has the temperature of each wave, beyond the end of the spectrum too. InvalidInput for
/// GSL's methods.
ASPERITY_EXPORT FlashFriction friction(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                       const Heating& heating, const ContactModel& model,
                                       const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                                       std::span<const double> velocity, std::span<const double> temperature,
                                       Branch branch = Branch::coldest, bool contributions = false,
                                       unsigned threads = 1);

/// How far the rubber slides from rest, at its velocity throughout, until mu has come to within 1 / e of that with its
/// heat [m]: of each point, by the same model with the history of the heat. A point takes some ten milliseconds.
/// InvalidInput for GSL's methods.
ASPERITY_EXPORT std::vector<double> sliding_length(const Spectrum& spectrum, const Rubber& rubber,
                                                   const TemperatureShift& shift, const Heating& heating,
                                                   const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                                   std::span<const double> pressure, std::span<const double> velocity,
                                                   std::span<const double> temperature);

/// Parameters of Eq. 23 that a fit holds instead of fitting them.
struct FixedAdhesion {
  std::optional<double> shear_stress = std::nullopt;        // [Pa]
  std::optional<double> reference_velocity = std::nullopt;  // [m/s]
  std::optional<double> width = std::nullopt;               // [-]
};

/// Eq. 23 through measured friction. Standard errors come from the scatter of the points about the fit.
struct AdhesionFit {
  Adhesion adhesion;
  std::array<double, 9> covariance;  // 3 x 3: shear_stress [Pa], reference_velocity [m/s], width [-]; 0 where held
  double residual;                   // robust standard deviation of ln(mu / fit) [-]
  std::vector<bool> outliers;        // an entry a point: put aside, more than 4.685 times `residual` off the fit
  std::vector<Diagnostic> notes;
};

/// Robust least squares in ln mu: points scatter in proportion to mu. Hysteresis and area are those of `friction`.
/// InvalidInput where the points do not determine what is to be fitted.
ASPERITY_EXPORT AdhesionFit fit_adhesion(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                         std::span<const double> pressure, std::span<const double> velocity,
                                         std::span<const double> mu, const FixedAdhesion& fixed = {});

}  // namespace asperity
