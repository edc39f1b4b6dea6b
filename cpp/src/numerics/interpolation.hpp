// Cubic interpolation on an interval between two rows: Hermite's, and Steffen's, whose slopes keep it monotone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

inline std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> result(values.size());
  std::ranges::transform(values, result.begin(), [](double v) { return std::log(v); });
  return result;
}

/// The interval of rising numbers that holds `at`: i with x_i <= at < x_(i + 1), the first or the last one beyond them.
inline std::size_t interval_of(std::span<const double> x, double at) {
  return static_cast<std::size_t>(std::upper_bound(x.begin() + 1, x.end() - 1, at) - x.begin()) - 1;
}

struct ValueAndSlope {
  double value, slope;
};

/// Coefficients of the powers of x - x_a, from the constant up, of the cubic through a and b, h apart, with the slopes
/// da and db there.
inline std::array<double, 4> hermite_powers(double a, double da, double b, double db, double h) {
  const double secant = (b - a) / h;
  return {a, da, (3 * secant - 2 * da - db) / h, (da + db - 2 * secant) / (h * h)};
}

/// At `t` in [0, 1] of an interval `h` long: the cubic through a and b with the slopes da and db there.
inline ValueAndSlope hermite(double a, double da, double b, double db, double h, double t) {
  const double rise = b - a, square = 3 * rise - h * (2 * da + db), cube = h * (da + db) - 2 * rise;
  return {a + t * (h * da + t * (square + t * cube)), (h * da + t * (2 * square + 3 * t * cube)) / h};
}

/// Lagrange's polynomials through n places: each is 1 at its own and 0 at the others.
template <std::size_t n>
class Lagrange {
 public:
  explicit Lagrange(const std::array<double, n>& place) : place_(place) {
    norm_.fill(1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (j != i) norm_[i] /= place[i] - place[j];
  }
  [[nodiscard]] const std::array<double, n>& place() const { return place_; }
  std::array<double, n> operator()(double x) const {
    std::array<double, n> result = norm_;
    double before = 1, behind = 1;
    for (std::size_t i = 0; i < n; ++i) {
      result[i] *= before;
      before *= x - place_[i];
      result[n - 1 - i] *= behind;
      behind *= x - place_[n - 1 - i];
    }
    return result;
  }

 private:
  std::array<double, n> place_, norm_;
};

/// A piecewise cubic that has its extrema at the data and nowhere else; M. Steffen, Astron. Astrophys. 239, 443
/// (1990): the slope at a row is the parabola's through it and its neighbours, limited to twice the smaller of
/// the two secants, and zero where they differ in sign.
class Steffen {
 public:
  Steffen(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()) {
    const std::size_t n = x_.size();
    const auto step = [&](std::size_t i) { return x_[i + 1] - x_[i]; };
    const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / step(i); };
    if (n == 2) {
      slope_[0] = slope_[1] = secant(0);
      return;
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double before = secant(i - 1), after = secant(i);
      const double parabola = (before * step(i) + after * step(i - 1)) / (step(i - 1) + step(i));
      const double limit = 2 * std::fmin(std::fabs(before), std::fabs(after));
      slope_[i] = before * after <= 0 ? 0 : std::copysign(std::fmin(limit, std::fabs(parabola)), before);
    }
    slope_[0] = end_slope(secant(0), secant(1), step(0), step(1));
    slope_[n - 1] = end_slope(secant(n - 2), secant(n - 3), step(n - 2), step(n - 3));
  }

  [[nodiscard]] std::span<const double> x() const { return x_; }

  /// Coefficients of the powers of x - x_i between x_i and x_(i + 1), from the constant up.
  [[nodiscard]] std::array<double, 4> cubic(std::size_t i) const {
    return hermite_powers(y_[i], slope_[i], y_[i + 1], slope_[i + 1], x_[i + 1] - x_[i]);
  }
  double operator()(double at) const {
    const std::size_t i = interval_of(x_, at);
    const auto [y, slope, square, cube] = cubic(i);
    const double t = at - x_[i];
    return y + t * (slope + t * (square + t * cube));
  }
  [[nodiscard]] double slope(std::size_t i) const { return slope_[i]; }

 private:
  static double end_slope(double secant, double next_secant, double step, double next_step) {
    const double parabola = secant * (1 + step / (step + next_step)) - next_secant * step / (step + next_step);
    if (parabola * secant <= 0) return 0;
    return std::fabs(parabola) > 2 * std::fabs(secant) ? 2 * secant : parabola;
  }

  std::vector<double> x_, y_, slope_;
};

}  // namespace asperity
