// Temperatures live on Chebyshev's points of ln q, between which the barycentric form goes; T(q) is analytic to pi off
// the real axis. J.-P. Berrut, L. N. Trefethen, SIAM Rev. 46, 501 (2004).
#include "heat/heat_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/rounding.hpp"

namespace asperity {

using std::numbers::pi;

HeatGrid::HeatGrid(std::span<const Segment> surface, const ContactGridOptions& options,
                   const std::optional<double>& also)
    : ContactGrid(surface, options) {
  const double length = highest() - lowest(), off = 2 * pi / length;
  const double falling = std::log(off + std::sqrt(1 + off * off));
  const auto n = static_cast<std::size_t>(std::ceil(digits(options.level) * std::numbers::ln10 / falling)) + 4;
  if (also && !is_within(*also, std::exp(lowest()), std::exp(highest()))) {
    points_.push_back(*also);
    first_point_ = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = pi * static_cast<double>(k) / static_cast<double>(n - 1);
    points_.push_back(std::exp(lowest() + length * std::pow(std::sin(angle / 2), 2)));
  }
  for (const double q : points_) log_points_.push_back(std::log(q));
  to_nodes_.resize(static_cast<Eigen::Index>(size()), static_cast<Eigen::Index>(points_.size()));
  for (std::size_t j = 0; j < size(); ++j) to_nodes_.row(static_cast<Eigen::Index>(j)) = row_at(wavenumber()[j]);
  if (!also) return;
  also_felt_ =
      first_point_ == 1 ? Eigen::RowVectorXd::Unit(static_cast<Eigen::Index>(points_.size()), 0).eval() : row_at(*also);
}

// The barycentric form at Chebyshev's points: weights 1 with alternating signs, 1/2 at the ends.
Eigen::RowVectorXd HeatGrid::row_at(double wavenumber) const {
  const auto n = static_cast<Eigen::Index>(points_.size()), first = static_cast<Eigen::Index>(first_point_);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n);
  const double at = std::clamp(std::log(wavenumber), lowest(), highest());  // but for rounding it is so
  for (Eigen::Index k = first; k < n; ++k) {
    const double apart = at - log_points_[static_cast<std::size_t>(k)];
    if (std::fabs(apart) < 1e-15 * std::fmax(1, std::fabs(at))) return Eigen::RowVectorXd::Unit(n, k);
    row[k] = ((k - first) % 2 == 0 ? 1.0 : -1.0) * (k == first || k == n - 1 ? 0.5 : 1.0) / apart;
  }
  return row / row.sum();
}

}  // namespace asperity
