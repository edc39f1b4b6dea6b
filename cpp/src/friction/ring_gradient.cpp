#include "friction/ring_gradient.hpp"

#include <cmath>

#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/differences.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RingGradient::RingGradient(const Directions& directions, const ContactGrid& grid, std::size_t harmonics)
    : directions_(directions), grid_(grid), rings_(directions.at_nodes(grid)) {
  const auto n = static_cast<Index>(grid.size()), count = static_cast<Index>(harmonics);
  const auto columns = static_cast<Index>(rings_.count);
  values_.setOnes(count + 2, n);
  values_.middleRows(1, count) = MatrixXd::Map(rings_.along.data(), n, columns).leftCols(count).transpose();
  values_.bottomRows(1) = MatrixXd::Map(rings_.across.data(), n, columns).leftCols(1).transpose();
  by_rings_.setZero(n, count + 1);
  const ContactGrid::Beyond& beyond = grid.beyond();
  if (!beyond.end) return;
  first_mean_ = beyond.first;
  means_ = beyond.count + 1 + (beyond.about > 0 ? grid.band_size() : 0);
}

std::span<const double> RingGradient::take(const std::vector<RingBlock>& blocks) {
  static constexpr double alone = 1;
  std::span<const double> mean(&alone, 1);
  of_nodes_.assign(grid_.size(), {});
  for (const RingBlock& block : blocks)
    for (std::size_t j = block.first; j < block.first + block.size; ++j) {
      const std::size_t count = std::min(block.harmonics, static_cast<std::size_t>(by_rings_.cols()) - 1);
      std::span<const double>& to = is_mean(j) ? mean : of_nodes_[j];
      to = {values_.col(static_cast<Index>(j)).data(), count + 1};
    }
  return mean;
}

/// Those of nodes with the rings of all roughness are one row.
void RingGradient::add(const FeltModulus& felt, const VectorXd& by_i1, const VectorXd& by_storage,
                       const VectorXd& by_loss) {
  Eigen::ArrayXd part;
  for (const RingBlock& block : felt.blocks) {
    const auto first = static_cast<Index>(block.first), n = static_cast<Index>(block.size),
               harmonics = std::min(static_cast<Index>(block.harmonics), by_rings_.cols() - 1);
    const auto l = block.of(felt.loss_rows), k = block.of(felt.square_rows);
    const auto linear = by_i1.segment(first, n).array(), storage = by_storage.segment(first, n).array(),
               loss = by_loss.segment(first, n).array();
    for (Index m = 1; m <= harmonics; ++m) {
      part = linear * (l.col(m - 1) + l.col(m)) + 2 * storage * k.col(m);
      if (!felt.loss_part.empty()) part += 2 * (loss - storage) * block.of(felt.loss_part_rows).col(m);
      if (is_mean(block.first))
        by_rings_(static_cast<Index>(first_mean_), m - 1) += part.sum();
      else
        by_rings_.col(m - 1).segment(first, n).array() += part;
    }
  }
}

void RingGradient::spread(double by_edges, VectorXd& by_node) {
  const auto band = static_cast<Index>(grid_.band_size()), count = by_rings_.cols();
  if (means_ == 0) return;
  Eigen::RowVectorXd by_mean = by_rings_.row(static_cast<Index>(first_mean_));
  by_rings_.row(static_cast<Index>(first_mean_)).setZero();
  const Rings& mean = directions_.mean();
  const double along = mean.along[0], across = mean.across[0];
  const auto edges = [&](double more_along, double more_across) {
    return std::log(partial_contact::crossed_edges(along + more_along, across + more_across));
  };
  by_mean[0] += by_edges * slope_at_0([&](double t) { return edges(t, 0); });
  by_mean[count - 1] += by_edges * slope_at_0([&](double t) { return edges(0, t); });
  const VectorXd share = grid_.weight() / grid_.weight().sum();
  const auto of_band = values_.bottomRows(count).leftCols(band);
  const VectorXd at_mean = of_band * share;
  by_rings_.topRows(band).noalias() += share * by_mean;
  const VectorXd by_share = (by_mean * of_band).transpose();
  by_node.head(band).array() += share.array() * (by_share.array() - by_mean.dot(at_mean));
}

double RingGradient::turned() const {
  const Index n = by_rings_.rows(), count = by_rings_.cols() - 1;
  double result = 0;
  for (Index m = 0; m < count; ++m)
    result += 2 * static_cast<double>(m + 1) * by_rings_.col(m).dot(VectorXd::Map(rings_.across.data() + m * n, n));
  return result - 2 * by_rings_.col(count).dot(VectorXd::Map(rings_.along.data(), n));
}

}  // namespace asperity
