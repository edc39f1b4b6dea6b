// The error of a grid is what the next finer one changes, beside what the residual of the fixed point leaves: it covers
// the quadrature, the points of the temperature and the fixed point at once.
#include "heat/flash_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/correction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/roots.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t levels = 7;  // up to 16 digits
/// Rows of a measured modulus lie anywhere in panels, and levels tell what they miss of these only where they differ:
/// so panels are halved from level to level, and where rows scatter more often.
constexpr std::size_t levels_with_rows = 11;
/// From which on panels are not halved once more: matrices of twice as many nodes take a quarter of a gigabyte.
constexpr std::size_t most_nodes = 30'000;
/// Lesser tolerances are not reached on pieces.
constexpr double pieces_rtol = 1e-7;
/// With factors of strain G at q_m is known to some 1e-7 alone, where rings scatter.
constexpr double pieces_rtol_with_strain = 1e-6;

/// Of the tolerance, at least. Two levels may be off alike by chance, then differ by less than either is off, and
/// nothing of the two tells it. Only a third level would, at as much cost as both. So this floor is measured, not
/// derived: without it a thin front was off by a fiftieth of the tolerance where less was told.
constexpr double least_error = 1.0 / 30;
/// How many times the difference of two levels is told. Twice, as the finer one has an error too; where rows of a
/// measured modulus lie anywhere between nodes levels do not get better by two digits each, and twice was exceeded at
/// one of 400 random points. Of these the tolerance itself is told, as chance is more frequent.
constexpr double differences = 2, differences_with_rows = 4;
/// What a grid of half the distances keeps of an error, at least: pieces of two nodes are of fourth order at best.
constexpr double kept_of_a_kink = 1.0 / 16;

