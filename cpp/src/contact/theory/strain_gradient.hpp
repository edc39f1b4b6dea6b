// The slopes of a number over what the factors of strain are made of.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"
#include "contact/theory/roughness_gradient.hpp"

namespace asperity {

/// On one grid. eps(q) = strain_per_slope h'(q) with h'(q)^2 ~ int c dln q from q0 to q.
class StrainGradient {
 public:
  StrainGradient(const StrainFactors& factors, std::span<const Segment> surface, const ContactGrid& grid);
  [[nodiscard]] const std::vector<ModulusFactors>& factors() const { return at_nodes_; }  // of all nodes

  struct Slopes {
    double per_slope = 0;           // over ln strain_per_slope
    Eigen::VectorXd storage, loss;  // over ln of each row
    double end = 0;                 // over ln q_e, with which the nodes of the edges move
    double beyond = 0;              // over the roughness of waves beyond the band: of nodes there alone
  };
  /// From slopes over ln f and ln g of all nodes; those over ln C are added to `by_roughness`.
  Slopes operator()(const Eigen::VectorXd& by_f, const Eigen::VectorXd& by_g, Eigen::VectorXd& by_roughness) const;

 private:
  struct Node {
    double strain;
    double storage_slope, loss_slope;  // d ln f, d ln g / d ln eps
    std::size_t row;                   // of the rows, at or above the strain; beyond the last their number
    double part;                       // of the way to it from the row before
  };
  void take_node(double strain);

  const ContactGrid& grid_;
  StrainFactors factors_;
  std::vector<Node> nodes_;
  std::vector<ModulusFactors> at_nodes_;
  RoughnessBelow below_;
  Eigen::VectorXd roughness_;                  // int c dln q up to the nodes of the band, and up to its end
  std::vector<RoughnessBelow::Reach> beside_;  // of all other nodes
  std::vector<double> at_end_;                 // d ln eps / d ln q of these
};

}  // namespace asperity
