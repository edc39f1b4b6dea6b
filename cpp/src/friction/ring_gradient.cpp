#include "friction/ring_gradient.hpp"

#include <cmath>

#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/differences.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RingGradient::RingGradient(const Directions& directions, const ContactGrid& grid, std::size_t harmonics)
    : directions_(directions), grid_(grid) {
  const Rings rings = directions.at_nodes(grid);
  const auto n = static_cast<Index>(grid.size()), count = static_cast<Index>(harmonics);
  const Eigen::Map<const MatrixXd> along(rings.along.data(), n, static_cast<Index>(rings.count)),
      across(rings.across.data(), n, static_cast<Index>(rings.count));
  values_.resize(n, count + 1);
  values_ << along.leftCols(count), across.leftCols(1);
  slopes_.resize(n, count + 1);
  for (Index m = 0; m < count; ++m) slopes_.col(m) = 2 * static_cast<double>(m + 1) * across.col(m);
  slopes_.col(count) = -2 * along.col(0);
  of_i1_.setZero(count + 1, n);
  of_i1_.row(0).setOnes();
  of_i1_.topRows(count) += values_.leftCols(count).transpose();
  of_i1_.bottomRows(count) += values_.leftCols(count).transpose();
  of_i2_.setOnes(count + 1, n);
  of_i2_.bottomRows(count) = 2 * values_.leftCols(count).transpose();
}

void RingGradient::add(const FeltModulus& felt, std::size_t node, double by_i1, double by_storage, double by_loss,
                       MatrixXd& by_rings) const {
  const std::size_t n = felt.frequency.size();
  const auto row = static_cast<Index>(node);
  std::size_t at = node;
  for (Index m = 0; m + 1 < columns() && at + n < felt.loss_rows.size(); ++m, at += n) {
    const double of_loss = felt.loss_part_rows.empty() ? 0 : felt.loss_part_rows[at];
    by_rings(row, m) += by_i1 * (felt.loss_rows[at] + felt.loss_rows[at + n]) +
                        2 * (by_storage * felt.square_rows[at] + (by_loss - by_storage) * of_loss);
  }
}

void RingGradient::spread(double by_edges, MatrixXd& by_rings, VectorXd& by_node) const {
  const auto band = static_cast<Index>(grid_.band_size());
  const ContactGrid::Beyond& beyond = grid_.beyond();
  if (!beyond.end) return;
  const auto first = static_cast<Index>(beyond.first),
             count = static_cast<Index>(beyond.count) + 1 + (beyond.about > 0 ? band : 0);
  Eigen::RowVectorXd by_mean = by_rings.middleRows(first, count).colwise().sum();
  by_rings.middleRows(first, count).setZero();
  const Rings& mean = directions_.mean();
  const double along = mean.along[0], across = mean.across[0];
  const auto edges = [&](double more_along, double more_across) {
    return std::log(partial_contact::crossed_edges(along + more_along, across + more_across));
  };
  by_mean[0] += by_edges * slope_at_0([&](double t) { return edges(t, 0); });
  by_mean[columns() - 1] += by_edges * slope_at_0([&](double t) { return edges(0, t); });
  const VectorXd share = grid_.weight() / grid_.weight().sum();
  const Eigen::RowVectorXd at_mean = share.transpose() * values_.topRows(band);
  by_rings.topRows(band) += share * by_mean;
  by_node.head(band) += share.cwiseProduct((values_.topRows(band).rowwise() - at_mean) * by_mean.transpose());
}

double RingGradient::turned(const MatrixXd& by_rings) const { return by_rings.cwiseProduct(slopes_).sum(); }

}  // namespace asperity
