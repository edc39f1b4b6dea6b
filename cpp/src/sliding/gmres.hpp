// Generalised minimal residuals in single precision: as many digits as a Newton step needs.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <deque>

#include "numerics/dense.hpp"

namespace asperity {

/// Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986), preconditioned from the right; the
/// preconditioned vectors are kept (Saad's flexible variant, SIAM J. Sci. Comput. 14, 461 (1993)). Returns x with
/// |b - A x| <= tolerance |b|, or as near as `most` steps come, and sets how near that is. apply(from, to) and
/// precondition(from, to) on as many numbers as b has.
template <class Apply, class Precondition>
Eigen::VectorXf gmres(const Eigen::VectorXf& b, double tolerance, Eigen::Index most, Apply apply,
                      Precondition precondition, double& residual) {
  Eigen::VectorXf x = Eigen::VectorXf::Zero(b.size());
  const float norm = b.norm();
  residual = 0;
  if (!(norm > 0)) return x;
  std::deque<Eigen::VectorXf> basis{b / norm}, directions;
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(most + 1, most);  // of A times directions with the basis
  Eigen::VectorXd combination;
  residual = 1;
  for (Eigen::Index j = 0; j < most && residual > tolerance; ++j) {
    Eigen::VectorXf &direction = directions.emplace_back(b.size()), next(b.size());
    precondition(basis.back().data(), direction.data());
    apply(direction.data(), next.data());
    for (Eigen::Index i = 0; i <= j; ++i) products(i, j) = basis[static_cast<std::size_t>(i)].dot(next);
    for (Eigen::Index i = 0; i <= j; ++i)
      next -= static_cast<float>(products(i, j)) * basis[static_cast<std::size_t>(i)];
    const float length = next.norm();
    if (!std::isfinite(length)) break;
    products(j + 1, j) = length;
    const Eigen::VectorXd target = Eigen::VectorXd::Unit(j + 2, 0);
    combination = shortest_solution(products.topLeftCorner(j + 2, j + 1), target);
    residual = (products.topLeftCorner(j + 2, j + 1) * combination - target).norm();
    if (!(length > 0)) break;  // nothing left to add
    basis.push_back(next / length);
  }
  for (Eigen::Index j = 0; j < combination.size(); ++j)
    x += static_cast<float>(combination[j]) * norm * directions[static_cast<std::size_t>(j)];
  return x;
}

}  // namespace asperity
