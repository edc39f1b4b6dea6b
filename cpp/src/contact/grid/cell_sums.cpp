#include "contact/grid/cell_sums.hpp"

#include <cmath>
#include <iterator>
#include <utility>

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

void sum_cells(const ContactGrid& grid, const VectorXd& part, VectorXd& sums) {
  const ContactGrid::Beyond& edges = grid.beyond();
  sums.resize(std::ssize(grid.cells()) + std::ssize(edges.panel_nodes));
  const double* next = part.data();
  Index at = 0;
  const auto add = [&](std::size_t count) {
    double sum = 0;
    for (const double* const end = next + count; next < end; ++next) sum += *next;
    sums[at++] = sum;
  };
  if (grid.pieces())
    for (; at < std::ssize(grid.cells()); ++at) sums[at] = next[2 * at] + next[2 * at + 1];
  else
    for (const ContactGrid::Cell& cell : grid.cells()) add(cell.count);
  next = part.data() + edges.first;
  for (const std::size_t count : edges.panel_nodes) add(count);
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

namespace {

/// Of each cell how many nodes it has, and where it ends: by q from the foot on, as ends are beside each other at a
/// front; on pieces by the roughness up to there, which all levels have alike.
std::vector<std::pair<Index, double>> ends_of(const ContactGrid& grid) {
  std::vector<std::pair<Index, double>> result;
  double place = 0;
  for (const ContactGrid::Cell& cell : grid.cells()) {
    const auto first = static_cast<Index>(cell.first), count = static_cast<Index>(cell.count);
    place = cell.rule ? cell.end - grid.foot() : place + grid.weight().segment(first, count).sum();
    result.emplace_back(count, place);
  }
  const ContactGrid::Beyond& edges = grid.beyond();
  for (std::size_t i = 0; i < edges.panel_nodes.size(); ++i)
    result.emplace_back(static_cast<Index>(edges.panel_nodes[i]), place + (edges.ends[i + 1] - edges.ends[0]));
  return result;
}

}  // namespace

CommonEnds common_ends(const ContactGrid& coarse, const ContactGrid& fine, Index between) {
  constexpr double same = 1e-9;
  const auto of_fine = ends_of(fine);
  CommonEnds ends;
  Index cells = 0, nodes = 0;
  auto at = of_fine.begin();
  for (const auto& [count, end] : ends_of(coarse)) {
    ++cells;
    nodes += count;
    while (at != of_fine.end() && at->second < end * (1 - same)) ++at;
    if (nodes < between || at == of_fine.end() || at->second > end * (1 + same)) continue;
    nodes = 0;
    ends.push_back({cells, at - of_fine.begin() + 1});
  }
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
