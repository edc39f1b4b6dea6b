// A master curve as two cubic splines that isotherms share, and the shifts that bring them onto it.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace asperity {

/// Points of all isotherms in logarithms, before any shift.
struct SweepPoints {
  Eigen::VectorXd x;              // ln w
  Eigen::VectorXd storage, loss;  // ln E', ln E'', vertical shift taken out
  std::vector<Eigen::Index> isotherm;
  Eigen::Index isotherms;
};

/// Cubic B-splines of ln E' and ln E'' over x + shift with equal knots, and the shifts that suit them best.
struct MasterSpline {
  double lower, spacing;                   // first knot, distance of knots, in x
  Eigen::VectorXd storage, loss;           // coefficients
  Eigen::VectorXd shift;                   // of each isotherm, in x; that of `fixed` is as given
  Eigen::MatrixXd covariance;              // of the shifts
  double storage_residual, loss_residual;  // rms
  double validation;                       // generalised cross-validation: what a new point would miss by, squared

  [[nodiscard]] double upper() const { return lower + spacing * static_cast<double>(storage.size() - 3); }
  /// ln E', ln E'' at x.
  [[nodiscard]] Eigen::Vector2d at(double x) const;
};

/// All shifts at once, from `start` on.
MasterSpline fit_master_spline(const SweepPoints& points, const Eigen::VectorXd& start, Eigen::Index fixed);

/// The same for moduli that are a little different, from the shifts and with about the knots of the first.
MasterSpline refit_master_spline(const SweepPoints& points, const MasterSpline& first, Eigen::Index fixed);

/// The splines for shifts that are known.
MasterSpline master_spline_at(const SweepPoints& points, const Eigen::VectorXd& shift);

}  // namespace asperity
