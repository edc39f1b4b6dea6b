#include "asperity/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "numerics/arguments.hpp"
#include "numerics/roots.hpp"
#include "numerics/visit.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/tabulated.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// int_0^L exp(e x) dx, for any e including 0.
double exponential_integral(double e, double length) { return e == 0 ? length : std::expm1(e * length) / e; }

/// ln(to / from), good for neighbours too.
double log_ratio(double from, double to) { return std::log1p((to - from) / from); }

/// The slope of ln C in ln q above the roll-off.
double fall(const SelfAffineSpectrum& s) { return -2 * (s.hurst + 1); }

/// h_rms^2 / (2 pi C_r), C_r the density at the roll-off.
double height_per_density(const SelfAffineSpectrum& s) {
  const double q_r = s.rolloff.value_or(s.q0);
  const double flat = s.q0 * s.q0 * exponential_integral(2, log_ratio(s.q0, q_r));
  return flat + q_r * q_r * exponential_integral(-2 * s.hurst, log_ratio(q_r, s.q1));
}

double density_at_rolloff(const SelfAffineSpectrum& s) {
  return s.rms_height * s.rms_height / (2 * pi) / height_per_density(s);
}

/// Segments of a spectrum whose densities are numbers that can be told.
std::vector<Segment> told_segments(const Spectrum& spectrum) {
  std::vector<Segment> result = segments(spectrum);
  const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum);
  if (s && !std::isnormal(result.front().at_a))
    throw InvalidInput("rms_height = " + show(s->rms_height) + ", q0 = " + show(s->q0) +
                       ": C(q0) = " + show(result.front().at_a) + " m^4 leaves the range of a double");
  return result;
}

/// sqrt(2 pi int q^n C dq)
double root_of_moment(std::string_view name, const Spectrum& spectrum, int n) {
  double sum = 0;
  bool rough = false;
  for (const Segment& s : told_segments(spectrum)) {
    sum += 2 * pi * s.moment(n, s.b);
    rough |= s.at_a > 0 || s.at_b > 0;
  }
  if (rough && !std::isnormal(sum)) {
    const auto [q0, q1] = band(spectrum);
    throw InvalidInput(std::string(name) + " of a spectrum from q0 = " + show(q0) + " to q1 = " + show(q1) +
                       " 1/m: its square, " + show(sum) + ", leaves the range of a double");
  }
  return std::sqrt(sum);
}

}  // namespace

double Segment::offset(double q) const { return std::log1p((q - a) / a); }

double Segment::density(double q) const {
  return straight ? at_a + (at_b - at_a) * ((q - a) / (b - a)) : density_at(offset(q));
}

double Segment::density_at(double offset) const {
  if (straight) return std::fmax(0, at_a + (at_b - at_a) * (a * std::expm1(offset) / (b - a)));
  return at_a * std::exp(slope * offset);
}

double Segment::moment(int n, double q) const {
  if (!straight) return at_a * std::pow(a, n + 1) * exponential_integral(n + 1 + slope, offset(q));
  // a polynomial of degree 6 at most: the Gauss rule of four points is exact
  const double middle = a + (q - a) / 2, half = (q - a) / 2, root = std::sqrt(1.2);
  const auto pair = [&](double square, double weight) {
    const double node = std::sqrt(square) * half;
    const auto f = [&](double at) { return std::pow(at, n) * density(at); };
    return weight * (f(middle - node) + f(middle + node));
  };
  return half * (pair((3 - 2 * root) / 7, (18 + std::sqrt(30.0)) / 36) +
                 pair((3 + 2 * root) / 7, (18 - std::sqrt(30.0)) / 36));
}

std::vector<Segment> segments(const Spectrum& spectrum) {
  validate(spectrum);
  std::vector<Segment> result;
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) {
    const double top = density_at_rolloff(*s), q_r = s->rolloff.value_or(s->q0);
    if (q_r > s->q0) result.push_back({s->q0, q_r, top, top, 0, false});
    result.push_back({q_r, s->q1, top, top * std::pow(s->q1 / q_r, fall(*s)), fall(*s), false});
    return result;
  }
  const auto& table = std::get<TabulatedSpectrum>(spectrum);
  const auto& q = table.wavenumber();
  const auto& c = table.density();
  for (std::size_t i = 0; i + 1 < q.size(); ++i) {
    const bool straight = c[i] == 0 || c[i + 1] == 0;
    Segment segment{q[i], q[i + 1], c[i], c[i + 1], 0, straight};
    if (!straight) segment.slope = std::log(c[i + 1] / c[i]) / segment.length();
    result.push_back(segment);
  }
  return result;
}

