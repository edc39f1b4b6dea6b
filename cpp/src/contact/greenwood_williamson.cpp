// Single asperities: Hertz's penetration (Eq. 14) and Greenwood and Williamson's separation d between
// macro-asperities, sigma0 = (4/3) E* sqrt(R) n_a <(z - d)_+^(3/2)> (Eqs 16-20).
// J. A. Greenwood and J. B. P. Williamson, Proc. R. Soc. Lond. A 295, 300 (1966).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "asperity/asperities.hpp"
#include "contact/peak_loops.hpp"
#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"
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

// With s = x - t the integrand is exp(g(s)), g = 1.5 ln s - (s + t)^2 / 2, largest at s* = (sqrt(t^2 + 6) - t) / 2.
// Scaled by its maximum it neither under- nor overflows.
double integrated(double t) {
  const double root = std::hypot(t, std::sqrt(6.0));
  const double peak = t > 0 ? 3 / (root + t) : (root - t) / 2;  // the two forms of s*, each where it does not cancel
  const double width = 1 / std::sqrt(1 + 1.5 / (peak * peak));
  // g(s) - g(s*) with r = s / s* - 1: 1.5 (ln(1 + r) - r) - (r s*)^2 / 2, since g' vanishes at s*
  const auto shape = [&](double s) {
    const double r = s / peak - 1;
    return s > 0 ? std::exp(1.5 * (std::log1p(r) - r) - r * peak * r * peak / 2) : 0.0;
  };
  // On either side of the peak, in units of its width; u^2 tames the s^1.5 at the lower end.
  constexpr double rtol = 1e-13, reach = 40;
  const double bottom = std::fmax(0, peak - reach * width);
  const auto left =
      integrate([&](double u) { return 2 * u * shape(bottom + u * u); }, 0, std::sqrt(peak - bottom), rtol);
  const auto right = integrate(shape, peak, peak + 4 * width, rtol);
  const auto tail = integrate(shape, peak + 4 * width, peak + reach * width, rtol, rtol * right.value);
  const double at_peak = 1.5 * std::log(peak) - (peak + t) * (peak + t) / 2;
  return at_peak + std::log(left.value + right.value + tail.value) - std::log(2 * pi) / 2;
}

/// ln of the moment, with t^2 / 2 added where t > 0, over asinh t: a root search asks dozens of times within one piece.
double smooth_moment(double asinh_t) {
  const double t = std::sinh(asinh_t);
  return integrated(t) + (t > 0 ? t * t / 2 : 0);
}

}  // namespace

// Deep in contact the whole Gaussian counts, and <(1 + x / |t|)^1.5> is summed in its even moments 1, 3, 15: the next
// term is 0.34 / t^8. Far out, with s = y / t, exp(-s^2 / 2) is expanded under Gamma's integral of y^1.5 exp(-y): the
// next term is 500 / t^8.
double log_gaussian_moment(double t) {
  require_finite("t", t);
  const double u = 1 / t / t;
  static PiecewiseChebyshev<double> table(-6, 6, smooth_moment);  // pieces meet at t = 0
  const double w = std::asinh(t);
  if (w < -table.highest())
    return 1.5 * std::log(-t) + std::log1p(u * (3.0 / 8 + u * (9.0 / 128 + u * (105.0 / 1024))));
  if (w > table.highest()) {
    const double series = u * (-35.0 / 8 + u * (3465.0 / 128 + u * (-225225.0 / 1024)));
    return -t * t / 2 + std::log(3.0 / (4 * std::numbers::sqrt2)) - 2.5 * std::log(t) + std::log1p(series);
  }
  return table(w) - (t > 0 ? t * t / 2 : 0);
}

