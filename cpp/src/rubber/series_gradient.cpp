// I1 = 2 pi sum_k E_k s_k / t_k and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), w_k = 2 E_k (E_inf + sum_l E_l / (1 + tau_k /
// tau_l)), t_k = w tau_k, s_k = 1 - 1 / sqrt(1 + t_k^2), of which ds / d ln t = t^2 / (1 + t^2)^(3/2).
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

constexpr Index points = 8;     // of a polynomial
constexpr double step = 0.125;  // of ln w; its error is 1e-8

const Lagrange<points> lagrange({0, 1, 2, 3, 4, 5, 6, 7});

}  // namespace

SeriesSlopes::SeriesSlopes(const PronySeries& series, double lowest, double highest)
    : series_(series), first_((std::floor(std::log(lowest) / step) - points) * step) {
  const auto n = static_cast<Index>(series.moduli().size());
  const auto count = static_cast<Index>(std::ceil(std::log(highest / lowest) / step)) + 2 * points;
  for (auto* const matrix : {&share_over_t_, &share_, &slope_over_t_, &slope_}) matrix->resize(n, count);
  for (Index j = 0; j < count; ++j)
    for (Index k = 0; k < n; ++k) {
      const double t = std::fmin(
          std::exp(first_ + static_cast<double>(j) * step) * series.relaxation_times()[static_cast<std::size_t>(k)],
          1e140);  // whose square is a double
      const double root = std::sqrt(1 + t * t);
      share_over_t_(k, j) = t / (root * (1 + root));
      share_(k, j) = t * share_over_t_(k, j);
      slope_over_t_(k, j) = t / root / root / root;
      slope_(k, j) = t * slope_over_t_(k, j);
    }
}

SeriesGradient SeriesSlopes::operator()(const IntegralSlopes& of) const {
  const Index count = share_.cols(), n = share_.rows();
  VectorXd by_i1 = VectorXd::Zero(count), by_i2 = by_i1;
  Index begin = count, end = 0;
  // of I2 as a whole, and of its part by E'' what it has beside that
  std::vector<double> beside(of.w.size());
  for (std::size_t j = 0; j < of.w.size(); ++j) {
    const double x = std::clamp((std::log(of.w[j]) - first_) / step, 0.0, static_cast<double>(count - 1));
    const Index from = std::clamp<Index>(static_cast<Index>(x) - points / 2 + 1, 0, count - points);
    const std::array<double, points> share = lagrange(x - static_cast<double>(from));
    const Eigen::Map<const Eigen::Matrix<double, points, 1>> shares(share.data());
    by_i1.segment<points>(from) += of.i1[j] * shares;
    by_i2.segment<points>(from) += of.storage[j] * shares;
    beside[j] = of.loss[j] - of.storage[j];
    begin = std::min(begin, from);
    end = std::max(end, from + points);
  }
  if (end == 0) begin = 0;
  const auto over = [&](const Eigen::MatrixXd& known, const VectorXd& by) -> VectorXd {
    return 2 * pi * (known.middleCols(begin, end - begin) * by.segment(begin, end - begin));
  };
  const auto e = VectorXd::Map(series_.moduli().data(), n), weights = VectorXd::Map(series_.weights().data(), n);
  const std::vector<double>& tau = series_.relaxation_times();
  const double e_inf = series_.equilibrium_modulus();
  // over E_k as it stands in I1 and over w_k
  const VectorXd linear = over(share_over_t_, by_i1), weight = over(share_, by_i2);
  SeriesGradient result;
  result.equilibrium_modulus = 4 * pi * e_inf * e_inf * by_i2.sum() + 2 * e_inf * weight.dot(e);
  result.moduli = e.cwiseProduct(linear) + weight.cwiseProduct(weights);
  result.relaxation_times =
      e.cwiseProduct(over(slope_over_t_, by_i1) - linear) + weights.cwiseProduct(over(slope_, by_i2));
  for (Index k = 0; k < n; ++k)
    for (Index l = 0; l < n; ++l) {
      const double ratio = tau[static_cast<std::size_t>(k)] / tau[static_cast<std::size_t>(l)];
      const double part = weight[k] * 2 * e[k] * e[l] / (1 + ratio);
      result.moduli[l] += part;
      const double moved = part * ratio / (1 + ratio);  // d / d ln(tau_k / tau_l), its sign apart
      result.relaxation_times[k] -= moved;
      result.relaxation_times[l] += moved;
    }
  if (std::ranges::any_of(beside, [](double one) { return one != 0; }))
    loss_part_gradient(series_, of.w, beside, {result.moduli.data(), static_cast<std::size_t>(n)},
                       {result.relaxation_times.data(), static_cast<std::size_t>(n)});
  return result;
}

}  // namespace asperity
