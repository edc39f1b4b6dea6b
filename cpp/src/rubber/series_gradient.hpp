// From slopes over a modulus to those over the numbers of a Prony series.
#pragma once

#include <Eigen/Core>
#include <span>

#include "asperity/rubber.hpp"

namespace asperity {

/// Over ln E_inf, then ln E_k, then ln tau_k.
class SeriesSlopes {
 public:
  /// Slopes are known over ln E' and ln E'' at `nodes` [rad/s], between which these are polynomials of ln w.
  SeriesSlopes(const PronySeries& series, std::span<const double> nodes);
  /// Those of ln E' and ln E'' at one frequency, a column each.
  [[nodiscard]] Eigen::MatrixX2d at(double w) const;
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& storage, const Eigen::VectorXd& loss) const {
    return storage_ * storage + loss_ * loss;
  }

 private:
  const PronySeries& series_;
  Eigen::MatrixXd storage_, loss_;  // a column a node
};

}  // namespace asperity
