// A master curve as two penalised splines that isotherms share, and how far its coefficients are known.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "dma/shift_likelihood.hpp"

namespace asperity {

/// ln E' and ln E'' over log10 of the reduced frequency.
struct MasterSpline {
  double lowest, highest;  // of the points, log10 w
  double lower;            // first knot
  std::array<std::vector<double>, moduli> coefficients;
  std::array<double, moduli> residual;  // standard deviation of the points about the curve

  /// ln E', ln E'' at x = log10 w.
  [[nodiscard]] Eigen::Vector2d at(double x) const;
  /// At ten frequencies a decade, moved by `shift` [decades].
  [[nodiscard]] MasterCurve sampled(double shift, std::optional<Extrapolation> extrapolation) const;
  /// The same curve in frequencies that are `distance` [decades] higher.
  void move(double distance);
};

/// The splines of the last evaluation of a likelihood. `shifted` shifts were fitted to the points too.
MasterSpline master_spline(ShiftLikelihood& likelihood, std::size_t shifted);

/// Points as a curve, those within a share of a decade as their mean in the logarithm: a curve needs rising
/// frequencies.
MasterCurve merged_points(const std::vector<MasterPoint>& points, std::optional<Extrapolation> extrapolation);

/// What share of the points counts as independent, their residuals being correlated within isotherms: (1 - r) / (1 + r)
/// for a correlation r of neighbours, one isotherm being one point at the least.
double independent_share(ShiftLikelihood& likelihood);

/// The spline for shifts that are known.
MasterSpline master_spline_at(const SweepPoints& points, const std::vector<double>& shift);

/// ln of the factors on the penalties that are likeliest for shifts that are known; evaluates the likelihood there.
std::array<double, moduli> fit_factors(ShiftLikelihood& likelihood, std::span<const double> shift);

}  // namespace asperity