/// From values at the temperature points of one grid to those at the points of another.
MatrixXd carrying(const HeatGrid& from, const HeatGrid& to) {
  const auto n = static_cast<Index>(to.temperature_points().size());
  MatrixXd result(n, static_cast<Index>(from.temperature_points().size()));
  for (Index i = 0; i < n; ++i)
    if (i == 0 && to.lone_point())
      result.row(i) = Eigen::RowVectorXd::Unit(result.cols(), 0);
    else
      result.row(i) = from.row_at(to.temperature_points()[static_cast<std::size_t>(i)]);
  return result;
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

FlashSolver::FlashSolver(const HeatScene& scene, Branch branch)
    : scene_(scene),
      branch_(branch),
      kinks_(Excitation(scene.rubber, scene.model, scene.surface).stops()),
      known_(known_range(scene.rubber)),
      levels_(has_rows() ? levels_with_rows : levels),
      uniform_(scene) {
  if (has_own_rule(scene.model.correction)) window_.emplace(scene.surface);
  const double digits = -std::log10(scene.model.rtol);
  first_level_ = 1;  // differences of coarser grids are small by chance where a front is thin
  while (first_level_ + 2 < levels && HeatGrid::digits(first_level_ + 1) < digits + 1) ++first_level_;
  level_ = first_level_;
}

void FlashSolver::forget() {
  before_.clear();
  uniform_.forget();
  level_ = first_level_;
}

void FlashSolver::set_stops(std::vector<double> stops) {
  if (stops == stops_) return;
  stops_ = std::move(stops);
  levels_ = std::vector<Level>(levels_.size());
  forget();
}

FlashMap& FlashSolver::map_of(std::size_t level) {
  Level& made = levels_[level];
  if (!made.map) {
    ContactGridOptions options{.poisson_ratio = scene_.model.poisson_ratio,
                               .level = level,
                               .tabulated = has_rows(),
                               .macro_wavenumber = scene_.macro_wavenumber,
                               .stops = kinks_,
                               .window = window_ ? &*window_ : nullptr,
                               .about_nodes = harmonics_of(scene_.spectrum) != nullptr,
                               .held_from = held_from_};
    options.stops.insert(options.stops.end(), stops_.begin(), stops_.end());
    const auto* const table = std::get_if<TabulatedSpectrum>(&scene_.spectrum);
    const bool by_pieces = table && stops_.empty() &&
                           scene_.model.rtol >= (kinks_.empty() ? pieces_rtol : pieces_rtol_with_strain) &&
                           table->wavenumber().size() >= RoughnessPieces::least_rows;
    if (by_pieces && level <= (has_rows() ? RoughnessPieces::levels_with_rows : RoughnessPieces::levels)) {
      if (!kinks_.empty())
        made.cut = std::make_unique<RoughnessPieces>(scene_.surface, level - 1, kinks_, harmonics_of(scene_.spectrum));
      options.pieces = made.cut ? made.cut.get() : &roughness_pieces(*table, level - 1);
      options.rings = harmonics_of(scene_.spectrum);
    } else if (has_rows()) {
      options.halvings = level - (by_pieces ? 3 : 1);  // of some twice as many nodes as the last pieces
    }
    made.grid = std::make_unique<HeatGrid>(scene_.surface, options,
                                           asperity_wavenumber(scene_.model.correction, scene_.spectrum));
    made.map = std::make_unique<FlashMap>(scene_, *made.grid);
    if (level > 0 && levels_[level - 1].grid) {
      made.up = carrying(*levels_[level - 1].grid, *made.grid);
      made.down = carrying(*made.grid, *levels_[level - 1].grid);
    }
  }
  return *made.map;
}

/// By the last two points, whose rises go on as powers of the velocity; empty without a point.
VectorXd FlashSolver::guess(double velocity) const {
  if (before_.empty() || before_.back().level != level_) return {};
  const Solved& last = before_.back();
  if (before_.size() < 2 || before_.front().level != level_) return last.theta;
  const Solved& first = before_.front();
  const double share = std::log(velocity / last.velocity) / std::log(last.velocity / first.velocity);
  if (!(share > 0 && share < 2)) return last.theta;
  VectorXd result = last.theta;
  for (Index i = 0; i < result.size(); ++i)
    if (last.theta[i] > 0 && first.theta[i] > 0)
      result[i] *= std::pow(std::clamp(last.theta[i] / first.theta[i], 0.2, 5.0), share);
  return result;
}

/// Lets the next point try a grid coarser by one, which costs little beside the two that this one needed: a point that
/// is hard shall not make all after it dear.
void FlashSolver::begin_next_below() {
  const MatrixXd& down = levels_[level_].down;
  if (level_ == first_level_ || down.size() == 0) return;
  for (Solved& solved : before_) {
    if (solved.level != level_) continue;
    solved.theta = (down * solved.theta).cwiseMax(0.0);
    --solved.level;
  }
  --level_;
}

/// Beyond the end of the roughness the modulus is held where it is not known any more, at which panels shall end, as
/// it has a kink there. True where that place has moved with this point or its temperatures.
bool FlashSolver::end_panel_where_held(const HeatPoint& point, const VectorXd& theta) {
  const HeatGrid& grid = map_of(level_).grid();
  const std::vector<double>& ends = grid.beyond().ends;
  if (ends.empty() || !known_) return false;
  const auto over_known = [&](double log_q) {
    const double q = std::exp(log_q), rise = theta.size() == 0 ? 0 : grid.row_at(q).dot(theta);
    const ShiftValue shift = held_shift(scene_.shift, point.temperature + rise);
    return std::log(point.velocity * q / known_->highest) + std::numbers::ln10 * shift.log10_a_T;
  };
  const double lower = std::log(ends.front()), upper = std::log(ends.back());
  const double near = 0.1 * std::sqrt(scene_.model.rtol);  // the error goes as its square
  std::optional<double> found;
  if (over_known(lower) < 0 && over_known(upper) > 0)
    found = std::exp(bracketed_root(over_known, lower, upper, 0.1 * near));
  if (!found && !held_from_) return false;
  if (found && held_from_ && std::fabs(std::log(*found / *held_from_)) < near) return false;
  held_from_ = found;
  uniform_.forget();
  levels_ = std::vector<Level>(levels_.size());
  return true;
}

HotPoint FlashSolver::operator()(const HeatPoint& point) {
  const double rtol = scene_.model.rtol, tolerance = std::clamp(0.02 * rtol, 1e-13, 1e-5);
  VectorXd start = guess(point.velocity);
  (void)end_panel_where_held(point, start);
  FlashMap* map = nullptr;
  FixedPoint found;
  int moves = 5;
  do {
    map = &map_of(level_);
    map->start(point);
    if (uniform_level_ != level_) uniform_.forget();
    uniform_level_ = level_;
    found = solve_fixed_point(*map, point, start, uniform_.only_rise(*map, point), branch_, tolerance, tangent_);
    start = found.theta;
  } while (--moves > 0 && end_panel_where_held(point, found.theta));
  const int branches = found.solutions;
  if (before_.size() == 2) before_.erase(before_.begin());
  before_.push_back({point.velocity, level_, found.theta});
  const double gain = gain_of(*map, tangent_, std::fmax(1e-9, 0.03 * std::sqrt(rtol)));
  double apart_before = 0;  // the two grids before, in mu
  for (std::size_t level = level_ + 1;; ++level) {
    const bool too_fine = has_rows() && level > level_ + 1 && map->grid().size() > most_nodes;
    if (level == levels_.size() || too_fine) {
      check_temperatures(*map, found, point);
      throw NotConverged("mu = " + show(map->hysteresis() + map->adhesion()) +
                         " with the heat it makes, on a grid of " + std::to_string(map->grid().size()) +
                         " nodes, changes by more than rtol = " + show(rtol) + " from grid to grid");
    }
    const double coarse = map->hysteresis() + map->adhesion(), coarse_hysteresis = map->hysteresis(),
                 coarse_area = map->contact_area(), coarse_lateral = map->lateral();
    const FixedPoint on_coarse = found;
    FlashMap& finer = map_of(level);
    finer.start(point);
    finer.begin_at_kappa_of(*map);
    if (level > level_ + 1) {
      tangent_.take(*map);
      before_.back() = {point.velocity, level - 1, found.theta};
    }
    found = polish(finer, found.theta, tangent_, levels_[level].up, levels_[level].down, tolerance);
    VectorXd of_coarse, of_finer;
    sum_cells(map->grid(), map->contributions(), of_coarse);
    sum_cells(finer.grid(), finer.contributions(), of_finer);
    double apart = most_apart(of_coarse, of_finer, common_ends(map->grid(), finer.grid()));
    map = &finer;
    finest_ = level;
    const double mu = map->hysteresis() + map->adhesion();
    apart = std::max({apart, std::fabs(mu - coarse), std::fabs(map->lateral() - coarse_lateral)});
    // Where one row's kink counts for most, two grids may have it alike between their nodes and tell nothing of it;
    // seldom have three. Of what the two before were apart these keep a part; two alone must agree so much better.
    if (const double now = apart; has_rows()) {
      apart = apart_before > 0 ? std::fmax(now, kept_of_a_kink * apart_before) : now / kept_of_a_kink;
      apart_before = now;
    }
    // the residual's effect is taken to first order
    const double times = has_rows() ? differences_with_rows : differences;
    const double least = std::fmax(least_error * rtol, 1e-13) + 4 * map->shift().relative_error;
    const double error = times * apart + map->rest_of_harmonics() * map->hysteresis() +
                         2 * std::fmax(found.mu_error, on_coarse.mu_error) + least * mu;
    // an elastic rubber has an area alone
    const double area = map->contact_area(), of_area = std::fabs(area - coarse_area);
    if (!(error <= rtol * mu && of_area <= rtol * area)) {
      check_temperatures(*map, found, point, std::fmin(0.01 + std::fmax(error / mu, of_area / area), 1));
      continue;
    }
    level_ = level - 1;
    begin_next_below();
    check_temperatures(*map, found, point);
    theta_ = found.theta;
    point_ = point;
    const double hysteresis = map->hysteresis();
    const double of_hysteresis = times * std::fmax(std::fabs(hysteresis - coarse_hysteresis), apart) +
                                 2 * std::fmax(found.hysteresis_error, on_coarse.hysteresis_error);
    const double off_area = times * of_area + 2 * std::fmax(found.area_error, on_coarse.area_error);
    double parts_error = area > 0 ? off_area / area : 0;
    if (hysteresis > 0) parts_error = std::fmax(parts_error, of_hysteresis / hysteresis);
    parts_error = std::fmax(parts_error + least, has_rows() ? rtol : 0);
    return {map->hysteresis(),
            map->adhesion(),
            map->contact_area(),
            has_rows() ? rtol * mu : error,
            map->lateral(),
            parts_error,
            map->outside_share(),
            point.temperature + map->grid().row_at(band(scene_.spectrum)[1]).dot(found.theta),
            map->macro_area(),
            gain,
            branches,
            map->shift(),
            map->g()};
  }
}

/// Refuses a solution that was found where nothing is known. There the modulus is held and has a kink, at which grids
/// may never agree: those that do not yet are asked too, whose rises and frequencies are `in_doubt`, relative.
void FlashSolver::check_temperatures(const FlashMap& map, const FixedPoint& found, const HeatPoint& point,
                                     double in_doubt) const {
  const auto [q0, q1] = band(scene_.spectrum);
  const auto temperature = [&](double q) { return point.temperature + map.grid().row_at(q).dot(found.theta); };
  const double rise = found.theta.maxCoeff(), hottest = point.temperature + (1 - in_doubt) * rise;
  const auto at = [&] {
    return argument("temperature") + " = " + in_kelvin(point.temperature) + ", " + argument("velocity") + " = " +
           value(point.velocity) + ": the rubber heats itself to " + in_kelvin(point.temperature + rise) + unit("K");
  };
  if (hottest > highest_rubber_temperature)
    throw OutOfRange(
        at() + ", above " + in_kelvin(highest_rubber_temperature) + unit("K") + ", which it does not stand", "too-hot");
  try {
    (void)shift_at(scene_.shift, hottest);
  } catch (const OutOfRange& error) {
    throw OutOfRange(error.diagnostic().within(at() + ": "));
  }
  if (!known_) return;
  double lowest = HUGE_VAL, highest = 0;
  const auto see = [&](double w) {
    lowest = std::fmin(lowest, w);
    highest = std::fmax(highest, w);
  };
  for (const double w : map.reduced_frequency()) see(w);
  for (const double q : {q0, q1}) see(map.reduced_frequency(q, temperature(q)));
  if (const auto q = asperity_wavenumber(scene_.model.correction, scene_.spectrum))
    see(map.reduced_frequency(*q, point.temperature + map.grid().also_felt().dot(found.theta)));
  if (lowest < known_->lowest * (1 - in_doubt) || highest > known_->highest * (1 + in_doubt))
    throw OutOfRange(at() + " and is asked for its modulus from " + show(lowest) + " to " + show(highest) +
                         " rad/s at the reference of its shift, known in [" + show(known_->lowest) + ", " +
                         show(known_->highest) + "] rad/s",
                     "unknown-hot-modulus");
}

double FlashSolver::temperature_at(double wavenumber) const {
  return point_.temperature + levels_[finest_].grid->row_at(wavenumber).dot(theta_);
}

double FlashSolver::hysteresis_density(double wavenumber) const {
  return levels_[finest_].map->hysteresis_density(wavenumber, temperature_at(wavenumber));
}

std::vector<PanelSum> FlashSolver::shares() const {
  return sums_of_panels(*levels_[finest_].grid, levels_[finest_].map->contributions());
}

}  // namespace asperity
