// C(q, phi) of rings and of ellipses: harmonics, densities, and tables of self-affine spectra with a lay.
#include "spectrum/harmonics.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// C / C_r at |q| / q_r, with the square of the cosine of the angle from the lay.
double shape(const SelfAffineSpectrum& s, double x, double square) {
  const double k = x * x * (s.axis_ratio * square + (1 - square) / s.axis_ratio);
  return s.rolloff && k < 1 ? 1 : std::pow(k, -1 - s.hurst);
}

/// C_r, or that of the law without roll-off at k = q0.
double top_density(const SelfAffineSpectrum& s) { return density_at_rolloff(s) / (s.rolloff ? 1 : mean_of_shape(s)); }

/// Means over directions of the shape times cos 2 m (phi - lay), m = 0 to n - 1, in a quarter of the circle, which is
/// alike in all: of the flat part, which ends it, in closed form, of the rest by Gauss rules.
std::vector<double> means(const SelfAffineSpectrum& s, double x, std::size_t n) {
  std::vector<double> result(n);
  const double r = s.axis_ratio, part = (1 / (x * x) - 1 / r) / (r - 1 / r);  // cos^2 of the angle where k is q_r
  const double edge = s.rolloff && r > 1 ? std::acos(std::sqrt(std::clamp(part, 0.0, 1.0))) : pi / 2;
  for (std::size_t m = 0; m < n; ++m)
    result[m] =
        m == 0 ? 1 - 2 * edge / pi : -std::sin(2 * static_cast<double>(m) * edge) / (pi * static_cast<double>(m));
  const LegendreRule& rule = legendre_rule(24);
  const auto pieces = static_cast<std::size_t>(std::ceil(6 * edge / (pi / 2)));
  const auto nodes = static_cast<Eigen::Index>(pieces * rule.n);
  Eigen::ArrayXd value(nodes), twice(nodes);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const std::size_t piece = static_cast<std::size_t>(i) / rule.n, j = static_cast<std::size_t>(i) % rule.n;
    const double half = edge / static_cast<double>(pieces) / 2;
    const double angle = half * (2 * static_cast<double>(piece) + 1 + rule.node[j]);
    twice[i] = 2 * std::cos(2 * angle);
    value[i] = 2 / pi * half * rule.weight[j] * shape(s, x, (2 + twice[i]) / 4);
  }
  Eigen::ArrayXd before = value * twice / 2, now = value, next;
  for (std::size_t m = 0; m < n; ++m) {
    result[m] += now.sum();
    next = twice * now - before;
    before.swap(now);
    now.swap(next);
  }
  return result;
}

/// Rows of a spectrum between its ends: where it bends so many that what lines miss does not matter.
std::vector<double> rows_of(const SelfAffineSpectrum& s) {
  std::vector<double> q;
  const auto add = [&](double from, double to, double steps) {
    for (double i = 0; i < steps; ++i) q.push_back(from * std::pow(to / from, i / steps));
  };
  const double root = std::sqrt(s.axis_ratio);
  constexpr double few = 8;
  if (!bends_by_direction(s)) {
    if (s.rolloff) add(s.q0, *s.rolloff, few);
    add(s.rolloff.value_or(s.q0), s.q1, few);
  } else {
    const double begin = std::clamp(*s.rolloff / root, s.q0, s.q1), end = std::clamp(*s.rolloff * root, s.q0, s.q1);
    constexpr double spacing = 1.0 / 1024;  // a line misses its square times 0.45 at most
    if (begin > s.q0) add(s.q0, begin, few);
    if (end > begin) add(begin, end, std::ceil(std::log(end / begin) / spacing));
    if (end < s.q1) add(end, s.q1, few);
  }
  q.push_back(s.q1);
  return q;
}

}  // namespace

HarmonicsAt::HarmonicsAt(const TabulatedSpectrum& table, double wavenumber) : all_(&table.harmonics()) {
  const std::vector<double>& q = table.wavenumber();
  row_ = interval_of(q, wavenumber);
  share_ = std::clamp(std::log(wavenumber / q[row_]) / std::log(q[row_ + 1] / q[row_]), 0.0, 1.0);
}

bool bends_by_direction(const SelfAffineSpectrum& s) { return s.axis_ratio != 1 && s.rolloff.has_value(); }

double mean_of_shape(const SelfAffineSpectrum& s) {
  SelfAffineSpectrum law = s;
  law.rolloff.reset();
  return means(law, 1, 1)[0];
}

std::vector<double> shape_harmonics(const SelfAffineSpectrum& law, std::span<const double> wavenumber,
                                    std::size_t count) {
  SelfAffineSpectrum power = law;
  power.rolloff.reset();
  const std::vector<double> of_power = means(power, 1, count);
  const double from = law.rolloff.value_or(law.q0), root = std::sqrt(law.axis_ratio);
  std::vector<double> result;
  for (const double q : wavenumber) {
    const double x = q / from, factor = std::pow(x, fall(law));
    if (law.rolloff && x < root) {  // it bends, or is flat already
      std::vector<double> of_shape(count);
      of_shape[0] = 1;
      if (x > 1 / root) of_shape = means(law, x, count);
      result.insert(result.end(), of_shape.begin(), of_shape.end());
    } else {
      for (const double one : of_power) result.push_back(factor * one);
    }
  }
  return result;
}

