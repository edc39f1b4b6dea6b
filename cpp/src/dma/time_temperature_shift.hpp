// Isotherms against each other: how far along ln w each must move to lie on its neighbours.
#pragma once

#include <string>
#include <vector>

#include "asperity/dma.hpp"
#include "dma/master_spline.hpp"

namespace asperity {

constexpr double least_overlap = 0.3;  // decades that neighbours should share

std::string kelvin(const Isotherm& isotherm);

/// Whether the values of two sweeps meet at all: E' of one lies within that of the other somewhere.
bool meet(const Isotherm& a, const Isotherm& b, double b_a, double b_b);

/// The points of all isotherms in logarithms, divided by b_T.
SweepPoints gather(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T);

/// log10 a_T of the isotherms, their deviations and the spline they lie on.
struct Shifted {
  MasterSpline spline;
  std::vector<double> log10_a_T, deviation;
};
/// From neighbour to neighbour, then all at once; the isotherm nearest to the reference stays where its neighbours put
/// it.
Shifted joint_shifts(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, double reference);
/// The same with other vertical shifts, from what the first ones gave.
Shifted joint_shifts(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, double reference,
                     const Shifted& first);

}  // namespace asperity
