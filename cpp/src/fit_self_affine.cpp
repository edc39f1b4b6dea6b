#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/spectrum.hpp"
#include "checks.hpp"
#include "integrate.hpp"

namespace asperity {

using std::numbers::pi;

// ln C = b + a (ln q - m), m the weighted mean of ln q, so that a and b are uncorrelated. H = -a / 2 - 1 (Eq. 28),
// and h_rms^2 = 2 pi int q C dq = 2 pi e^b J(a), J = int exp(2 x + a (x - m)) dx over x = ln q in the band.
SelfAffineFit fit_self_affine(const TabulatedSpectrum& spectrum, std::optional<double> q_min,
                              std::optional<double> q_max) {
  if (q_min) require_positive("q_min", *q_min);
  if (q_max) require_positive("q_max", *q_max);
  if (q_min && q_max && !(*q_max > *q_min)) refuse("q_max", *q_max, "above q_min = " + show(*q_min));
  const auto& q = spectrum.wavenumber();
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const bool counts = spectrum.count().empty() || spectrum.count()[i] > 0;
    if (counts && (!q_min || q[i] >= *q_min) && (!q_max || q[i] <= *q_max)) rows.push_back(i);
  }
  if (rows.size() < 3)
    throw InvalidInput("q_min, q_max: " + std::to_string(rows.size()) + " rows of the spectrum in [" +
                       show(q_min.value_or(q.front())) + ", " + show(q_max.value_or(q.back())) +
                       "] 1/m: must be 3 or more for a fit");

  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::ArrayXd x(n), y(n), w(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    if (spectrum.density()[row] == 0)
      refuse("density[" + std::to_string(row) + "]", 0,
             "positive for a fit in the logarithm; q_min, q_max may leave it out");
    x[i] = std::log(q[row]);
    y[i] = std::log(spectrum.density()[row]);
    w[i] = spectrum.count().empty() ? 1 : spectrum.count()[row];
  }
  w /= w.sum();
  const double mean_x = (w * x).sum(), b = (w * y).sum();
  const double spread = (w * (x - mean_x).square()).sum();
  const double a = (w * (x - mean_x) * (y - b)).sum() / spread;
  const double hurst = -a / 2 - 1;
  if (!(hurst > 0 && hurst <= 1))
    throw InvalidInput("spectrum: falls as q^" + show(a, 4) + " between " + show(q[rows.front()]) + " and " +
                       show(q[rows.back()]) + " 1/m, hurst = " + show(hurst, 4) + ": must be in (0, 1]");
  const double scatter = (w * (y - b - a * (x - mean_x)).square()).sum() / static_cast<double>(n - 2);

  const auto power = [&](double at) { return std::exp(2 * (at - mean_x) + a * (at - mean_x)); };
  const double area = integrate(power, x[0], x[n - 1], 1e-12).value;
  const double first =
      integrate([&](double at) { return (at - mean_x) * power(at); }, x[0], x[n - 1], 1e-9, 1e-9 * area).value;
  const double rms = std::sqrt(2 * pi * area) * std::exp(b / 2 + mean_x);
  // d ln h_rms / db = 1/2, d ln h_rms / da = <x - m> / 2
  const double error_a = std::sqrt(scatter / spread), error_b = std::sqrt(scatter);
  const double relative = std::hypot(error_b, first / area * error_a) / 2;
  return {{.rms_height = rms, .hurst = hurst, .q0 = q[rows.front()], .q1 = q[rows.back()]},
          rms * relative,
          error_a / 2,
          rows.size()};
}

}  // namespace asperity
