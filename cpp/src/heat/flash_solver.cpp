// The error of a grid is what the next finer one changes, beside what the residual of the fixed point leaves: it covers
// the quadrature, the points of the temperature and the fixed point at once.
#include "heat/flash_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int first_digits = 4, digits_a_level = 2;
constexpr std::size_t levels = 7;  // up to 16 digits

int digits_of(std::size_t level) { return first_digits + digits_a_level * static_cast<int>(level); }

/// The profile of one grid at the points of another.
VectorXd carried(const HeatGrid& from, const HeatGrid& to, const VectorXd& theta) {
  if (&from == &to) return theta;
  VectorXd result(static_cast<Index>(to.temperature_points().size()));
  for (Index i = 0; i < result.size(); ++i)
    result[i] = from.row_at(to.temperature_points()[static_cast<std::size_t>(i)]) * theta;
  return result.cwiseMax(0.0);
}

}  // namespace

double macro_wavenumber(const Heating& heating, const Spectrum& spectrum) {
  const auto [q0, q1] = band(spectrum);
  if (heating.macro_wavenumber) {
    if (*heating.macro_wavenumber < q0 || *heating.macro_wavenumber > q1)
      refuse("macro_wavenumber", *heating.macro_wavenumber,
             "in the spectrum's band, [" + show(q0) + ", " + show(q1) + "] 1/m");
    return *heating.macro_wavenumber;
  }
  return std::clamp(2 * std::numbers::pi / heating.contact_diameter, q0, q1);
}

FlashSolver::FlashSolver(const HeatScene& scene, Branch branch) : scene_(scene), branch_(branch), levels_(levels) {
  const double digits = -std::log10(scene.model.rtol);
  first_level_ = 1;  // differences of coarser grids are small by chance where a front is thin
  while (first_level_ + 2 < levels && digits_of(first_level_ + 1) < digits + 1) ++first_level_;
  level_ = first_level_;
}

void FlashSolver::forget() {
  before_ = {};
  level_ = first_level_;
}

void FlashSolver::set_stops(std::vector<double> stops) {
  if (stops == stops_) return;
  stops_ = std::move(stops);
  levels_.clear();
  levels_.resize(levels);
  forget();
}

FlashMap& FlashSolver::map_of(std::size_t level) {
  Level& made = levels_[level];
  if (!made.map) {
    std::vector<double> stops = stops_;
    stops.push_back(scene_.macro_wavenumber);
    made.grid = std::make_unique<HeatGrid>(scene_.surface, scene_.model.poisson_ratio, stops, level,
                                           std::holds_alternative<MasterCurve>(scene_.rubber));
    made.map = std::make_unique<FlashMap>(scene_, *made.grid);
  }
  return *made.map;
}

HotPoint FlashSolver::operator()(const HeatPoint& point) {
  const double rtol = scene_.model.rtol, tolerance = std::clamp(0.01 * rtol, 1e-13, 1e-5);
  FlashMap* map = &map_of(level_);
  map->start(point);
  const auto size = static_cast<Index>(map->grid().temperature_points().size());
  const VectorXd guess = before_.theta.size() == 0 ? VectorXd::Zero(size).eval()
                                                   : carried(*levels_[before_level_].grid, map->grid(), before_.theta);
  FixedPoint found = solve_fixed_point(*map, point, guess, branch_, tolerance);
  const int branches = found.solutions;
  for (std::size_t level = level_ + 1;; ++level) {
    if (level == levels)
      throw NotConverged("mu = " + show(map->hysteresis() + map->adhesion()) +
                         " with the heat it makes, on a grid of " + std::to_string(map->grid().size()) +
                         " nodes, changes by more than rtol = " + show(rtol) + " from grid to grid");
    const double coarse = map->hysteresis() + map->adhesion();
    FlashMap& finer = map_of(level);
    finer.start(point);
    found = polish(finer, carried(map->grid(), finer.grid(), found.theta), tolerance);
    map = &finer;
    finest_ = level;
    const double mu = map->hysteresis() + map->adhesion();
    // twice both: the residual's effect is taken to first order, and the finer grid has an error too. Two grids that
    // miss a thin front alike differ by less than they are off: never less than a hundredth of the tolerance is told.
    const double error = 2 * (std::fabs(mu - coarse) + found.mu_error) + std::fmax(0.01 * rtol, 1e-13) * mu;
    if (!(error <= rtol * mu)) continue;
    level_ = level - 1;
    check_temperatures(*map, found, point);
    before_ = found;
    before_level_ = level;
    point_ = point;
    return {map->hysteresis(),
            map->adhesion(),
            map->contact_area(),
            error,
            outside_share(*map),
            point.temperature + found.theta[found.theta.size() - 1],
            map->macro_area(),
            found.gain,
            branches};
  }
}

