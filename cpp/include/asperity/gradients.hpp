// What makes the friction: slopes of mu over all that it follows from.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/contact.hpp"
#include "asperity/dma.hpp"
#include "asperity/export.hpp"
#include "asperity/friction.hpp"
#include "asperity/heating.hpp"

namespace asperity {

/// Slopes of mu. Tables are row-major: a row a point. Densities are means over hats, which are 1 at a row and fall to 0
/// at its neighbours: times the weight of the row in the trapezoid rule, over ln q or ln w, they are d mu of that row.
struct Gradients {
  std::vector<double> wavenumber;          // rows of C [1/m]
  std::vector<double> spectrum;            // density over ln q of d mu / d ln C
  std::vector<double> angular_frequency;   // rows of the modulus, reduced: v q a_T [rad/s]
  std::vector<double> storage, loss;       // densities over ln w of d mu / d ln E' and d mu / d ln E''
  std::vector<double> pressure, velocity;  // d mu / d ln p, d mu / d ln v
  std::vector<double> temperature;         // d mu / d T [1/K]; empty without a temperature
  /// d mu / d ln of a number that an object or the model was made with, or of each of several: points x count. The rows
  /// of StrainFactors are `storage_factors` and `loss_factors`; rms_height and q0 of a correction, names that a
  /// spectrum has too, are `correction_rms_height` and `correction_q0`, and its z_max is that of peaks and profile.
  struct OfArgument {
    std::string name;
    std::size_t count;
    std::vector<double> values;
  };
  std::vector<OfArgument> arguments;
  /// Of every slope of a point, absolute; of a density, of its integral over any range.
  std::vector<double> error_estimate;
};

/// At the points of `friction`, whatever the model's rtol. With ScanContact those over p, v and T are of what it
/// interpolates, and all others hold its ratios to PartialContact. InvalidInput for GSL's methods, which give no
/// slopes.
ASPERITY_EXPORT Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                    const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                                    std::span<const double> velocity, unsigned threads = 1);

/// The same at temperatures [K], `rubber` being the one at the reference of `shift`.
ASPERITY_EXPORT Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                    const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                    std::span<const double> pressure, std::span<const double> velocity,
                                    std::span<const double> temperature, unsigned threads = 1);

/// The same with the heat that friction makes: T(q) follows. With ScanContact, which is solved at each T(q), slopes
/// over p, v and T are differences of such contacts, and all others hold the ratio of mu to that of PartialContact.
ASPERITY_EXPORT Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                    const Heating& heating, const ContactModel& model,
                                    const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                                    std::span<const double> velocity, std::span<const double> temperature,
                                    Branch branch = Branch::coldest, unsigned threads = 1);

}  // namespace asperity