// alpha = m0 m4 / m2^2 of a profile (P. R. Nayak, J. Lubr. Technol. 93, 398 (1971)). With M_n = 2 pi int q^(n+1) C dq
// of an isotropic surface m0 = M_0, m2 = M_2 / 2, m4 = 3 M_4 / 8. Wavenumbers and densities are taken in units of their
// highest, so that q^6 C leaves the range of a double for none.
double nayak_parameter(std::span<const Segment> surface, double wavenumber) {
  double densest = 0;
  for (const Segment& s : surface) densest = std::fmax(densest, std::fmax(s.at_a, s.at_b));
  double m[3] = {0, 0, 0};
  for (const Segment& s : surface) {
    if (s.a >= wavenumber || densest == 0) break;
    const Segment scaled{s.a / wavenumber, s.b / wavenumber, s.at_a / densest, s.at_b / densest, s.slope, s.straight};
    for (int n = 0; n < 3; ++n) m[n] += scaled.moment(2 * n + 1, std::fmin(1, scaled.b));
  }
  return m[1] > 0 ? 1.5 * (m[0] / m[1]) * (m[2] / m[1]) : 1.5;
}

SelfAffineSpectrum SelfAffineSpectrum::from_article(double h0, double hurst, double q0, double q1) {
  require_positive("h0", h0);
  SelfAffineSpectrum s{.rms_height = h0, .hurst = hurst, .q0 = q0, .q1 = q1};
  validate(s);
  s.rms_height = h0 * std::sqrt(-std::expm1(-2 * hurst * log_ratio(q0, q1)) / 2);
  return s;
}

void validate(const Spectrum& spectrum) {
  // a table was checked when it was made, and cannot change
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) validate(*s);
}

void validate(const SelfAffineSpectrum& s) {
  require_positive("rms_height", s.rms_height);
  if (!(s.hurst > 0 && s.hurst <= 1)) refuse("hurst", s.hurst, "in (0, 1]");
  require_positive("q0", s.q0);
  require_finite("q1", s.q1);
  if (!(s.q1 > s.q0)) refuse("q1", s.q1, "above q0 = " + show(s.q0));
  require_band("q1", s.q0, s.q1);
  if (s.rolloff && !(*s.rolloff > s.q0 && *s.rolloff < s.q1))
    refuse("rolloff", *s.rolloff, "between q0 = " + show(s.q0) + " and q1 = " + show(s.q1));
}

double density(const Spectrum& spectrum, double wavenumber) {
  return density(spectrum, std::span(&wavenumber, 1)).front();
}

std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber) {
  const std::vector<Segment> pieces = told_segments(spectrum);
  const auto [q0, q1] = band(spectrum);
  const bool measured = std::holds_alternative<TabulatedSpectrum>(spectrum);
  std::vector<double> result;
  result.reserve(wavenumber.size());
  for (const double q : wavenumber) {
    require_positive("wavenumber", q);
    if (q < q0 || q > q1) {
      if (measured)
        throw OutOfRange("wavenumber = " + show(q) + ": the spectrum is known in [" + show(q0) + ", " + show(q1) +
                         "] 1/m");
      result.push_back(0);
      continue;
    }
    const auto piece = std::ranges::lower_bound(pieces, q, {}, &Segment::b);
    result.push_back(piece->density(q));
  }
  return result;
}

std::array<double, 2> band(const Spectrum& spectrum) {
  return std::visit(Overloaded{
                        [](const SelfAffineSpectrum& s) {
                          return std::array{s.q0, s.q1};
                        },
                        [](const TabulatedSpectrum& s) {
                          return std::array{s.wavenumber().front(), s.wavenumber().back()};
                        },
                    },
                    spectrum);
}

