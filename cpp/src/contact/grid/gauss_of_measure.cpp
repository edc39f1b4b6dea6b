// Orthonormal polynomials by the Lanczos recurrence, and their Gauss rule from the eigenvectors of the Jacobi matrix
// (G. H. Golub and J. H. Welsch, Math. Comp. 23, 221 (1969)).
#include "contact/grid/gauss_of_measure.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Column j of `p` has the square roots of the weights times p_j. Each next one is made orthogonal to all before it, as
// the recurrence alone forgets them where x takes few values nearly.
NodeRule gauss_rule(const std::vector<double>& weight, const std::vector<double>& x, std::size_t wanted) {
  const Eigen::Map<const VectorXd> at(x.data(), static_cast<Index>(x.size()));
  const Eigen::Map<const VectorXd> measure(weight.data(), at.size());
  const double whole = measure.sum();
  MatrixXd p(at.size(), static_cast<Index>(wanted));
  VectorXd diagonal(p.cols()), beside(p.cols());
  p.col(0) = (measure / whole).cwiseSqrt();
  Index degrees = 1;
  for (;; ++degrees) {
    const Index j = degrees - 1;
    VectorXd next = at.cwiseProduct(p.col(j));
    diagonal[j] = next.dot(p.col(j));
    if (degrees == p.cols()) break;
    for (int pass = 0; pass < 2; ++pass) next -= p.leftCols(degrees) * (p.leftCols(degrees).transpose() * next);
    beside[j] = next.norm();
    constexpr double least = 1e-9;
    if (!(beside[j] > least)) break;
    p.col(degrees) = next / beside[j];
  }
  Eigen::SelfAdjointEigenSolver<MatrixXd> axes;
  axes.computeFromTridiagonal(diagonal.head(degrees), beside.head(degrees - 1));
  NodeRule rule;
  for (Index i = 0; i < degrees; ++i) {
    const double first = axes.eigenvectors()(0, i);
    rule.x.push_back(axes.eigenvalues()[i]);
    rule.weight.push_back(whole * first * first);
  }
  return rule;
}

}  // namespace asperity
