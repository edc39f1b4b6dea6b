// A modulus between two knots of its table.
#pragma once

#include <cmath>
#include <complex>

namespace asperity {

/// A value at the origin times the exponential of a cubic without constant term, in x = ln(w / origin).
struct LogCubic {
  double value, slope, square = 0, cubic = 0;
  [[nodiscard]] double operator()(double x) const { return value * std::exp(x * (slope + x * (square + x * cubic))); }
  /// The same in x - x0.
  [[nodiscard]] LogCubic about(double x0) const {
    return {(*this)(x0), slope + x0 * (2 * square + 3 * x0 * cubic), square + 3 * x0 * cubic, cubic};
  }
};

/// E' and E'' on [low, high] [rad/s].
struct ModulusPiece {
  double low, high, origin;
  LogCubic storage, loss;
  bool measured;
  [[nodiscard]] std::complex<double> operator()(double w) const {
    const double x = std::log(w / origin);
    return {storage(x), loss(x)};
  }
};

}  // namespace asperity
