// Sums over the cells of a grid, and how far two grids are apart in them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact/grid/grid.hpp"

namespace asperity {

/// Sums over the nodes of each cell, those of the edges' panels behind the others.
void sum_cells(const ContactGrid& grid, const Eigen::VectorXd& part, Eigen::VectorXd& sums);

/// The same of panels, with their ends [1/m].
struct PanelSum {
  double lower, upper, sum;
};
std::vector<PanelSum> sums_of_panels(const ContactGrid& grid, const Eigen::VectorXd& part);

/// How many cells of a coarse and of a fine grid end at the same wavenumber, for ends that both have and that have so
/// many nodes of the coarse one between them.
using CommonEnds = std::vector<std::array<Eigen::Index, 2>>;
CommonEnds common_ends(const ContactGrid& coarse, const ContactGrid& fine, Eigen::Index between = 1);

/// How far two grids are apart at most in the sum of all cells up to an end that both have, as errors that cancel in
/// the whole do not all the way; 0 where either has no sums.
double most_apart(const Eigen::VectorXd& of_coarse, const Eigen::VectorXd& of_fine, const CommonEnds& ends);

}  // namespace asperity
