// d ln eps(q) is half of d ln int c dln q up to q; f and g are linear in eps between their rows.
#include "contact/theory/strain_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

StrainGradient::StrainGradient(const StrainFactors& factors, std::span<const Segment> surface, const ContactGrid& grid)
    : grid_(grid), factors_(factors), below_(grid) {
  const Softening softening(factors, surface);
  at_nodes_ = softening.at_nodes(grid);
  for (const double strain : softening.strains(grid)) take_node(strain);
  VectorXd up_to;
  std::vector<double> ends;
  grid.integrate(VectorXd::Ones(static_cast<Index>(grid.size())), up_to, ends);
  roughness_.resize(up_to.size() + 1);
  roughness_ << up_to, ends.back();
  const double whole = softening.strain(softening.end());
  for (std::size_t j = grid.band_size(); j < grid.size(); ++j) {
    const double q = grid.wavenumber()[j], strain = nodes_[j].strain, share = strain / whole;
    const auto segment = std::ranges::lower_bound(surface, q, {}, &Segment::b);
    const bool inside = q < softening.end() && segment != surface.end() && q >= segment->a;
    const double slope = factors.strain_per_slope() * q * q / strain;
    const bool of_edges = j <= grid.beyond().first + grid.beyond().count;
    at_end_.push_back(inside && of_edges ? std::numbers::pi * slope * slope * segment->density(q) : 0);
    beside_.push_back(inside ? below_(q, share * share) : RoughnessBelow::Reach{grid.cells().size(), {}});
  }
}

void StrainGradient::take_node(double strain) {
  const std::vector<double>& rows = factors_.strain();
  const auto row = static_cast<std::size_t>(std::ranges::upper_bound(rows, strain) - rows.begin());
  Node node{strain, 0, 0, row, 0};
  if (row < rows.size()) {
    const double from = row == 0 ? 0 : rows[row - 1], length = rows[row] - from;
    const ModulusFactors at = factors_.at(strain);
    const auto slope = [&](const std::vector<double>& factor) {
      return (factor[row] - (row == 0 ? 1 : factor[row - 1])) / length * strain;
    };
    node.part = (strain - from) / length;
    node.storage_slope = slope(factors_.storage()) / at.storage;
    node.loss_slope = slope(factors_.loss()) / at.loss;
  }
  nodes_.push_back(node);
}

StrainGradient::Slopes StrainGradient::operator()(const VectorXd& by_f, const VectorXd& by_g,
                                                  VectorXd& by_roughness) const {
  const std::size_t band = grid_.band_size(), rows = factors_.strain().size();
  const auto n = static_cast<Index>(band);
  Slopes result;
  result.storage = result.loss = VectorXd::Zero(static_cast<Index>(rows));
  VectorXd by_band(n), of_edge = VectorXd::Zero(static_cast<Index>(grid_.cells().size()) + 1), direct(n);
  direct.setZero();
  const std::vector<double> sums = below_.sums(grid_.weight());
  for (std::size_t j = 0; j < grid_.size(); ++j) {
    const auto at = static_cast<Index>(j);
    const Node& node = nodes_[j];
    const auto share = [&](std::size_t row, double part) {
      if (row >= rows) return;
      const auto to = static_cast<Index>(row);
      result.storage[to] += by_f[at] * part * factors_.storage()[row] / at_nodes_[j].storage;
      result.loss[to] += by_g[at] * part * factors_.loss()[row] / at_nodes_[j].loss;
    };
    if (node.row > 0) share(node.row - 1, node.row == rows ? 1 : 1 - node.part);
    share(node.row, node.part);
    const double by_strain = by_f[at] * node.storage_slope + by_g[at] * node.loss_slope;
    result.per_slope += by_strain;
    if (j < band) {
      by_band[at] = by_strain > 0 || by_strain < 0 ? by_strain / (2 * roughness_[at]) : 0;
      continue;
    }
    if (by_strain == 0) continue;
    const RoughnessBelow::Reach& reach = beside_[j - band];
    result.end += by_strain * at_end_[j - band];
    const double by_roughness_below = by_strain / (2 * below_.sum(reach, sums, grid_.weight()));
    of_edge[static_cast<Index>(reach.cell)] += by_roughness_below;
    for (std::size_t i = 0; i < reach.share.size(); ++i)
      direct[static_cast<Index>(grid_.cells()[reach.cell].first + i)] += by_roughness_below * reach.share[i];
  }
  result.beyond = of_edge[of_edge.size() - 1];
  by_roughness.head(n) += grid_.integrate_back(by_band, of_edge) + direct.cwiseProduct(grid_.weight());
  return result;
}

}  // namespace asperity
