// A spectrum as the pieces on which it is one power law or one straight line, and its changes row by row.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "asperity/spectrum.hpp"

namespace asperity {

struct Segment {
  double a, b;    // [1/m]
  double at_a;    // C(a) [m^4]
  double at_b;    // C(b) [m^4]
  double slope;   // of ln C in ln q, where it is a power law
  bool straight;  // linear in q: a zero at either end has no logarithm

  /// ln(q / a): the coordinate on a segment, which keeps its digits however narrow it is.
  [[nodiscard]] double offset(double q) const;
  [[nodiscard]] double length() const { return offset(b); }
  [[nodiscard]] double density_at(double offset) const;
  [[nodiscard]] double density(double q) const;
  /// int_a^q k^n C(k) dk for n = 1, 3 and 5, without cancellation on narrow segments.
  [[nodiscard]] double moment(int n, double q) const;
};

/// Those of the band.
std::vector<Segment> segments(const Spectrum& spectrum);
/// Those of all rows, beyond the band too.
std::vector<Segment> segments_of_rows(const TabulatedSpectrum& table);

double rms_slope_of(std::span<const Segment> surface);

/// Nayak's parameter of the surface up to `wavenumber`; 1.5, its least, where there is no roughness.
double nayak_parameter(std::span<const Segment> surface, double wavenumber);

/// Without q1 the rows beyond the band stay.
TabulatedSpectrum truncated_table(const TabulatedSpectrum& table, double q0, std::optional<double> q1);
TabulatedSpectrum scaled_table(const TabulatedSpectrum& table, double factor);

/// int_0^L exp(e x) dx, for any e including 0.
inline double exponential_integral(double e, double length) { return e == 0 ? length : std::expm1(e * length) / e; }

/// The slope of ln C in ln q above the roll-off.
double fall(const SelfAffineSpectrum& s);

/// C_r, the density at the roll-off (at q0 where there is none) [m^4].
double density_at_rolloff(const SelfAffineSpectrum& s);

}  // namespace asperity
