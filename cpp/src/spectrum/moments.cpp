// Densities and moments of a spectrum, int q^n C dq piece by piece: rms height and slope, Nayak's parameter, the
// cut-off at a given slope. On a piece C is a power law, or a straight line beside a zero (segments.hpp). B. N. J.
// Persson et al., J. Phys.: Condens. Matter 17, R1 (2005); P. R. Nayak, J. Lubr. Technol. 93, 398 (1971).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/roots.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// The segments of a spectrum, refused where a density leaves the range of a double.
std::vector<Segment> checked_segments(const Spectrum& spectrum) {
  std::vector<Segment> result = segments(spectrum);
  const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum);
  if (s && !std::isnormal(result.front().at_a))
    throw InvalidInput(argument("rms_height") + " = " + value(s->rms_height) + ", " + argument("q0") + " = " +
                       value(s->q0) + ": C(q0) = " + show(result.front().at_a) + " m^4 leaves the range of a double");
  return result;
}

/// sqrt(2 pi int q^n C dq)
double root_of_moment(std::string_view name, std::span<const Segment> surface, int n) {
  double sum = 0;
  bool rough = false;
  for (const Segment& s : surface) {
    sum += 2 * pi * s.moment(n, s.b);
    rough |= s.at_a > 0 || s.at_b > 0;
  }
  if (rough && !std::isnormal(sum))
    throw InvalidInput(std::string(name) + " of a spectrum from " + argument("q0") + " = " + value(surface.front().a) +
                       " to " + argument("q1") + " = " + value(surface.back().b) + " 1/m: its square, " + show(sum) +
                       ", leaves the range of a double");
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
  if (!straight) {
    double power = a * a;
    for (int k = 1; k < n; k += 2) power *= a * a;
    return at_a * power * exponential_integral(n + 1 + slope, offset(q));
  }
  static const LegendreRule& rule = legendre_rule(4);  // exact for a polynomial of degree 6
  const double half = (q - a) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double at = a + half * (1 + rule.node[i]);
    sum += rule.weight[i] * (std::pow(at, n) * density(at));
  }
  return half * sum;
}

std::vector<Segment> segments(const Spectrum& spectrum) {
  validate(spectrum);
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    const std::span<const Segment> kept = table->surface().segments(*table);
    return {kept.begin(), kept.end()};
  }
  std::vector<Segment> result;
  const auto& s = std::get<SelfAffineSpectrum>(spectrum);
  if (bends_by_direction(s)) return segments_of_rows(std::get<TabulatedSpectrum>(*rows_of_law(s)));
  const double top = density_at_rolloff(s), q_r = s.rolloff.value_or(s.q0);
  if (q_r > s.q0) result.push_back({s.q0, q_r, top, top, 0, false});
  result.push_back({q_r, s.q1, top, top * std::pow(s.q1 / q_r, fall(s)), fall(s), false});
  return result;
}

/// Densities with 0 for rows that products of them cannot hold, of a tail that has faded to nothing beside the rest.
std::vector<double> without_faded(const TabulatedSpectrum& table) {
  const auto& q = table.wavenumber();
  std::vector<double> c = table.density(), roughness;
  for (std::size_t i = 0; i < c.size(); ++i) roughness.push_back((q[i] * q[i]) * (q[i] * q[i]) * c[i]);
  constexpr double nothing = 1e-20;
  const double most = std::ranges::max(roughness);
  for (std::size_t i = 0; i < c.size(); ++i)
    if (!is_representable(std::fmin(c[i], roughness[i])) && roughness[i] < nothing * most) c[i] = 0;
  return c;
}

std::vector<Segment> segments_of_rows(const TabulatedSpectrum& table) {
  std::vector<Segment> result;
  const auto& q = table.wavenumber();
  const std::vector<double> c = without_faded(table);
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

double density(const Spectrum& spectrum, double wavenumber) {
  return density(spectrum, std::span(&wavenumber, 1)).front();
}

std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber) {
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  const std::vector<Segment> pieces = table ? segments_of_rows(*table) : checked_segments(spectrum);
  const double q0 = pieces.front().a, q1 = pieces.back().b;
  std::vector<double> result;
  result.reserve(wavenumber.size());
  for (const double q : wavenumber) {
    heed_at(result.size());
    require_positive("wavenumber", q);
    if (q < q0 || q > q1) {
      if (table) {
        const ShownRange known(q0, q1);
        throw OutOfRange(argument("wavenumber") + " = " + known.value(q) + ": the spectrum is known in " +
                         known.text() + " 1/m");
      }
      result.push_back(0);
      continue;
    }
    const auto piece = std::ranges::lower_bound(pieces, q, {}, &Segment::b);
    result.push_back(piece->density(q));
  }
  return result;
}

std::array<double, 2> band(const Spectrum& spectrum) {
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) return {s->q0, s->q1};
  const auto& table = std::get<TabulatedSpectrum>(spectrum);
  return {table.wavenumber().front(), table.q1()};
}

double rms_height(const Spectrum& spectrum) {
  validate(spectrum);
  if (const auto* s = std::get_if<SelfAffineSpectrum>(&spectrum)) return s->rms_height;
  return root_of_moment("rms_height", checked_segments(spectrum), 1);
}

double nayak_parameter(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) return table->surface().nayak_parameter(*table);
  return nayak_parameter(checked_segments(spectrum), band(spectrum)[1]);
}

double rms_slope_of(std::span<const Segment> surface) { return root_of_moment("rms_slope", surface, 3); }

double rms_slope(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) return table->surface().rms_slope(*table);
  return rms_slope_of(checked_segments(spectrum));
}

double cutoff_for_slope(const Spectrum& spectrum, double slope) {
  require_positive("slope", slope);
  double left = slope * slope / (2 * pi);  // of int q^3 C dq
  for (const Segment& s : checked_segments(spectrum)) {
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
  if (!(q > q0)) refuse("size", size, "below the longest wavelength of the spectrum, " + show(2 * pi / q0, 6) + " m");
  return std::min(q, q1);
}

}  // namespace asperity
