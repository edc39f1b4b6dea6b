// Eq. 23 through points, robustly: the least squares behind fit_adhesion, which know nothing of contact.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace asperity {

/// ln mu = ln(mu_H + share exp(p_0 - p_2 (x - p_1)^2)) with p = (ln tau_f0, log10 v0, c), an entry a point.
struct AdhesionPoints {
  Eigen::ArrayXd x;               // log10 v
  Eigen::ArrayXd log_mu;          // measured
  Eigen::ArrayXd log_hysteresis;  // ln mu_H, -infinity where there is none
  Eigen::ArrayXd log_share;       // ln((A / A0) / sigma0)
  double tolerance;               // of the last two, relative: finer scatter is theirs
  [[nodiscard]] Eigen::Index size() const { return x.size(); }
};

/// A parameter has a value where it is held.
using HeldParameters = std::array<std::optional<double>, 3>;

struct AdhesionCurve {
  Eigen::Vector3d at;          // p
  Eigen::Matrix3d covariance;  // of p, 0 where held
  double scale;                // robust standard deviation of ln mu about the curve
  Eigen::ArrayXd residual;     // ln mu - ln of the curve
  Eigen::ArrayXd weight;       // of each point, 0 where it was put aside
};

/// M-estimate of the curve with Tukey's biweight, and of the scale of its residuals, at once (P. J. Huber, Robust
/// Statistics (1981), Chapter 7), from starts of little scale: of several the one of least scale, as of S-estimates
/// (V. J. Yohai, Ann. Stat. 15, 642 (1987)). Nothing where the points have no such curve: parameters run away.
std::optional<AdhesionCurve> fit_adhesion_curve(const AdhesionPoints& points, const HeldParameters& held);

}  // namespace asperity