double plane_height(const SelfAffineSpectrum& s) {
  const double q_r = *s.rolloff, root = std::sqrt(s.axis_ratio);
  const double begin = std::clamp(q_r / root, s.q0, s.q1), end = std::clamp(q_r * root, s.q0, s.q1);
  // flat before the bend, a power law after it
  double sum = s.q0 * s.q0 * exponential_integral(2, std::log(begin / s.q0));
  if (end < s.q1)
    sum += end * end * std::pow(end / q_r, fall(s)) * mean_of_shape(s) *
           exponential_integral(2 + fall(s), std::log(s.q1 / end));
  const double length = std::log(end / begin);
  const auto bend = [&](double t) {  // smooth at both ends
    const double sine = std::sin(pi / 2 * t), q = begin * std::exp(length * sine * sine);
    return length * pi / 2 * std::sin(pi * t) * q * q * means(s, q / q_r, 1)[0];
  };
  return sum + integrate_smooth(bend, 0, 1).value;
}

bool is_directional(const Spectrum& spectrum) {
  if (const auto* const s = std::get_if<SelfAffineSpectrum>(&spectrum)) return s->axis_ratio != 1;
  return std::get<TabulatedSpectrum>(spectrum).harmonics().count > 0;
}

PlaneDensity::PlaneDensity(const Spectrum& spectrum) : spectrum_(spectrum) {
  const auto* const s = std::get_if<SelfAffineSpectrum>(&spectrum);
  if (s && is_directional(spectrum))
    top_ = top_density(*s);
  else
    pieces_ = s ? segments(spectrum) : segments_of_rows(std::get<TabulatedSpectrum>(spectrum));
}

double PlaneDensity::operator()(double wavenumber, double direction) const {
  if (pieces_.empty()) {
    const auto& s = std::get<SelfAffineSpectrum>(spectrum_);
    const double cosine = std::cos(direction - s.lay);
    return top_ * shape(s, wavenumber / s.rolloff.value_or(s.q0), cosine * cosine);
  }
  const double mean = std::ranges::lower_bound(pieces_, wavenumber, {}, &Segment::b)->density(wavenumber);
  if (!is_directional(spectrum_)) return mean;
  const auto& table = std::get<TabulatedSpectrum>(spectrum_);
  const HarmonicsAt at(table, wavenumber);
  double sum = 1;
  for (std::size_t m = 0; m < table.harmonics().count; ++m) {
    const double angle = 2 * static_cast<double>(m + 1) * direction;
    sum += 2 * (at.cosine(m) * std::cos(angle) + at.sine(m) * std::sin(angle));
  }
  return mean * sum;
}

std::vector<double> density(const Spectrum& spectrum, std::span<const double> wavenumber,
                            std::span<const double> direction) {
  require_same_size("direction", direction.size(), "wavenumber", wavenumber.size());
  std::vector<double> result = density(spectrum, wavenumber);
  const PlaneDensity at(spectrum);
  for (std::size_t i = 0; i < result.size(); ++i) {
    require_finite("direction", direction[i]);
    if (result[i] != 0) result[i] = at(wavenumber[i], direction[i]);
  }
  return result;
}

namespace {

TabulatedSpectrum table_of(const SelfAffineSpectrum& s) {
  const std::size_t width = most_harmonics + 1;
  std::vector<double> q = rows_of(s), c;
  const std::vector<double> shape = shape_harmonics(s, q, width);
  const double top = top_density(s);
  std::size_t count = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double* const row = &shape[i * width];
    c.push_back(top * row[0]);
    for (std::size_t m = count + 1; m < width; ++m)
      if (std::fabs(row[m]) > rounding_error * row[0]) count = m;
  }
  RingHarmonics harmonics{count, {}, {}, {}};
  for (std::size_t i = 0; i < q.size(); ++i)
    for (std::size_t m = 1; m <= count; ++m) {
      const double share = shape[i * width + m] / shape[i * width], angle = 2 * static_cast<double>(m) * s.lay;
      harmonics.cosine.push_back(share * std::cos(angle));
      harmonics.sine.push_back(share * std::sin(angle));
    }
  TabulatedSpectrum result(std::move(q), std::move(c), {}, std::move(harmonics));
  result.surface().law = {s.rolloff.value_or(s.q0), {}};
  if (bends_by_direction(s)) {
    const double root = std::sqrt(s.axis_ratio);
    result.surface().law->bends = {*s.rolloff / root, *s.rolloff * root};
  }
  return result;
}

}  // namespace

std::shared_ptr<const Spectrum> rows_of_law(const SelfAffineSpectrum& law) {
  static OfLastLaw<const Spectrum> rows;
  return rows(law, [&] { return std::make_shared<const Spectrum>(table_of(law)); });
}

TabulatedSpectrum directional_table(const Spectrum& spectrum) {
  validate(spectrum);
  if (const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum)) return *table;
  return std::get<TabulatedSpectrum>(*rows_of_law(std::get<SelfAffineSpectrum>(spectrum)));
}

}  // namespace asperity
