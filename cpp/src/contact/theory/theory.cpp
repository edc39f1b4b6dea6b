// What all theories of the contact share: G at unit load, and slopes through it.
#include "contact/theory/theory.hpp"

#include <cmath>

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void Theory::take(const NodeModulus& modulus) {
  const auto n = static_cast<Index>(modulus.i2.size());
  i2_ = Eigen::Map<const VectorXd>(modulus.i2.data(), n);
  ratio_ = Eigen::Map<const VectorXd>(modulus.i1.data(), n).cwiseQuotient(i2_);
  grid_.integrate(i2_, g_, g_edge_);
  if (grid_.has_macro()) g_macro_ = grid_.macro_weight().dot(i2_);
}

void Theory::add_up(const ModulusSlopes& along, GSlopes& slopes) const {
  const MatrixXd di2 = scale_ * (i2_.asDiagonal() * along.i2);
  grid_.integrate(di2, slopes.node, slopes.edge);
  slopes.macro = grid_.macro_weight().transpose() * di2;
  if (along.scale.isZero(0)) return;
  slopes.node += scale_ * g_ * along.scale;
  for (std::size_t c = 0; c < g_edge_.size(); ++c)
    slopes.edge.row(static_cast<Index>(c)) += scale_ * g_edge_[c] * along.scale;
  slopes.macro += scale_ * g_macro_ * along.scale;
}

VectorXd Theory::back_through_g(const VectorXd& by_node, const VectorXd& by_edge) const {
  return scale_ * grid_.integrate_back(by_node, by_edge).cwiseProduct(i2_.head(g_.size()));
}

void Theory::back_through_macro(double by_g, ContactGradient& result) const {
  result.macro = scale_ * by_g;
  if (by_g == 0) return;
  const VectorXd by_node = result.macro * grid_.macro_weight().cwiseProduct(i2_);
  result.i2 += by_node;
  result.weight += by_node;
  result.scale += by_node.sum();
}

double Theory::g_on(const ContactGrid::Place& place) const {
  const ContactGrid::Cell& cell = grid_.cells()[place.cell];
  double weights[LegendreRule::most], sum = g_edge_[place.cell];
  integrals_to(*cell.rule, 2 * (place.t - cell.lower) / (cell.upper - cell.lower) - 1, weights);
  for (std::size_t j = 0; j < cell.count; ++j) {
    const auto at = static_cast<Index>(cell.first + j);
    sum += weights[j] * grid_.weight()[at] / cell.rule->weight[j] * i2_[at];
  }
  return scale_ * std::fmax(sum, 0);
}

}  // namespace asperity
