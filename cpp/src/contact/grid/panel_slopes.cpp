// int g f' dx = [g f] - int g' f dx with g the polynomial through its values at the nodes, x from -1 to 1 on a panel.
#include "contact/grid/panel_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity {

namespace {

constexpr double step = 1e-4;  // at q_e, which is no panel

/// df / dx of a panel.
void add_panel(const LegendreRule& rule, const double* f, double lower, double upper, double* slope) {
  for (std::size_t j = 0; j < rule.n; ++j) {
    double sum = rule.at_upper[j] * upper - rule.at_lower[j] * lower;
    for (std::size_t i = 0; i < rule.n; ++i) sum -= rule.slope[j][i] * f[i];
    slope[j] = sum / rule.weight[j];
  }
}

}  // namespace

PanelSlopes::PanelSlopes(const ContactGrid& grid) : grid_(grid), wavenumber_{grid.foot()} {
  if (grid.pieces()) {
    const std::vector<double>& q = grid.wavenumber();
    for (std::size_t i = 0; i < grid.pieces()->nodes().end.size(); ++i)
      wavenumber_.insert(wavenumber_.end(), {std::sqrt(q[2 * i] * q[2 * i + 1]), grid.pieces()->nodes().end[i]});
  } else {
    for (const ContactGrid::Cell& cell : grid.cells()) wavenumber_.push_back(cell.end);
  }
  if (!grid.beyond().end) return;
  wavenumber_.insert(wavenumber_.end(), grid.beyond().ends.begin(), grid.beyond().ends.end());
  for (const double side : {-step, step}) wavenumber_.push_back(grid.beyond().end->wavenumber * std::exp(side));
}

void PanelSlopes::operator()(std::span<const double> at_nodes, std::span<const double> beside,
                             std::span<double> slope) const {
  const double* end = beside.data();
  if (grid_.pieces()) {
    const std::size_t n = 2 * grid_.pieces()->nodes().end.size();
    for (std::size_t j = 0; j < n; ++j, ++end) {
      const double length = std::log(wavenumber_[j + 1] / wavenumber_[j]);
      slope[j] = length > 0 ? (end[1] - end[0]) / length : 0;
    }
    std::fill(slope.begin() + static_cast<std::ptrdiff_t>(n),
              slope.begin() + static_cast<std::ptrdiff_t>(grid_.band_size()), 0);
  } else {
    for (const ContactGrid::Cell& cell : grid_.cells()) {
      add_panel(*cell.rule, &at_nodes[cell.first], end[0], end[1], &slope[cell.first]);
      const double half = (cell.upper - cell.lower) / 2;
      for (std::size_t j = 0; j < cell.count; ++j)  // dln q is that of t^2
        slope[cell.first + j] /= half * 2 * (cell.lower + half * (1 + cell.rule->node[j]));
      ++end;
    }
  }
  const ContactGrid::Beyond& beyond = grid_.beyond();
  if (!beyond.end) return;
  std::size_t first = beyond.first;
  for (std::size_t k = 0; k < beyond.panel_nodes.size(); ++k) {
    ++end;
    const LegendreRule& rule = legendre_rule(beyond.panel_nodes[k]);
    add_panel(rule, &at_nodes[first], end[0], end[1], &slope[first]);
    const double half = std::log(beyond.ends[k + 1] / beyond.ends[k]) / 2;
    for (std::size_t j = 0; j < rule.n; ++j) slope[first + j] /= half;
    first += rule.n;
  }
  if (beyond.about > 0)
    std::copy_n(slope.begin(), grid_.band_size(), slope.begin() + static_cast<std::ptrdiff_t>(beyond.about));
  slope[first] = (beside.back() - beside[beside.size() - 2]) / (2 * step);
}

}  // namespace asperity
