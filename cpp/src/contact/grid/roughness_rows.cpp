// Nodes stand for a stretch, the polynomial l_j for one that is 1 there and 0 at the others: it has int c l_j s dy of a
// row's share s, over int c l_j dy.
#include "contact/grid/roughness_rows.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

RoughnessRows::RoughnessRows(std::span<const Segment> surface, bool of_table, const ContactGrid& grid,
                             std::vector<double> wavenumber, const Directions* directions, std::size_t harmonics)
    : surface_(surface),
      of_table_(of_table),
      rows_(std::move(wavenumber)),
      log_rows_(logarithms(rows_)),
      first_{0},
      directions_(directions),
      harmonics_(directions ? harmonics : 0) {
  if (const RoughnessPieces* const pieces = grid.pieces()) {
    double from = surface.front().a;
    for (std::size_t i = 0; i < pieces->nodes().end.size(); ++i) {
      add_stretch(grid, {2 * i, 2, from, pieces->nodes().end[i]});
      from = pieces->nodes().end[i];
    }
    for (const ContactGrid::Stretch& stretch : grid.macro_stretches()) add_stretch(grid, stretch);
  } else {
    double from = grid.foot();
    for (const ContactGrid::Cell& cell : grid.cells()) {
      add_stretch(grid, {cell.first, cell.count, from, cell.end}, &cell);
      from = cell.end;
    }
  }
  first_.resize(grid.size() + 1, row_.size());
}

RoughnessRows::Shares RoughnessRows::shares_at(double wavenumber, double log_q) const {
  const std::size_t row = interval_of(rows_, wavenumber);
  const double a = rows_[row], b = rows_[row + 1], log_a = log_rows_[row];
  if (of_table_ && row < surface_.size() && surface_[row].straight) {
    const double x = std::clamp((wavenumber - a) / (b - a), 0.0, 1.0);
    const double lower = surface_[row].at_a * (1 - x), upper = surface_[row].at_b * x, whole = lower + upper;
    return whole > 0 ? Shares{row, lower / whole, upper / whole} : Shares{row, 0, 0};
  }
  const double x = std::clamp((log_q - log_a) / (log_rows_[row + 1] - log_a), 0.0, 1.0);
  return {row, 1 - x, x};
}

void RoughnessRows::add_stretch(const ContactGrid& grid, const ContactGrid::Stretch& stretch,
                                const ContactGrid::Cell* panel) {
  first_.resize(stretch.first + 1, row_.size());
  const std::size_t n = stretch.count;
  const auto place = [&](double q, double log_q) {
    if (!panel) return log_q;
    const double t = std::sqrt(std::fmax(0, grid.distance(q) - panel->origin));
    return 2 * (t - panel->lower) / (panel->upper - panel->lower) - 1;
  };
  std::vector<double> node(n), scale(n, 1.0);
  for (std::size_t j = 0; j < n; ++j)  // on short panels beside the front a double has one q for several nodes
    node[j] = panel ? panel->rule->node[j] : std::log(grid.wavenumber()[stretch.first + j]);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      if (k != j) scale[j] /= node[j] - node[k];
  const LegendreRule& rule = legendre_rule(std::min(n + 2, LegendreRule::most));
  // of each node and row a share, and each harmonic times it
  const std::size_t width = harmonics_ + 1, from = interval_of(rows_, stretch.lower),
                    rows = interval_of(rows_, stretch.upper) + 2 - from;
  std::vector<double> of(n * rows * width), whole(n * width);
  const auto add = [&](double* to, double share, const Rings& rings) {
    to[0] += share;
    for (std::size_t m = 0; m < harmonics_; ++m) to[m + 1] += share * rings.along[m];
  };
  std::vector<double> ends{stretch.lower, stretch.upper};
  for (const double row : rows_)
    if (row > stretch.lower && row < stretch.upper) ends.push_back(row);
  auto segment = std::ranges::upper_bound(surface_, stretch.lower, {}, &Segment::b);
  for (auto one = segment; one != surface_.end() && one->b < stretch.upper; ++one) ends.push_back(one->b);
  std::ranges::sort(ends);
  for (std::size_t end = 1; end < ends.size(); ++end) {
    const double lower = ends[end - 1], half = std::log(ends[end] / lower) / 2, log_lower = std::log(lower);
    if (!(half > 0)) continue;
    while (segment->b <= lower && segment + 1 != surface_.end()) ++segment;
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double along = half * (1 + rule.node[i]), q = lower * std::exp(along), log_q = log_lower + along;
      const double t = place(q, log_q), square = q * q;
      const double part = half * rule.weight[i] * square * square * segment->density(q);
      if (!(part > 0)) continue;
      const Shares at = shares_at(q, log_q);
      const Rings rings = harmonics_ > 0 ? directions_->at(q) : Rings();
      for (std::size_t j = 0; j < n; ++j) {
        double polynomial = part * scale[j];
        for (std::size_t k = 0; k < n; ++k)
          if (k != j) polynomial *= t - node[k];
        double* const row = &of[(j * rows + at.row - from) * width];
        add(row, polynomial * at.lower, rings);
        add(row + width, polynomial * at.upper, rings);
        add(&whole[j * width], polynomial, rings);
      }
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    const double* const all = &whole[j * width];
    for (std::size_t row = 0; row < rows; ++row) {
      const double* const share = &of[(j * rows + row) * width];
      if (share[0] == 0) continue;
      row_.push_back(static_cast<Index>(from + row));
      share_.push_back(share[0] / all[0]);
      for (std::size_t m = 1; m < width; ++m) rings_.push_back(share[m] / all[0] - share_.back() * (all[m] / all[0]));
    }
    first_.push_back(row_.size());
  }
}

VectorXd RoughnessRows::operator()(const VectorXd& by_node, const Eigen::MatrixXd& by_rings) const {
  VectorXd result = VectorXd::Zero(static_cast<Index>(rows_.size()));
  for (Index j = 0; j + 1 < static_cast<Index>(first_.size()); ++j) {
    for (std::size_t k = first_[static_cast<std::size_t>(j)]; k < first_[static_cast<std::size_t>(j) + 1]; ++k) {
      result[row_[k]] += by_node[j] * share_[k];
      for (std::size_t m = 0; m < harmonics_ && !rings_.empty(); ++m)
        result[row_[k]] += by_rings(j, static_cast<Index>(m)) * rings_[k * harmonics_ + m];
    }
  }
  return result;
}

}  // namespace asperity
