// Dense matrices by Eigen's decompositions, whose templates take seconds to compile: in one file only.
#pragma once

#include <Eigen/Core>

namespace asperity {

/// The shortest of all x for which |A x - b| is least: directions that A does not know are left out.
Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The pseudo-inverse of J^T W J, `weight` being the diagonal of W.
Eigen::MatrixXd inverse_normal(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weight);

/// The inverse, by its cofactors.
Eigen::Matrix3d inverse(const Eigen::Matrix3d& a);

/// The x >= 0 that makes |A x - b| least: the active set method of Lawson and Hanson, Solving Least Squares Problems
/// (1974), chapter 23. Columns of A may be nearly dependent: no normal equations are formed.
Eigen::VectorXd nnls(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// A = V diag(values) V^T of a symmetric matrix, the columns of V orthonormal.
struct PrincipalAxes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
PrincipalAxes principal_axes(const Eigen::MatrixXd& symmetric);

/// A C A^T, the covariance of A x where C is that of x.
Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c);

}  // namespace asperity
