// I1 = 2 pi sum_k E_k s_k / t_k and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), w_k = 2 E_k (E_inf + sum_l E_l / (1 + tau_k /
// tau_l)), t_k = w tau_k, r_k = sqrt(1 + t_k^2), s_k = 1 - 1 / r_k, of which ds / d ln t = t^2 / r^3. With u = -(r - 1)
// / (r + 1), d ln u / d ln t = 2 / r, L_m has u^m s / t in the place of s / t, and K_m -u^m / r in that of s.
#include "rubber/series_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "numerics/interpolation.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

constexpr Index points = 8;    // of a polynomial
constexpr double step = 0.25;  // of ln w; its error is 3e-6

const Lagrange<points> lagrange({0, 1, 2, 3, 4, 5, 6, 7});

}  // namespace

SeriesSlopes::SeriesSlopes(const PronySeries& series, double lowest, double highest, std::size_t harmonics)
    : series_(series),
      harmonics_(static_cast<Index>(harmonics) + 1),
      first_((std::floor(std::log(lowest) / step) - points) * step) {
  const auto n = static_cast<Index>(series.moduli().size());
  const auto count = static_cast<Index>(std::ceil(std::log(highest / lowest) / step)) + 2 * points;
  for (auto* const matrix : {&share_over_t_, &share_, &slope_over_t_, &slope_}) matrix->resize(n, count * harmonics_);
  for (auto* const matrix : {&of_weights_, &of_weights_by_time_}) matrix->resize(n, n);
  const auto e = VectorXd::Map(series.moduli().data(), n), tau = VectorXd::Map(series.relaxation_times().data(), n);
  for (Index k = 0; k < n; ++k)
    for (Index l = 0; l < n; ++l) {
      const double share = 1 / (1 + tau[k] / tau[l]);
      of_weights_(l, k) = 2 * e[k] * e[l] * share;
      of_weights_by_time_(l, k) = of_weights_(l, k) / (1 + tau[l] / tau[k]);
    }
  of_weights_by_time_.diagonal() -= of_weights_by_time_.colwise().sum().transpose();
  for (Index j = 0; j < count; ++j)
    for (Index k = 0; k < n; ++k) {
      const double t = std::fmin(std::exp(first_ + static_cast<double>(j) * step) * tau[k], largest_x);
      const double root = std::sqrt(1 + t * t);
      const double y = t / (1 + root);
      double power = 1;  // u^m
      for (Index m = 0; m < harmonics_; ++m, power *= -y * y) {
        const Index column = j * harmonics_ + m;
        const double rise = 2 * static_cast<double>(m) / root;  // d ln u^m / d ln t
        share_over_t_(k, column) = power * y / root;
        slope_over_t_(k, column) = share_over_t_(k, column) * ((1 + root) / root / root + rise);
        share_(k, column) = m == 0 ? t * share_over_t_(k, column) : -power / root;
        slope_(k, column) = m == 0 ? t * slope_over_t_(k, column) : share_(k, column) * (rise - t / root * (t / root));
      }
    }
}

SeriesGradient SeriesSlopes::operator()(const IntegralSlopes& of) const {
  const Index count = share_.cols() / harmonics_, n = share_.rows();
  VectorXd by_i1 = VectorXd::Zero(share_.cols()), by_i2 = by_i1;
  Index begin = share_.cols(), end = 0;
  double by_whole_i2 = 0;
  for (std::size_t j = 0; j < of.w.size(); ++j) {
    const double x = std::clamp((of.log_w[j] - first_) / step, 0.0, static_cast<double>(count - 1));
    const Index from = std::clamp<Index>(static_cast<Index>(x) - points / 2 + 1, 0, count - points);
    const std::array<double, points> share = lagrange(x - static_cast<double>(from));
    spread(share, &of.i1[j * of.rows], of.rows, &by_i1[from * harmonics_]);
    spread(share, &of.storage[j * of.rows], of.rows, &by_i2[from * harmonics_]);
    by_whole_i2 += of.storage[j * of.rows];
    begin = std::min(begin, from * harmonics_);
    end = std::max(end, (from + points) * harmonics_);
  }
  if (end == 0) begin = 0;
  const auto over = [&](const Eigen::MatrixXd& known, const VectorXd& by) -> VectorXd {
    return 2 * pi * (known.middleCols(begin, end - begin) * by.segment(begin, end - begin));
  };
  const auto e = VectorXd::Map(series_.moduli().data(), n), weights = VectorXd::Map(series_.weights().data(), n);
  const double e_inf = series_.equilibrium_modulus();
  // over E_k as it stands in I1 and over w_k
  const VectorXd linear = over(share_over_t_, by_i1), weight = over(share_, by_i2);
  SeriesGradient result;
  result.equilibrium_modulus = 4 * pi * e_inf * e_inf * by_whole_i2 + 2 * e_inf * weight.dot(e);
  result.moduli = e.cwiseProduct(linear) + weight.cwiseProduct(weights) + of_weights_ * weight;
  result.relaxation_times = e.cwiseProduct(over(slope_over_t_, by_i1) - linear) +
                            weights.cwiseProduct(over(slope_, by_i2)) + of_weights_by_time_ * weight;
  if (!of.parted) return result;
  std::vector<double> beside(of.loss.size());  // of I2 as a whole, and of its part by E'' what it has beside that
  std::ranges::transform(of.loss, of.storage, beside.begin(), std::minus());
  loss_part_gradient(series_, of.w, beside, {result.moduli.data(), static_cast<std::size_t>(n)},
                     {result.relaxation_times.data(), static_cast<std::size_t>(n)});
  return result;
}

}  // namespace asperity
