#include "contact/grid/cell_sums.hpp"

#include <cmath>
#include <iterator>
#include <utility>

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Calls `visit` with the first node of each cell, their number, and where the cell ends: by q, on pieces by the
/// roughness up to there, which all levels have alike.
void for_each_cell(const ContactGrid& grid, auto&& visit) {
  double place = 0;
  for (const ContactGrid::Cell& cell : grid.cells()) {
    const auto first = static_cast<Index>(cell.first), count = static_cast<Index>(cell.count);
    // from the foot on, as ends are beside each other at a front
    place = cell.rule ? cell.end - grid.foot() : place + grid.weight().segment(first, count).sum();
    visit(first, count, place);
  }
  const ContactGrid::Beyond& edges = grid.beyond();
  auto first = static_cast<Index>(edges.first);
  for (std::size_t i = 0; i < edges.panel_nodes.size(); ++i) {
    const auto count = static_cast<Index>(edges.panel_nodes[i]);
    visit(first, count, place + (edges.ends[i + 1] - edges.ends[0]));
    first += count;
  }
}

}  // namespace

void sum_cells(const ContactGrid& grid, const VectorXd& part, VectorXd& sums) {
  sums.resize(std::ssize(grid.cells()) + std::ssize(grid.beyond().panel_nodes));
  Index at = 0;
  for_each_cell(grid, [&](Index first, Index count, double) { sums[at++] = part.segment(first, count).sum(); });
}

std::vector<PanelSum> sums_of_panels(const ContactGrid& grid, const VectorXd& part) {
  VectorXd sums;
  sum_cells(grid, part, sums);
  std::vector<PanelSum> result;
  double lower = grid.foot();
  const auto add = [&](double from, double to) { result.push_back({from, to, sums[std::ssize(result)]}); };
  for (const ContactGrid::Cell& cell : grid.cells()) add(std::exchange(lower, cell.end), cell.end);
  const std::vector<double>& ends = grid.beyond().ends;
  for (std::size_t i = 0; i < grid.beyond().panel_nodes.size(); ++i) add(ends[i], ends[i + 1]);
  return result;
}

CommonEnds common_ends(const ContactGrid& coarse, const ContactGrid& fine, Index between) {
  constexpr double same = 1e-9;
  std::vector<double> of_fine;
  for_each_cell(fine, [&](Index, Index, double end) { of_fine.push_back(end); });
  CommonEnds ends;
  Index cells = 0, nodes = 0;
  auto at = of_fine.begin();
  for_each_cell(coarse, [&](Index, Index count, double end) {
    ++cells;
    nodes += count;
    while (at != of_fine.end() && *at < end * (1 - same)) ++at;
    if (nodes < between || at == of_fine.end() || *at > end * (1 + same)) return;
    nodes = 0;
    ends.push_back({cells, at - of_fine.begin() + 1});
  });
  return ends;
}

double most_apart(const VectorXd& of_coarse, const VectorXd& of_fine, const CommonEnds& ends) {
  if (of_coarse.size() == 0 || of_fine.size() == 0) return 0;
  double most = 0, off = 0;
  Index i = 0, k = 0;
  for (const auto& [end, fine_end] : ends) {
    off += of_fine.segment(k, fine_end - k).sum() - of_coarse.segment(i, end - i).sum();
    i = end;
    k = fine_end;
    most = std::fmax(most, std::fabs(off));
  }
  return most;
}

}  // namespace asperity
