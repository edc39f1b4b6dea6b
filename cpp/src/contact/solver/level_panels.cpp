// Where the panels of LevelSolver end: at knots of the modulus, where what is asked for ends, and at steep fronts.
#include <algorithm>
#include <cmath>

#include "contact/solver/level_solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"

namespace asperity {

using Eigen::Index;

void LevelSolver::begin_panels() {
  if (velocity_ == panels_velocity_) return;
  panels_velocity_ = velocity_;
  std::vector<double> stops;
  const double end = surface_.back().b,
               last = window_ ? std::fmax(end, window_->end() * partial_contact::tail_end) : end;
  const auto add = [&](double q) {
    if (q > surface_.front().a && q < last) stops.push_back(q);
  };
  for (const double w : options_.stops) add(w / velocity_);
  if (const auto* const curve = std::get_if<MasterCurve>(&waves_.rubber()))
    for (const double w : curve->knots()) add(w / velocity_);
  for (const double q : waves_.kinks()) add(q);
  if (waves_.softening()) add(waves_.softening()->end());
  std::ranges::sort(stops);
  if (stops != stops_) {
    for (Level& level : panels_) level = {};
    stops_ = std::move(stops);
  }
  if (!window_ || !known_) return;
  const double from = known_->highest / velocity_;
  const auto held_from = from > window_->end() && from < last ? std::optional(from) : std::nullopt;
  if (held_from == held_from_) return;
  held_from_ = held_from;
  for (Level& level : panels_)
    if (level.grid) {
      level.from_next.reset();
      level.grid->lay_edges(held_from_);
      level.factors = waves_.factors(*level.grid);
      level.rings = waves_.rings(*level.grid);
    }
}

/// Panels of one point that also stop where the contact breaks up, about decade by decade of G on those that G rises
/// steeply on: between nodes by a power of the distance from where they begin.
void LevelSolver::lay_out_front() {
  constexpr double steep = 100, lowest = 0.01;
  front_stops_ = stops_;
  const ContactGrid& grid = *solved_->grid;
  double before = 0, lower = grid.foot();
  for (const ContactGrid::Cell& cell : grid.cells()) {
    const auto g_at = [&](std::size_t i) { return scale_ * solved_->theory->node_g()[static_cast<Index>(i)]; };
    const std::size_t end = cell.first + cell.count;
    const double last = g_at(end - 1);
    if (last > lowest && last > steep * before) {
      double at = std::fmax(lowest, std::pow(10, std::ceil(std::log10(std::fmax(before, lowest)))));
      double from = 0, rise_from = 0;
      for (std::size_t i = cell.first; i < end; ++i) {
        const double to = grid.wavenumber()[i] - lower, rise_to = g_at(i) - before;
        if (!(to > from && rise_to > rise_from)) continue;
        const double power = from > 0 ? std::log(to / from) / std::log(rise_to / rise_from) : 1;
        for (; at < g_at(i); at *= 10)
          if (at > before + rise_from) front_stops_.push_back(lower + to * std::pow((at - before) / rise_to, power));
        from = to;
        rise_from = rise_to;
      }
    }
    before = last;
    lower = cell.end;
  }
  std::ranges::sort(front_stops_);
  for (Level& level : front_) level = {};
}

}  // namespace asperity
