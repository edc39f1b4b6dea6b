// I1 = 2 pi sum_k E_k s_k / t_k and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), w_k = 2 E_k (E_inf + sum_l E_l / (1 + tau_k /
// tau_l)), t_k = w tau_k, r_k = sqrt(1 + t_k^2), s_k = 1 - 1 / r_k, of which ds / d ln t = t^2 / r^3. With u = -(r - 1)
// / (r + 1), d ln u / d ln t = 2 / r, L_m has u^m s / t in the place of s / t, and K_m -u^m / r in that of s.
#include "rubber/series_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

SeriesSlopes::SeriesSlopes(const PronySeries& series, double lowest, double highest)
    : series_(series), first_((std::floor(std::log(lowest) / step) - points) * step) {
  const auto n = static_cast<Index>(series.moduli().size());
  const auto count = static_cast<Index>(std::ceil(std::log(highest / lowest) / step)) + 2 * points;
  for (auto* const matrix : {&share_over_t_, &share_, &slope_over_t_, &slope_, &u_, &inverse_root_})
    matrix->resize(n, count);
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
      const double root = std::sqrt(1 + t * t), y = t / (1 + root);
      share_over_t_(k, j) = y / root;
      slope_over_t_(k, j) = y / root * ((1 + root) / root / root);
      share_(k, j) = t * share_over_t_(k, j);
      slope_(k, j) = t * slope_over_t_(k, j);
      u_(k, j) = -y * y;
      inverse_root_(k, j) = 1 / root;
    }
}

SeriesGradient SeriesSlopes::operator()(const IntegralSlopes& of) const {
  const Index count = share_.cols(), n = share_.rows();
  PlaceSlopes at(static_cast<std::size_t>(count), of);
  Index begin = count, end = 0;
  double by_whole_i2 = 0;
  for (const IntegralSlopes::Wave& wave : of.waves) {
    const double x = std::clamp((wave.log_w - first_) / step, 0.0, static_cast<double>(count - 1));
    const Index from = std::clamp<Index>(static_cast<Index>(x) - points / 2 + 1, 0, count - points);
    at.add(wave, lagrange(x - static_cast<double>(from)), static_cast<std::size_t>(from));
    by_whole_i2 += wave.storage;
    begin = std::min(begin, from);
    end = std::max(end, from + points);
  }
  at.finish();
  if (end == 0) begin = 0;
  const auto over = [&](const Eigen::MatrixXd& known, const Eigen::MatrixXd& by) -> VectorXd {
    return known.middleCols(begin, end - begin) * by.col(0).segment(begin, end - begin);
  };
  // over E_k as it stands in I1 and over w_k, and over ln t_k of both
  VectorXd linear = over(share_over_t_, at.i1), weight = over(share_, at.storage),
           linear_by_time = over(slope_over_t_, at.i1) - linear, weight_by_time = over(slope_, at.storage);
  Eigen::ArrayXd i1, i1_slope, i2, i2_slope, v;  // sums of a_m u^(m - 1), and these over u
  for (Index j = begin; j < end; ++j) {
    const Index first = std::max<Index>(j - points + 1, 0),
                columns = at.columns(static_cast<std::size_t>(first), static_cast<std::size_t>(j - first + 1));
    if (columns < 2) continue;
    for (auto* const sum : {&i1, &i1_slope, &i2, &i2_slope}) sum->setZero(n);
    const auto u = u_.col(j).array(), inverse = inverse_root_.col(j).array(), share = share_over_t_.col(j).array();
    for (Index m = columns - 1; m > 0; --m) {
      i1_slope = i1_slope * u + i1;
      i2_slope = i2_slope * u + i2;
      i1 = i1 * u + at.i1(j, m);
      i2 = i2 * u + at.storage(j, m);
    }
    v = 2 * u * inverse;  // du / d ln t
    linear.array() += share * (1 + u) * i1;
    linear_by_time.array() +=
        (slope_over_t_.col(j).array() - share) * (1 + u) * i1 + share * v * (i1 + (1 + u) * i1_slope);
    weight.array() -= v * i2;
    weight_by_time.array() -= v * ((2 * inverse - 1 + inverse * inverse) * i2 + v * i2_slope);
  }
  const auto e = VectorXd::Map(series_.moduli().data(), n), weights = VectorXd::Map(series_.weights().data(), n);
  const double e_inf = series_.equilibrium_modulus();
  for (VectorXd* const one : {&linear, &weight, &linear_by_time, &weight_by_time}) *one *= 2 * pi;
  SeriesGradient result;
  result.equilibrium_modulus = 4 * pi * e_inf * e_inf * by_whole_i2 + 2 * e_inf * weight.dot(e);
  result.moduli = e.cwiseProduct(linear) + weight.cwiseProduct(weights) + of_weights_ * weight;
  result.relaxation_times =
      e.cwiseProduct(linear_by_time) + weights.cwiseProduct(weight_by_time) + of_weights_by_time_ * weight;
  if (!of.parted) return result;
  // of I2 as a whole, and of its part by E'' what it has beside that
  const auto rows = static_cast<std::size_t>(at.i1.cols()) - 1;
  std::vector<double> w, beside(rows * of.waves.size());
  for (const IntegralSlopes::Wave& wave : of.waves) {
    const std::span<const double> rings = wave.rings.empty() ? of.mean : wave.rings;
    for (std::size_t m = 0; m < rings.size(); ++m)
      beside[rows * w.size() + m] = (m == 0 ? 1 : 2 * rings[m]) * (wave.loss - wave.storage);
    w.push_back(wave.w);
  }
  loss_part_gradient(series_, w, beside, {result.moduli.data(), static_cast<std::size_t>(n)},
                     {result.relaxation_times.data(), static_cast<std::size_t>(n)});
  return result;
}

}  // namespace asperity
