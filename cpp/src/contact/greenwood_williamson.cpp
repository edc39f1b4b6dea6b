#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "asperity/asperities.hpp"
#include "numerics/arguments.hpp"
#include "numerics/roots.hpp"

namespace asperity {

using std::numbers::pi;
using std::numbers::sqrt2;

double hertz_penetration(double force, double effective_modulus, double radius) {
  require_not_negative("force", force);
  require_positive("effective_modulus", effective_modulus);
  require_positive("radius", radius);
  // root by root, so that no product leaves the range of a double
  const double ratio = std::cbrt(force) / std::cbrt(effective_modulus);
  return std::cbrt(9.0 / 16) * ratio * ratio / std::cbrt(radius);
}

namespace {

/// ln of the mean of max(z - d, 0)^1.5 over the peaks, d = highest - depth.
double log_peak_moment(std::span<const double> peaks, double highest, double log_depth) {
  const double depth = std::exp(log_depth);
  double sum = 0;
  for (const double z : peaks) {
    const double share = std::fmax(0, 1 - (highest - z) / depth);  // of the depth that a peak reaches into
    sum += share * std::sqrt(share);
  }
  return 1.5 * log_depth + std::log(sum / static_cast<double>(peaks.size()));
}

/// d of sigma0 / E* = (4/3) sqrt(R) n_a <(z - d)^1.5> (Eqs 16 and 20), solved in the logarithm: the moment falls
/// with d, so the root is unique.
double greenwood_williamson(const MacroAsperities& a, double log_moment) {
  if (a.peaks.empty()) {
    // In units of h_rms. Jensen: <(x - t)_+^1.5> >= (-t)^1.5 gives the lower end, and <(x - t)_+^1.5> <=
    // <(x - t)^2>^(3/4) = (t^2 + 1)^(3/4) the upper one where there is one.
    const double target = log_moment - 1.5 * std::log(a.rms_height);
    const auto excess = [&](double t) { return log_gaussian_moment(t) - target; };
    const double depth = std::exp(target * (2.0 / 3));
    const double lower = -depth * (1 + 1e-9) - 1e-3;
    double upper = depth > 1 ? -std::sqrt(depth - 1) * std::sqrt(depth + 1) * (1 - 1e-9) : 8;
    while (excess(upper) > 0) upper *= 2;
    return a.rms_height * bracketed_root(excess, lower, upper);
  }
  const double highest = std::ranges::max(a.peaks);
  double below = 0;  // of the mean peak
  for (const double z : a.peaks) below += (highest - z) / static_cast<double>(a.peaks.size());
  // In the depth below the highest peak and its logarithm, so that shallow roots keep their digits.
  const auto excess = [&](double log_depth) { return log_peak_moment(a.peaks, highest, log_depth) - log_moment; };
  const double shallowest = std::exp(log_moment * (2.0 / 3));  // every peak as high as the highest
  const double deepest = below + shallowest;
  return highest - std::exp(bracketed_root(excess, std::log(shallowest) - 1e-9, std::log(deepest) + 1e-9));
}

}  // namespace

Separation separation(const MacroAsperities& a, double pressure, double effective_modulus, Reading reading) {
  require_positive("pressure", pressure);
  require_positive("effective_modulus", effective_modulus);
  require_positive("rms_height", a.rms_height);
  require_positive("q0", a.q0);
  if (!a.peaks.empty() && a.peaks.size() < 3)
    throw InvalidInput("peaks has " + std::to_string(a.peaks.size()) + " entries: must be 3 or more");
  for (std::size_t i = 0; i < a.peaks.size(); ++i) require_finite("peaks[" + std::to_string(i) + "]", a.peaks[i]);
  if (!a.peaks.empty()) {
    const auto [lowest, highest] = std::ranges::minmax(a.peaks);
    require_span("peaks: their highest", highest, lowest);
  }
  // ln of (4/3) sqrt(R) n_a = 2 q0 / (3 pi^2 sqrt(3 sqrt2 h_rms))
  const double stiffness =
      std::log(2 / (3 * pi * pi * std::sqrt(3 * sqrt2))) + std::log(a.q0) - std::log(a.rms_height) / 2;
  const double load = std::log(pressure) - std::log(effective_modulus);
  constexpr double most = 700;  // ln of what is short of the largest double
  const double log_depth = (load - stiffness) * (2.0 / 3), log_interaction = load + std::log(2 * pi) - std::log(a.q0);
  if (log_depth > most || log_depth - std::log(a.rms_height) > most || log_interaction > most)
    refuse("pressure", pressure,
           "lower: with effective_modulus = " + show(effective_modulus) + ", rms_height = " + show(a.rms_height) +
               " and q0 = " + show(a.q0) + " the separation leaves the range of a double");
  const double d = greenwood_williamson(a, load - stiffness);
  const double ratio = pressure / effective_modulus;
  // sigma0 sqrt(A_a) / E* (Eq. 19)
  const double interaction = std::isnormal(ratio) ? ratio * 2 * pi / a.q0 : std::exp(log_interaction);
  return reading == Reading::implicit ? Separation{d, d - interaction} : Separation{d + interaction, d};
}

ContactState contact_state(double effective_separation, double z_max, double z_min) {
  require_finite("z_max", z_max);
  require_finite("z_min", z_min);
  if (!(z_max > z_min)) refuse("z_max", z_max, "above z_min = " + show(z_min));
  if (std::isnan(effective_separation)) refuse("effective_separation", effective_separation, "a number");
  if (effective_separation >= z_max) return ContactState::no_contact;
  return effective_separation <= z_min ? ContactState::full : ContactState::partial;
}

}  // namespace asperity
