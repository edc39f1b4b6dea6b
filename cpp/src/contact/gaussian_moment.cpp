#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

#include "asperity/asperities.hpp"
#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using std::numbers::pi;

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

/// ln of the moment for |t| <= 100, with t^2 / 2 added where t > 0, as Chebyshev series in w = asinh t on panels half a
/// unit wide, made when first asked for: a root search asks dozens of times within one panel. 24 terms leave 2e-15.
class Table {
 public:
  static constexpr double end = 100;

  double operator()(double t) {
    const double w = std::asinh(t) - lowest;
    const auto i = static_cast<std::size_t>(w / width);
    Panel& panel = panels_[i];
    std::call_once(panel.made, [&] { make(i); });
    const double x = 2 * (w / width - static_cast<double>(i)) - 1;
    double b1 = 0, b2 = 0;  // Clenshaw's sum
    for (std::size_t k = terms; k-- > 1;) {
      const double b = panel.series[k] + 2 * x * b1 - b2;
      b2 = b1;
      b1 = b;
    }
    return panel.series[0] + x * b1 - b2 - (t > 0 ? t * t / 2 : 0);
  }

 private:
  static constexpr std::size_t terms = 24, panels = 22;
  static constexpr double width = 0.5, lowest = -0.5 * (panels / 2);  // panels meet at t = 0

  struct Panel {
    std::once_flag made;
    std::array<double, terms> series{};
  };

  void make(std::size_t i) {
    std::array<double, terms>& series = panels_[i].series;
    for (std::size_t n = 0; n < terms; ++n) {
      const double angle = pi * (static_cast<double>(n) + 0.5) / terms;
      const double t = std::sinh(lowest + width * (static_cast<double>(i) + (std::cos(angle) + 1) / 2));
      const double f = integrated(t) + (i >= panels / 2 ? t * t / 2 : 0);
      for (std::size_t k = 0; k < terms; ++k)
        series[k] += (k == 0 ? 1.0 : 2.0) / terms * f * std::cos(static_cast<double>(k) * angle);
    }
  }

  std::array<Panel, panels> panels_;
};

}  // namespace

// Deep in contact the whole Gaussian counts, and <(1 + x / |t|)^1.5> is summed in its even moments 1, 3, 15: the next
// term is 0.34 / t^8. Far out, with s = y / t, exp(-s^2 / 2) is expanded under Gamma's integral of y^1.5 exp(-y): the
// next term is 500 / t^8.
double log_gaussian_moment(double t) {
  require_finite("t", t);
  const double u = 1 / t / t;
  if (t < -Table::end) return 1.5 * std::log(-t) + std::log1p(u * (3.0 / 8 + u * (9.0 / 128 + u * (105.0 / 1024))));
  if (t > Table::end) {
    const double series = u * (-35.0 / 8 + u * (3465.0 / 128 + u * (-225225.0 / 1024)));
    return -t * t / 2 + std::log(3.0 / (4 * std::numbers::sqrt2)) - 2.5 * std::log(t) + std::log1p(series);
  }
  static Table table;
  return table(t);
}

}  // namespace asperity
