// A change of ln C at y = ln q by delta changes G and the stress there, the means w over half a unit of y' in |y - y'|
// < 1 by delta c(y) / 2 dy, M by delta c(y) dy, and the end of the roughness, y_e = 10 / M int c y dy from the y_c on
// that has a tenth of M behind it, by delta c(y) {max(0, y - y_c) + (y_c - y_e) / 10} 10 / M dy
// (contact/theory/partial_contact_rule.hpp).
#include "contact/theory/roughness_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "contact/theory/partial_contact_rule.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

RoughnessBelow::RoughnessBelow(const ContactGrid& grid) : grid_(grid) {
  mass_at_ends_ = sums(grid.weight() / grid.weight().sum());
}

RoughnessBelow::Reach RoughnessBelow::operator()(double wavenumber, double mass) const {
  const auto& cells = grid_.cells();
  if (grid_.pieces()) {
    const auto above = std::ranges::upper_bound(mass_at_ends_, mass);
    if (above == mass_at_ends_.begin()) return {0, std::vector<double>(cells.front().count, 0.0)};
    const auto cell = static_cast<std::size_t>(above - mass_at_ends_.begin()) - 1;
    if (cell >= cells.size()) return {cells.size(), {}};
    const double share = (mass - mass_at_ends_[cell]) / (mass_at_ends_[cell + 1] - mass_at_ends_[cell]);
    return {cell, std::vector<double>(cells[cell].count, share)};
  }
  const auto in = std::ranges::upper_bound(cells, wavenumber, {}, &ContactGrid::Cell::end);
  if (in == cells.end()) return {cells.size(), {}};
  const double t = grid_.place_of(wavenumber).t;
  const double u = std::clamp(2 * (t - in->lower) / (in->upper - in->lower) - 1, -1.0, 1.0);
  Reach result{static_cast<std::size_t>(in - cells.begin()), std::vector<double>(in->count)};
  integrals_to(*in->rule, u, result.share.data());
  for (std::size_t i = 0; i < in->count; ++i) result.share[i] /= in->rule->weight[i];
  return result;
}

std::vector<double> RoughnessBelow::sums(const VectorXd& f) const {
  std::vector<double> result{0};
  for (const ContactGrid::Cell& cell : grid_.cells())
    result.push_back(result.back() + f.segment(static_cast<Index>(cell.first), static_cast<Index>(cell.count)).sum());
  return result;
}

double RoughnessBelow::sum(const Reach& reach, const std::vector<double>& sums, const VectorXd& f) const {
  double sum = sums[reach.cell];
  if (reach.share.empty()) return sum;
  const std::size_t first = grid_.cells()[reach.cell].first;
  for (std::size_t i = 0; i < reach.share.size(); ++i) sum += reach.share[i] * f[static_cast<Index>(first + i)];
  return sum;
}

RoughnessGradient::RoughnessGradient(const ContactGrid& grid) : grid_(grid), below_(grid) {
  const ContactGrid::Beyond& beyond = grid.beyond();
  if (!beyond.end || !(beyond.roughness->total() > 0)) return;
  window_ = beyond.roughness;
  const auto n = static_cast<Index>(grid.band_size());
  const double reached = std::exp(RoughnessWindow::half_length), q_e = window_->end(), q_c = window_->last_from();
  for (std::size_t j = 0; j < grid.band_size(); ++j)
    windows_.push_back({reach(grid.wavenumber()[j] / reached), reach(grid.wavenumber()[j] * reached)});

  const double mean_at_end = (*window_)(q_e), total = window_->total();
  window_at_end_ = mean_at_end > partial_contact::last / 2 * total;
  in_window_of_end_.setZero(n);
  moves_end_.resize(n);
  const auto at_end = std::array{reach(q_e / reached), reach(q_e * reached)};
  for (Index j = 0; j < n; ++j) {
    const double y = std::log(grid.wavenumber()[static_cast<std::size_t>(j)] / q_c);
    moves_end_[j] = grid.weight()[j] * (std::fmax(0, y) - partial_contact::last * std::log(q_e / q_c)) /
                    (partial_contact::last * beyond.end->total);
  }
  if (!window_at_end_) return;
  for (std::size_t c = 0; c < grid.cells().size(); ++c)
    for (std::size_t i = 0; i < grid.cells()[c].count; ++i) {
      const auto inside = [&](const Reach& end) {
        return c < end.cell ? 1 : c > end.cell || end.share.empty() ? 0 : end.share[i];
      };
      const auto j = static_cast<Index>(grid.cells()[c].first + i);
      in_window_of_end_[j] =
          (inside(at_end[1]) - inside(at_end[0])) * grid.weight()[j] / (2 * RoughnessWindow::half_length);
    }
  in_window_of_end_ /= beyond.end->window;
  constexpr double step = 1e-3;
  end_slope_ = std::log((*window_)(q_e * (1 + step)) / (*window_)(q_e * (1 - step))) / (2 * step);
}

RoughnessGradient::Reach RoughnessGradient::reach(double wavenumber) const {
  const double inside = std::clamp(wavenumber, std::exp(grid_.lowest()), grid_.cells().back().end);
  return below_(wavenumber, window_->below(inside) / window_->total());
}

VectorXd RoughnessGradient::operator()(const ContactGradient& of, double by_end) const {
  VectorXd result = of.weight;
  if (!window_) return result;
  const RoughnessEnd& end = *grid_.beyond().end;
  const auto n = static_cast<Index>(grid_.band_size());
  VectorXd by_mean(n);
  for (Index j = 0; j < n; ++j) {
    const double mean = grid_.beyond().window[static_cast<std::size_t>(j)];
    by_mean[j] = mean > 0 ? of.window[j] / mean : 0;
  }
  const std::vector<double> sums = below_.sums(by_mean);
  const double by_total = (of.total + (window_at_end_ ? 0 : of.end_window)) / end.total;
  for (Index j = 0; j < n; ++j) {
    const auto& [lower, upper] = windows_[static_cast<std::size_t>(j)];
    const double in_means =
        (below_.sum(upper, sums, by_mean) - below_.sum(lower, sums, by_mean)) / (2 * RoughnessWindow::half_length);
    result[j] += grid_.weight()[j] * (in_means + by_total);
  }
  if (window_at_end_) result.head(n) += of.end_window * in_window_of_end_;
  result.head(n) += (by_end + of.end_window * end_slope_) * moves_end_;
  return result;
}

}  // namespace asperity
