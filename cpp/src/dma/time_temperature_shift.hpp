// Isotherms against each other: how far along log10 w each must move to lie on one curve with all others, the curve as
// two penalised splines, and the notes on it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "asperity/dma.hpp"
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

inline constexpr double least_overlap = 0.3;  // decades that neighbours should share

/// Whether the values of two sweeps meet at all: E' of one lies within that of the other somewhere.
bool meet(const Isotherm& a, const Isotherm& b, double b_a, double b_b);

/// The likeliest shifts.
struct ShiftFit {
  Eigen::VectorXd unknowns;  // of ShiftLikelihood
  Eigen::MatrixXd inverse;   // of the Hessian, as the search has it
  double weight;             // of the data against the prior
};
/// From the pair search, or from unknowns that are known to be near.
ShiftFit fit_shifts(ShiftLikelihood& likelihood, const Smoothness& smoothness);
ShiftFit fit_shifts(ShiftLikelihood& likelihood, const Smoothness& smoothness, const Eigen::VectorXd& near,
                    double weight);

/// Whether each isotherm overlaps the next hotter one by what both measured, beyond chance.
std::vector<bool> neighbours_tied(const SweepPoints& points, const Smoothness& smoothness,
                                  const std::vector<double>& shift);

/// The covariance of the shifts [decades squared], zero at `fixed`: the curvature of the likelihood, and where a
/// plateau or a gap lets an isotherm slide farther than that says, how far.
Eigen::MatrixXd shift_covariance(ShiftLikelihood& likelihood, const ShiftFit& fit, const std::vector<bool>& tied,
                                 std::size_t fixed);

/// log10 a_T of the isotherms about `fixed`, their covariance and the spline they lie on.
struct Shifted {
  MasterSpline spline;
  std::vector<double> log10_a_T;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd unknowns;
  double weight;
  std::vector<bool> tied;  // of neighbours
};
/// With other vertical shifts from what the `first` ones gave, and then without covariance.
Shifted joint_shifts(const SweepPoints& points, std::size_t fixed, const Shifted* first = nullptr);

/// log10 a_T about `fixed` by E' alone and by E'' alone, and how far apart they are in standard deviations of that: 0
/// where none is farther than `least` [decades].
struct Disagreement {
  std::vector<double> storage, loss, deviations;
};
Disagreement moduli_apart(const SweepPoints& points, std::size_t fixed, const Shifted& both, double least);

/// Steps of log10 a_T [decades], positive: each isotherm lies that far below the colder one before it. `weight` is that
/// of ShiftLikelihood.
std::vector<double> search_steps(const SweepPoints& points, const Smoothness& smoothness, double weight);

/// b_T = T / T_ref.
std::vector<double> temperature_ratios(const std::vector<Isotherm>& isotherms, double reference);

using Notes = std::vector<Diagnostic>;
/// Neighbours that share less than they should once shifted.
void note_overlaps(const std::vector<Isotherm>& isotherms, const std::vector<double>& log10_a_T, Notes& notes);
/// Shifts that the data do not fix.
void note_undetermined(const std::vector<Isotherm>& isotherms, const std::vector<double>& deviation, Notes& notes);
/// Where E' alone and E'' alone ask for other shifts.
void note_disagreement(const std::vector<Isotherm>& isotherms, const Disagreement& apart, std::size_t fixed,
                       Notes& notes);
/// Points that lie farther from the spline than chance would have it. `shift`: in the spline's own frequencies.
void note_outliers(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, const MasterSpline& spline,
                   const std::vector<double>& shift, Notes& notes);
/// Isotherms that lie off the curve as wholes, by level, slope or bend, more than their scatter has it.
void note_misfit(const SweepPoints& points, const Shifted& fit, const std::vector<double>& b_T, Notes& notes);
/// The difference that the vertical shift b_T = T / T_ref would have made, where it matters.
void note_vertical_shift(const std::vector<Isotherm>& isotherms, const Shifted& first, std::size_t fixed,
                         double reference, Notes& notes);

/// Of ln E' and ln E'' together.
double residual_of(const MasterSpline& spline);

}  // namespace asperity