namespace {

/// ln of the mean of max(z - d, 0)^1.5 over the peaks, d = highest - depth, and its slope over ln depth.
struct PeakMoment {
  double log, slope;
};

PeakMoment peak_moment(std::span<const double> peaks, double highest, double log_depth) {
  const PeakSums sums = sums_over_peaks(peaks.data(), peaks.size(), highest, std::exp(log_depth));
  return {1.5 * log_depth + std::log(sums.moment / static_cast<double>(peaks.size())), 1.5 * sums.roots / sums.moment};
}

/// The ln depth at which the moment is `log_moment`: Newton's steps from `start`, and a half of the bracket where one
/// would leave it or where steps do not become shorter, as they may about a crowd of peaks. The moment is nearly a
/// power of the depth, so that four or five do.
double log_depth_of(std::span<const double> peaks, double highest, double log_moment, double lower, double upper,
                    double start) {
  constexpr int most_steps = 100;
  double x = start, last = upper - lower, before_last = last;
  for (int i = 0; i < most_steps; ++i) {
    const PeakMoment at = peak_moment(peaks, highest, x);
    const double excess = at.log - log_moment;
    (excess > 0 ? upper : lower) = x;
    double next = x - excess / at.slope;
    if (!(next >= lower && next <= upper && std::fabs(next - x) <= before_last / 2)) next = lower + (upper - lower) / 2;
    before_last = last;
    last = std::fabs(next - x);
    // what is left goes like the square of a step, or like its power 3/2 where a peak is just reached
    if (last < 1e-11) return next;
    x = next;
  }
  throw NotConverged(argument("peaks") + ": no separation of ln depth between " + show(lower) + " and " + show(upper));
}

/// d of sigma0 / E* = (4/3) sqrt(R) n_a <(z - d)^1.5> (Eqs 16 and 20), solved in the logarithm: the moment falls
/// with d, so the root is unique.
double greenwood_williamson(const MacroAsperities& a, const PeakRange& range, double log_moment) {
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
  // In the depth below the highest peak and its logarithm, so that shallow roots keep their digits.
  const double shallowest = std::exp(log_moment * (2.0 / 3));          // every peak as high as the highest
  const double deepest = (range.highest - range.lowest) + shallowest;  // every peak as low as the lowest
  const double lower = std::log(shallowest) - 1e-9, upper = std::log(deepest) + 1e-9;
  const double of_mean = std::log(std::fmax(0, range.highest - range.mean) + shallowest);
  const double start = of_mean < upper ? of_mean : upper;
  return range.highest - std::exp(log_depth_of(a.peaks, range.highest, log_moment, lower, upper, start));
}

}  // namespace

Separation separation(const MacroAsperities& a, double pressure, double effective_modulus, Reading reading) {
  require_positive("pressure", pressure);
  require_positive("effective_modulus", effective_modulus);
  require_positive("rms_height", a.rms_height);
  require_positive("q0", a.q0);
  if (!a.peaks.empty() && a.peaks.size() < 3) require_size("peaks", a.peaks.size(), 3);
  PeakRange range{};
  if (!a.peaks.empty()) {
    range = range_of_peaks(a.peaks.data(), a.peaks.size());
    if (!std::isfinite(range.mean)) require_each_finite("peaks", a.peaks);
    require_span("peaks: their highest", range.highest, range.lowest);
  }
  // ln of (4/3) sqrt(R) n_a = 2 q0 / (3 pi^2 sqrt(3 sqrt2 h_rms))
  const double stiffness =
      std::log(2 / (3 * pi * pi * std::sqrt(3 * sqrt2))) + std::log(a.q0) - std::log(a.rms_height) / 2;
  const double load = std::log(pressure) - std::log(effective_modulus);
  constexpr double most = 700;  // the largest double is exp(709.8)
  const double log_depth = (load - stiffness) * (2.0 / 3), log_interaction = load + std::log(2 * pi) - std::log(a.q0);
  if (log_depth > most || log_depth - std::log(a.rms_height) > most || log_interaction > most)
    refuse("pressure", pressure,
           "lower: with effective_modulus = " + show(effective_modulus) + ", rms_height = " + show(a.rms_height) +
               " and " + argument("q0") + " = " + value(a.q0) + " the separation leaves the range of a double");
  const double d = greenwood_williamson(a, range, load - stiffness);
  const double ratio = pressure / effective_modulus;
  // sigma0 sqrt(A_a) / E* (Eq. 19)
  const double interaction = std::isnormal(ratio) ? ratio * 2 * pi / a.q0 : std::exp(log_interaction);
  return reading == Reading::implicit ? Separation{d, d - interaction} : Separation{d + interaction, d};
}

ContactState contact_state(double effective_separation, double z_max, double z_min) {
  require_finite("z_max", z_max);
  require_finite("z_min", z_min);
  if (!(z_max > z_min)) refuse("z_max", z_max, "above " + argument("z_min") + " = " + value(z_min));
  if (std::isnan(effective_separation)) refuse("effective_separation", effective_separation, "a number");
  if (effective_separation >= z_max) return ContactState::no_contact;
  return effective_separation <= z_min ? ContactState::full : ContactState::partial;
}

}  // namespace asperity
