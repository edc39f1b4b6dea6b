// N(x) = int_0^1 h(w) erfcx(x sqrt w) dw. For the box, h = 1, it is M(x) = (erfcx(x) - 1 + 2 x / sqrt pi) / x^2, and
// for the disc, by parts, N(x) = (4 / pi) int_0^1 w sqrt(1 - w^2) M(x sqrt w) dw. Since x M' = 2 (erfcx - M), Q = N -
// x N' is 3 M - 2 erfcx for the box and the same integral over it for the disc; all integrands are positive. The disc's
// functions are power series below x = 0.04, series in 1 / x beyond e^12.5, and polynomials in ln x between.
#include "heat/universal.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

using std::numbers::inv_sqrtpi;
using std::numbers::pi;

double scaled_erfc(double x) {
  if (x < 10) {
    const double square = x * x, rest = std::fma(x, x, -square);
    return std::exp(square) * (1 + rest) * std::erfc(x);
  }
  double sum = 1, term = 1;
  const double step = 0.5 / (x * x);
  for (int n = 1; n < 30 && std::fabs(term) > 1e-17; ++n) {
    term *= -(2 * n - 1) * step;
    sum += term;
  }
  return sum / x * inv_sqrtpi;
}

namespace {

HeatFunctions box(double x) {
  if (x < 0.5) {                                                   // M = sum (-x)^n / Gamma(n / 2 + 2)
    double n = 0, q = 0, even = 1, odd = -x * 4 / 3 * inv_sqrtpi;  // Gamma(2) = 1, Gamma(5/2) = 3 sqrt(pi) / 4
    for (int k = 0; k < 40; k += 2) {
      n += even + odd;
      q += (1 - k) * even - k * odd;
      even *= x * x / (0.5 * k + 2);
      odd *= x * x / (0.5 * (k + 1) + 2);
    }
    return {n, q};
  }
  const double e = scaled_erfc(x), m = (e - 1 + 2 * x * inv_sqrtpi) / (x * x);
  return {m, 3 * m - 2 * e};
}

/// c_n of the disc, with which N is sum c_n (-x)^n: (2 / pi) B(n/4 + 1, 3/2) / ((n/2 + 1) Gamma(n/2 + 1)).
std::array<double, 40> disc_coefficients() {
  std::array<double, 40> c{};
  for (std::size_t i = 0; i < c.size(); ++i) {
    const auto n = static_cast<double>(i);
    const double a = 0.25 * n + 1, beta = std::tgamma(a) * std::tgamma(1.5) / std::tgamma(a + 1.5);
    c[i] = 2 / pi * beta / ((0.5 * n + 1) * std::tgamma(0.5 * n + 1));
  }
  return c;
}

HeatFunctions disc_near_zero(double x) {
  static const std::array<double, 40> c = disc_coefficients();
  HeatFunctions sum{0, 0};
  double power = 1;
  for (std::size_t i = 0; i < c.size() && std::fabs(power) > 1e-18; ++i, power *= -x) {
    sum.n += c[i] * power;
    sum.q += (1 - static_cast<double>(i)) * c[i] * power;
  }
  return sum;
}

/// With w = sin^2(phi), on Gauss panels that halve towards phi = 0, where M(x sin phi) changes.
HeatFunctions disc_by_quadrature(double x) {
  const LegendreRule& rule = legendre_rule(24);
  HeatFunctions sum{0, 0};
  double upper = pi / 2;
  for (int panel = 0; panel < 22; ++panel) {
    const double lower = panel == 21 ? 0 : upper / 2, half = (upper - lower) / 2;
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double phi = lower + half * (1 + rule.node[i]), s = std::sin(phi), c = std::cos(phi);
      const double weight = half * rule.weight[i] * 8 / pi * c * c * std::sqrt(1 + s * s) * s * s * s;
      const HeatFunctions m = box(x * s);
      sum.n += weight * m.n;
      sum.q += weight * m.q;
    }
    upper = lower;
  }
  return sum;
}

// h's expansion at w = 0 gives the even powers of 1 / x and erfcx's the odd ones; c_h = (4 / pi) B(3/4, 3/2).
constexpr double c_h = 1.2204156216029011;
constexpr double c_3 = 2 * 3.4960767390561597 * inv_sqrtpi * inv_sqrtpi * inv_sqrtpi;  // B(1/4, 3/2)

HeatFunctions disc_far(double x) {
  const double first = c_h * inv_sqrtpi / x, second = -1 / (x * x), third = c_3 / (x * x * x);
  return {first + second + third, 2 * first + 3 * second + 4 * third};
}

/// (1 + x) N and (1 + x) Q as polynomials in ln x, on pieces of width 1/2, by way of Chebyshev sums.
class DiscTable {
 public:
  DiscTable() {
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      std::array<HeatFunctions, terms> sample{};
      for (std::size_t j = 0; j < terms; ++j) {
        const double x = std::exp(start + width * (static_cast<double>(piece) + 0.5 * (1 + std::cos(angle(j)))));
        sample[j] = disc_by_quadrature(x);
        sample[j].n *= 1 + x;
        sample[j].q *= 1 + x;
      }
      // sum of c_k T_k as powers: T_k+1 = 2 u T_k - T_k-1
      std::array<double, terms> now{1}, before{};
      for (std::size_t k = 0; k < terms; ++k) {
        HeatFunctions c{};
        for (std::size_t j = 0; j < terms; ++j) {
          const double weight = (k == 0 ? 1.0 : 2.0) / terms * std::cos(static_cast<double>(k) * angle(j));
          c.n += weight * sample[j].n;
          c.q += weight * sample[j].q;
        }
        std::array<double, terms> next{};
        for (std::size_t m = 0; m < terms; ++m) {
          power_[piece][m].n += c.n * now[m];
          power_[piece][m].q += c.q * now[m];
          next[m] = (m == 0 ? 0 : (k == 0 ? 1 : 2) * now[m - 1]) - before[m];
        }
        before = now;
        now = next;
      }
    }
  }

  [[nodiscard]] HeatFunctions operator()(double x) const {
    const double at = (std::log(x) - start) / width;
    const auto piece = static_cast<std::size_t>(std::fmin(std::fmax(at, 0), pieces - 1));
    const double u = 2 * (at - static_cast<double>(piece)) - 1, square = u * u;
    const auto& power = power_[piece];
    HeatFunctions even{0, 0}, odd{0, 0};
    for (std::size_t m = terms; m > 0; m -= 2) {
      odd = {odd.n * square + power[m - 1].n, odd.q * square + power[m - 1].q};
      even = {even.n * square + power[m - 2].n, even.q * square + power[m - 2].q};
    }
    const double scale = 1 / (1 + x);
    return {(even.n + u * odd.n) * scale, (even.q + u * odd.q) * scale};
  }

  static constexpr double start = -3.25, width = 0.5;
  static constexpr std::size_t pieces = 32, terms = 18;

 private:
  static double angle(std::size_t j) { return pi * (static_cast<double>(j) + 0.5) / terms; }
  std::array<std::array<HeatFunctions, terms>, pieces> power_{};
};

}  // namespace

HeatFunctions heat_functions(Residence residence, double x) {
  if (residence == Residence::box) return box(x);
  if (x < 0.04) return disc_near_zero(x);  // ln x = -3.22
  if (x > 2.7e5) return disc_far(x);       // ln x = 12.5
  static const DiscTable table;
  return table(x);
}

}  // namespace asperity
