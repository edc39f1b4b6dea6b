// The slopes of a number over the harmonics of rings (contact/grid/directions.hpp).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/grid/directions.hpp"
#include "contact/grid/grid.hpp"
#include "heat/angular_slopes.hpp"

namespace asperity {

/// On one grid, of the first harmonics about the velocity: a_m of all nodes, m from 1 on, and behind them b_1, by which
/// edges are crossed. A ring has I1 + sum a_m (L_m-1 + L_m) and I2 + 2 sum a_m K_m.
class RingGradient {
 public:
  RingGradient(const Directions& directions, const ContactGrid& grid, std::size_t harmonics);
  void clear() { by_rings_.setZero(); }
  /// Adds the slopes over the harmonics of nodes, from those over their I1 and over the parts of their I2.
  void add(const FeltModulus& felt, const Eigen::VectorXd& by_i1, const Eigen::VectorXd& by_storage,
           const Eigen::VectorXd& by_loss);
  /// Those of the edges are means: what depends on them goes to the rings of the band and to the roughness of its
  /// nodes. `by_edges` is the slope over ln of what edges there are.
  void spread(double by_edges, Eigen::VectorXd& by_node);
  /// The slopes that were added, a row a node.
  [[nodiscard]] const Eigen::MatrixXd& slopes() const { return by_rings_; }
  /// Over the direction of sliding [1/rad], from slopes that were spread.
  [[nodiscard]] double turned() const;
  /// a_m and b_1 of a node.
  [[nodiscard]] Eigen::RowVectorXd values(Eigen::Index node) const { return values_.col(node).tail(by_rings_.cols()); }
  /// Takes as many harmonics of nodes as matter in blocks; gives 1 and a_m of all roughness.
  std::span<const double> take(const std::vector<RingBlock>& blocks);
  /// 1 and a_m of a node, none where they are those of all roughness.
  [[nodiscard]] std::span<const double> of(std::size_t node) const { return of_nodes_[node]; }

 private:
  [[nodiscard]] bool is_mean(std::size_t node) const { return node - first_mean_ < means_; }

  const Directions& directions_;
  const ContactGrid& grid_;
  Rings rings_;
  Eigen::MatrixXd values_;    // a column a node: 1 and a_m, and b_1
  Eigen::MatrixXd by_rings_;  // a row a node
  std::vector<std::span<const double>> of_nodes_;
  std::size_t first_mean_ = 0, means_ = 0;  // nodes that have those of all roughness
};

}  // namespace asperity
