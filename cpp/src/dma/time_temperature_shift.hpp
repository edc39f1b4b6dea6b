// Isotherms against each other: how far along log10 w each must move to lie on one curve with all others.
#pragma once

#include <string>
#include <vector>

#include "asperity/dma.hpp"
#include "dma/master_spline.hpp"

namespace asperity {

inline constexpr double least_overlap = 0.3;  // decades that neighbours should share

/// Whether the values of two sweeps meet at all: E' of one lies within that of the other somewhere.
bool meet(const Isotherm& a, const Isotherm& b, double b_a, double b_b);

/// The likeliest shifts, and the likelihood there.
struct ShiftFit {
  Eigen::VectorXd unknowns;  // of ShiftLikelihood
  Eigen::MatrixXd inverse;   // of the Hessian, as the search has it
  double weight;             // of the data against the prior
  double value;
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
Shifted joint_shifts(const SweepPoints& points, std::size_t fixed);
/// The same with other vertical shifts, from what the first ones gave; no covariance.
Shifted joint_shifts(const SweepPoints& points, std::size_t fixed, const Shifted& first);

/// log10 a_T about `fixed` by E' alone and by E'' alone, and how far apart they are in standard deviations of that: 0
/// where none is farther than `least` [decades].
struct Disagreement {
  std::vector<double> storage, loss, deviations;
};
Disagreement moduli_apart(const SweepPoints& points, std::size_t fixed, const Shifted& both, double least);

}  // namespace asperity
