// Where the panels of LevelSolver end: at knots of the modulus, where what is asked for ends, and at steep fronts.
#include <algorithm>
#include <cmath>

#include "contact/solver/level_solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "numerics/roots.hpp"

namespace asperity {

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
    from_next_.reset();
    stops_ = std::move(stops);
  }
  if (!window_ || !known_) return;
  const double from = known_->highest / velocity_;
  const auto held_from = from > window_->end() && from < last ? std::optional(from) : std::nullopt;
  if (held_from == held_from_) return;
  held_from_ = held_from;
  from_next_.reset();
  for (Level& level : panels_)
    if (level.grid) {
      level.grid->lay_edges(held_from_);
      level.factors = waves_.factors(*level.grid);
      level.rings = waves_.rings(*level.grid);
    }
}

/// Further stops where the contact breaks up, decade by decade of G on panels that G rises steeply on, for one point.
void LevelSolver::end_panels_at_front() {
  constexpr double steep = 100, lowest = 0.01, shortest = 1e-18;
  std::vector<double> ends;
  double before = 0, lower = solved_->grid->foot();
  for (const ContactGrid::Cell& cell : solved_->grid->cells()) {
    const double last = g(cell.end), length = cell.end - lower;
    if (last > lowest && last > steep * before)
      for (double at = std::fmax(lowest, std::pow(10, std::ceil(std::log10(std::fmax(before, lowest))))); at < last;
           at *= 10)
        ends.push_back(lower +
                       length * std::exp(bracketed_root([&](double x) { return g(lower + length * std::exp(x)) - at; },
                                                        std::log(shortest), 0, 0.01)));
    before = last;
    lower = cell.end;
  }
  if (ends.empty()) return;
  stops_.insert(stops_.end(), ends.begin(), ends.end());
  std::ranges::sort(stops_);
  for (Level& level : panels_) level = {};
  from_next_.reset();
  panels_velocity_ = 0;  // the next point lays panels out anew
}

}  // namespace asperity
