// Decompositions by Eigen: A P = Q R with pivoted columns and its complete orthogonal form; eigenvalues and
// eigenvectors by implicit QR (G. H. Golub and C. F. Van Loan, Matrix Computations (1996), section 8.3); and the active
// set method for unknowns that are not negative (C. L. Lawson and R. J. Hanson, Solving Least Squares Problems (1974),
// chapter 23), whose every step is such a decomposition.
#include "numerics/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <limits>
#include <vector>

#include "asperity/errors.hpp"
#include "asperity/watch.hpp"

namespace asperity {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// min |A_P z - b| over the columns P alone, by a rank revealing QR: of dependent columns some get 0.
VectorXd solve_passive(const MatrixXd& a, const VectorXd& b, const std::vector<Index>& passive) {
  return Eigen::ColPivHouseholderQR<MatrixXd>(a(Eigen::all, passive)).solve(b);
}

/// From x towards z, its new values of the passive columns, until the first unknown is zero.
void step_towards(const VectorXd& z, const std::vector<Index>& passive, VectorXd& x) {
  double share = 1;
  Index zero = 0;
  for (Index i = 0; i < z.size(); ++i) {
    const double from = x[passive[static_cast<std::size_t>(i)]];
    if (z[i] <= 0 && from / (from - z[i]) <= share) {
      share = from / (from - z[i]);
      zero = i;
    }
  }
  for (Index i = 0; i < z.size(); ++i) {
    double& value = x[passive[static_cast<std::size_t>(i)]];
    value = i == zero ? 0 : value + share * (z[i] - value);
  }
}

}  // namespace

VectorXd shortest_solution(const MatrixXd& a, const VectorXd& b) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a).solve(b);
}

MatrixXd inverse_normal(const MatrixXd& jacobian, const VectorXd& weight) {
  const MatrixXd normal = jacobian.transpose() * weight.asDiagonal() * jacobian;
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(normal).pseudoInverse();
}

Eigen::Matrix3d inverse(const Eigen::Matrix3d& a) { return a.inverse(); }

PrincipalAxes principal_axes(const MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(symmetric);
  return {axes.eigenvalues(), axes.eigenvectors()};
}

MatrixXd congruence(const MatrixXd& a, const MatrixXd& c) {
  const MatrixXd left = a * c;
  return left * a.transpose();
}

// Conditions of Karush, Kuhn and Tucker, which the answer fulfils to rounding: with g = A^T (b - A x), g_k = 0 where
// x_k > 0 (the passive set P) and g_k <= 0 where x_k = 0.
VectorXd nnls(const MatrixXd& original, const VectorXd& right) {
  const Index n = original.cols();
  // Unit columns: the choice of the next column and the tolerances know no units. A column of zeros stays at x = 0.
  VectorXd norm = original.colwise().norm();
  for (double& value : norm)
    if (!(value > 0)) value = 1;
  MatrixXd a(original.rows(), n + 1);
  a.leftCols(n) = original * norm.cwiseInverse().asDiagonal();
  a.col(n) = right;
  // |A x - b| = |R P^T (x; -1)| with [A b] P = Q R: Q is not needed, and all that follows is as small as R.
  if (a.rows() > n + 1) {
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
    const MatrixXd r = qr.matrixQR().topRows(n + 1).triangularView<Eigen::Upper>();
    a.resize(n + 1, n + 1);
    for (Index k = 0; k <= n; ++k) a.col(qr.colsPermutation().indices()[k]) = r.col(k);
  }
  const VectorXd b = a.col(n);
  a.conservativeResize(Eigen::NoChange, n);

  const double tolerance = 10 * std::numeric_limits<double>::epsilon() * static_cast<double>(a.rows() + n) * b.norm();
  VectorXd x = VectorXd::Zero(n);
  std::vector<Index> passive;
  std::vector<bool> out(static_cast<std::size_t>(n), true);  // neither passive nor refused since x last changed
  const Index limit = 30 * n + 100;
  for (Index step = 0; step < limit; ++step) {
    heed();
    const VectorXd gradient = a.transpose() * (b - a * x);
    Index enters = -1;
    for (Index k = 0; k < n; ++k)
      if (out[static_cast<std::size_t>(k)] && gradient[k] > (enters < 0 ? tolerance : gradient[enters])) enters = k;
    if (enters < 0) return x.cwiseQuotient(norm);
    out[static_cast<std::size_t>(enters)] = false;
    passive.push_back(enters);
    VectorXd z = solve_passive(a, b, passive);
    // A gradient above zero promises z > 0 for the new column. Where rounding breaks the promise the column depends on
    // those of P; let in, it would leave at once and come again for ever.
    if (!(z[z.size() - 1] > 0)) {
      passive.pop_back();
      continue;
    }
    while (!passive.empty() && !(z.minCoeff() > 0)) {
      step_towards(z, passive, x);
      std::erase_if(passive, [&](Index k) { return !(x[k] > 0); });
      z = solve_passive(a, b, passive);
    }
    x.setZero();
    for (Index i = 0; i < z.size(); ++i) x[passive[static_cast<std::size_t>(i)]] = z[i];
    for (Index k = 0; k < n; ++k) out[static_cast<std::size_t>(k)] = !(x[k] > 0);
  }
  throw NotConverged("non-negative least squares of " + std::to_string(n) + " unknowns: no end after " +
                     std::to_string(limit) + " steps");
}

}  // namespace asperity
