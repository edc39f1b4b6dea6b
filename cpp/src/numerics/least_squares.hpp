// Dense least squares by Eigen's decompositions, on plain arrays: they take seconds to compile, in one file only.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Matrices are stored by columns.

/// The shortest of all x for which |A x - b| is least, A square: directions that A does not know are left out.
std::vector<double> shortest_solution(std::span<const double> a, std::span<const double> b);

/// The pseudo-inverse of J^T W J, `weight` being the diagonal of W and as long as each column of J.
std::vector<double> inverse_normal(std::span<const double> jacobian, std::span<const double> weight);

/// The inverse of a 3 x 3 matrix, by its cofactors.
std::array<double, 9> inverse(std::span<const double, 9> a);

}  // namespace asperity