double rms_height(const Spectrum& spectrum) {
  validate(spectrum);
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) return s->rms_height;
  return root_of_moment("rms_height", spectrum, 1);
}

double nayak_parameter(const Spectrum& spectrum) { return nayak_parameter(told_segments(spectrum), band(spectrum)[1]); }

double rms_slope(const Spectrum& spectrum) { return root_of_moment("rms_slope", spectrum, 3); }

double cutoff_for_slope(const Spectrum& spectrum, double slope) {
  require_positive("slope", slope);
  double left = slope * slope / (2 * pi);  // of int q^3 C dq
  for (const Segment& s : told_segments(spectrum)) {
    const double here = s.moment(3, s.b);
    if (here < left) {
      left -= here;
      continue;
    }
    if (s.straight) return bracketed_root([&](double q) { return s.moment(3, q) - left; }, s.a, s.b);
    // at_a a^4 (exp(e L) - 1) / e = left, solved for L = ln(q / a)
    const double e = 4 + s.slope, share = left / (s.at_a * std::pow(s.a, 4));
    return std::min(s.b, s.a * std::exp(e == 0 ? share : std::log1p(e * share) / e));
  }
  return band(spectrum)[1];
}

double cutoff_for_contamination(const Spectrum& spectrum, double size) {
  require_positive("size", size);
  const auto [q0, q1] = band(spectrum);
  const double q = 2 * pi / size;
  if (!(q > q0)) refuse("size", size, "below the longest wavelength of the spectrum, " + show(2 * pi / q0) + " m");
  return std::min(q, q1);
}

Spectrum truncated(const Spectrum& spectrum, std::optional<double> new_q0, std::optional<double> new_q1) {
  validate(spectrum);
  const auto [old_q0, old_q1] = band(spectrum);
  const double q0 = new_q0.value_or(old_q0), q1 = new_q1.value_or(old_q1);
  const std::string inside = "in [" + show(old_q0) + ", " + show(old_q1) + "], the spectrum's band [1/m]";
  require_finite("q0", q0);
  require_finite("q1", q1);
  const bool measured = std::holds_alternative<TabulatedSpectrum>(spectrum);
  const auto outside = [&](std::string_view name, double q) {
    if (measured) throw OutOfRange(std::string(name) + " = " + show(q) + ": must be " + inside);
    refuse(name, q, inside);
  };
  if (!(q0 >= old_q0 && q0 < old_q1)) outside("q0", q0);
  if (!(q1 > old_q0 && q1 <= old_q1)) outside("q1", q1);
  if (!(q1 > q0)) refuse("q1", q1, "above q0 = " + show(q0));
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) {
    const double q_r = s->rolloff.value_or(s->q0);
    if (q1 <= q_r)
      refuse("q1", q1, "above the roll-off, " + show(q_r) + ": what is left would be flat, not self-affine");
    return extended(*s, q0, q1);
  }
  return truncated_table(std::get<TabulatedSpectrum>(spectrum), q0, q1);
}

SelfAffineSpectrum extended(const SelfAffineSpectrum& spectrum, std::optional<double> q0, std::optional<double> q1) {
  validate(spectrum);
  SelfAffineSpectrum result = spectrum;
  result.q0 = q0.value_or(spectrum.q0);
  result.q1 = q1.value_or(spectrum.q1);
  if (spectrum.rolloff && *spectrum.rolloff <= result.q0) result.rolloff.reset();
  validate(result);
  // the density at the new roll-off (or q0) is that of the old law there
  const double from = spectrum.rolloff.value_or(spectrum.q0), to = result.rolloff.value_or(result.q0);
  const double top = density_at_rolloff(spectrum) * std::pow(to / from, fall(spectrum));
  result.rms_height = std::sqrt(2 * pi * top * height_per_density(result));
  return result;
}

Spectrum scaled(const Spectrum& spectrum, double factor) {
  validate(spectrum);
  require_positive("factor", factor);
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) {
    SelfAffineSpectrum result = *s;
    result.rms_height *= std::sqrt(factor);
    validate(result);
    return result;
  }
  return scaled_table(std::get<TabulatedSpectrum>(spectrum), factor);
}

}  // namespace asperity
