// Least squares with unknowns that are not negative.
#pragma once

#include <Eigen/Core>

namespace asperity {

/// The x >= 0 that makes |A x - b| least: the active set method of Lawson and Hanson, Solving Least Squares Problems
/// (1974), chapter 23. Columns of A may be nearly dependent: no normal equations are formed.
Eigen::VectorXd nnls(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace asperity
