// Symmetric matrices of a few rows: covariances, and the curvature of a likelihood.
#pragma once

#include <Eigen/Core>

namespace asperity {

/// A = V diag(values) V^T, the columns of V orthonormal.
struct PrincipalAxes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
PrincipalAxes principal_axes(const Eigen::MatrixXd& symmetric);

/// A C A^T, the covariance of A x where C is that of x.
Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c);

}  // namespace asperity
