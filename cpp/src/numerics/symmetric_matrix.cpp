// Eigenvalues and eigenvectors of a symmetric matrix by Eigen's implicit QR (G. H. Golub and C. F. Van Loan, Matrix
// Computations (1996), section 8.3): its templates take six seconds to compile, in this file only.
#include "numerics/symmetric_matrix.hpp"

#include <Eigen/Eigenvalues>

namespace asperity {

PrincipalAxes principal_axes(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(symmetric);
  return {axes.eigenvalues(), axes.eigenvectors()};
}

Eigen::MatrixXd congruence(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c) {
  const Eigen::MatrixXd left = a * c;
  return left * a.transpose();
}

}  // namespace asperity