/// Refuses a solution that was found where nothing is known.
void FlashSolver::check_temperatures(const FlashMap& map, const FixedPoint& found, const HeatPoint& point) const {
  const double hottest = point.temperature + found.theta.maxCoeff();
  const std::string at = "temperature = " + show(point.temperature, 6) + ", velocity = " + show(point.velocity) +
                         ": the rubber heats itself to " + show(hottest, 6) + " K";
  if (hottest > highest_rubber_temperature)
    throw OutOfRange(at + ", above " + show(highest_rubber_temperature) + " K, which it does not stand");
  try {
    (void)shift_at(scene_.shift, hottest);
  } catch (const OutOfRange& error) {
    throw OutOfRange(at + ": " + error.what());
  }
  const std::optional<FrequencyRange> known = known_range(scene_.rubber);
  if (!known) return;
  double lowest = HUGE_VAL, highest = 0;
  const auto see = [&](double w) {
    lowest = std::fmin(lowest, w);
    highest = std::fmax(highest, w);
  };
  for (const double w : map.reduced_frequency()) see(w);
  const auto [q0, q1] = band(scene_.spectrum);
  see(map.reduced_frequency(q0, point.temperature + found.theta[0]));
  see(map.reduced_frequency(q1, point.temperature + found.theta[found.theta.size() - 1]));
  constexpr double rounding = 1e-12;
  if (lowest < known->lowest * (1 - rounding) || highest > known->highest * (1 + rounding))
    throw OutOfRange(at + " and is asked for its modulus from " + show(lowest) + " to " + show(highest) +
                     " rad/s at the reference of its shift, known in [" + show(known->lowest) + ", " +
                     show(known->highest) + "] rad/s");
}

double FlashSolver::outside_share(const FlashMap& map) const {
  const std::vector<double>& w = map.reduced_frequency();
  if (const auto* series = std::get_if<PronySeries>(&scene_.rubber); series && !series->fitted_range()) return 0;
  std::vector<double> i1(w.size()), i2(w.size()), outside(w.size());
  std::vector<double> held = w;  // nodes may miss the end of the range by rounding
  if (const auto known = known_range(scene_.rubber))
    for (double& one : held) one = std::clamp(one, known->lowest, known->highest);
  if (!angular_integrals(scene_.rubber, held, i1, i2, outside)) return 0;
  const std::vector<double> part = map.contributions();
  double sum = 0, whole = 0;
  for (std::size_t j = 0; j < part.size(); ++j) {
    sum += part[j] * outside[j] / i1[j];
    whole += part[j];
  }
  return whole > 0 ? sum / whole : 0;
}

double FlashSolver::temperature_at(double wavenumber) const {
  return point_.temperature + levels_[before_level_].grid->row_at(wavenumber).dot(before_.theta);
}

double FlashSolver::hysteresis_density(double wavenumber) const {
  const FlashMap& map = *levels_[finest_].map;
  const HeatGrid& grid = *levels_[finest_].grid;
  const double t = grid.t_at(wavenumber);
  std::size_t panel = 0;
  while (panel + 1 < grid.panels().size() && wavenumber > grid.panels()[panel].end) ++panel;
  const HeatGrid::Panel& at = grid.panels()[panel];
  if (wavenumber < at.segment->a || wavenumber > at.segment->b) return 0;  // in an empty bin
  const double g = map.g_on(panel, std::clamp(2 * (t - at.lower) / (at.upper - at.lower) - 1, -1.0, 1.0));
  const double share = g > 0 ? contact_share(g, scene_.model.form) : 1;
  const double square = wavenumber * wavenumber, stiff = 1 - scene_.model.poisson_ratio * scene_.model.poisson_ratio;
  double w = map.reduced_frequency(wavenumber, temperature_at(wavenumber));
  if (const auto known = known_range(scene_.rubber)) w = std::clamp(w, known->lowest, known->highest);
  return square * square * at.segment->density(wavenumber) * angular_integrals(scene_.rubber, w).i1 * share *
         (scene_.factor ? (*scene_.factor)(share) : 1) /
         (2 * stiff * point_.pressure * point_.shift_factor * point_.shift_factor);
}

std::vector<FlashSolver::PanelShare> FlashSolver::shares() const {
  const FlashMap& map = *levels_[finest_].map;
  const HeatGrid& grid = *levels_[finest_].grid;
  const std::vector<double> part = map.contributions();
  std::vector<PanelShare> result;
  for (const HeatGrid::Panel& panel : grid.panels()) {
    double sum = 0;
    for (std::size_t j = 0; j < panel.rule->n; ++j) sum += part[panel.first + j];
    result.push_back({grid.wavenumber_at(panel.lower), panel.end, sum});
  }
  return result;
}

}  // namespace asperity
