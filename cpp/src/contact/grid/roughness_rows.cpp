// On a panel a node has the shares of the rows at its wavenumber. On a piece its line l_j, which is 1 at the node and 0
// at the other one, has int c l_j s dy of a row's share s, over int c l_j dy.
#include "contact/grid/roughness_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "numerics/gauss_legendre.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

RoughnessRows::RoughnessRows(std::span<const Segment> surface, bool of_table, const ContactGrid& grid,
                             std::vector<double> wavenumber)
    : surface_(surface), of_table_(of_table), rows_(std::move(wavenumber)), first_{0} {
  if (const RoughnessPieces* const pieces = grid.pieces()) {
    double from = surface.front().a;
    for (std::size_t i = 0; i < pieces->nodes().end.size(); ++i) {
      add_piece(grid, i, from);
      from = pieces->nodes().end[i];
    }
    first_.resize(grid.band_size() + 1, row_.size());
    return;
  }
  for (std::size_t j = 0; j < grid.band_size(); ++j) {
    const Shares at = shares_at(grid.wavenumber()[j]);
    row_.insert(row_.end(), {static_cast<Index>(at.row), static_cast<Index>(at.row) + 1});
    share_.insert(share_.end(), {at.lower, at.upper});
    first_.push_back(row_.size());
  }
}

RoughnessRows::Shares RoughnessRows::shares_at(double wavenumber) const {
  const auto above = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, wavenumber);
  const auto row = static_cast<std::size_t>(above - rows_.begin()) - 1;
  const double a = rows_[row], b = rows_[row + 1];
  if (of_table_ && row < surface_.size() && surface_[row].straight) {
    const double x = std::clamp((wavenumber - a) / (b - a), 0.0, 1.0);
    const double lower = surface_[row].at_a * (1 - x), upper = surface_[row].at_b * x, whole = lower + upper;
    return whole > 0 ? Shares{row, lower / whole, upper / whole} : Shares{row, 0, 0};
  }
  const double x = std::clamp(std::log(wavenumber / a) / std::log(b / a), 0.0, 1.0);
  return {row, 1 - x, x};
}

void RoughnessRows::add_piece(const ContactGrid& grid, std::size_t piece, double from) {
  const double to = grid.pieces()->nodes().end[piece],
               node[2] = {grid.wavenumber()[2 * piece], grid.wavenumber()[2 * piece + 1]};
  const double apart = std::log(node[1] / node[0]);
  const LegendreRule& rule = legendre_rule(4);
  std::map<std::size_t, double> of[2];
  double whole[2] = {};
  auto segment = std::ranges::upper_bound(surface_, from, {}, &Segment::b);
  for (; segment != surface_.end() && segment->a < to; ++segment) {
    const double lower = std::fmax(from, segment->a), half = std::log(std::fmin(to, segment->b) / lower) / 2;
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double q = lower * std::exp(half * (1 + rule.node[i])), square = q * q;
      const double part = half * rule.weight[i] * square * square * segment->density(q);
      if (!(part > 0)) continue;
      const Shares at = shares_at(q);
      const double second = std::log(q / node[0]) / apart;
      for (const auto& [line, share] : {std::pair{0, 1 - second}, std::pair{1, second}}) {
        of[line][at.row] += part * share * at.lower;
        of[line][at.row + 1] += part * share * at.upper;
        whole[line] += part * share;
      }
    }
  }
  for (const int line : {0, 1}) {
    for (const auto& [row, share] : of[line]) {
      row_.push_back(static_cast<Index>(row));
      share_.push_back(share / whole[line]);
    }
    first_.push_back(row_.size());
  }
}

VectorXd RoughnessRows::operator()(const VectorXd& by_node) const {
  VectorXd result = VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (Index j = 0; j < by_node.size(); ++j)
    for (std::size_t k = first_[static_cast<std::size_t>(j)]; k < first_[static_cast<std::size_t>(j) + 1]; ++k)
      result[row_[k]] += by_node[j] * share_[k];
  return result;
}

}  // namespace asperity
