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
  [[nodiscard]] const Directions& directions() const { return directions_; }
  [[nodiscard]] Eigen::Index columns() const { return values_.cols(); }
  [[nodiscard]] const Eigen::MatrixXd& values() const { return values_; }
  /// How often L_k and K_k of a node stand in its sums, k from 0 on.
  [[nodiscard]] const double* of_i1(std::size_t node) const {
    return of_i1_.col(static_cast<Eigen::Index>(node)).data();
  }
  [[nodiscard]] const double* of_i2(std::size_t node) const {
    return of_i2_.col(static_cast<Eigen::Index>(node)).data();
  }
  /// Adds the slopes over the harmonics of a node, from those over its I1 and over the parts of its I2.
  void add(const FeltModulus& felt, std::size_t node, double by_i1, double by_storage, double by_loss,
           Eigen::MatrixXd& by_rings) const;
  /// Those of the edges are means: what depends on them goes to the rings of the band and to the roughness of its
  /// nodes. `by_edges` is the slope over ln of what edges there are.
  void spread(double by_edges, Eigen::MatrixXd& by_rings, Eigen::VectorXd& by_node) const;
  /// Over the direction of sliding [1/rad], from slopes that were spread.
  [[nodiscard]] double turned(const Eigen::MatrixXd& by_rings) const;

 private:
  const Directions& directions_;
  const ContactGrid& grid_;
  Eigen::MatrixXd values_, slopes_;  // a row a node; the latter over the direction
  Eigen::MatrixXd of_i1_, of_i2_;    // a column a node
};

}  // namespace asperity
