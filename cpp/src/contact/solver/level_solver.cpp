// Two levels of nodes (contact/grid) solve a point by one theory (contact/theory). Panels of a level more are two
// digits better; with knots of a measured modulus, at which they end, by a power of the number of nodes.
#include "contact/solver/level_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double for_edges = 0.02;  // of the tolerance
/// The error of the finer level, by what it changes: it should be a sixteenth. Other sums tell the error where mu and
/// the area agree by chance. What pieces leave out of rough rings differs from level to level without a rule.
constexpr double of_change = 0.75, of_rest = 2;
constexpr double of_change_across = 0.25;    // of the force across: what pieces leave out of it stands beside it
constexpr double of_left_out = 2;            // of what pieces leave out of harmonics, about at most
constexpr double of_change_at_fronts = 1.5;  // beside which levels agree by chance
/// Two levels may agree by chance, so that of the tolerance something is taken at least: on pieces one point in a
/// hundred was off by half of it where they did, beside fronts one in 10,000. On panels PartialContact has no fronts,
/// but at knots of a measured modulus one point in 50,000 was off by a third
/// (tests/stability/random_partial_tables.py, random_scenes.py).
constexpr double least_error = 0.75, least_at_knots = 1.0 / 3, least_without_front = 1.0 / 30;
/// Of the tolerance, less what errors of others take of it, but never below the last.
constexpr double most_error = 0.85, most_misfit = 0.95, least_accepted = 0.1;
/// As one level more is two digits more, one that changes much less than that does so by chance.
constexpr double of_change_before = 1.0 / 64;
constexpr std::size_t levels_before_front = 3;
constexpr std::size_t finest = 6;           // level of nodes of panels: more than doubles hold
constexpr std::size_t finest_at_knots = 3;  // further levels halve panels
constexpr std::size_t most_levels = 10;
constexpr Index between_ends = 16;   // nodes
constexpr double least_rtol = 1e-7;  // lesser ones are not reached on pieces

double difference(double a, double b) { return b == 0 ? 0 : std::fabs(a / b - 1); }

}  // namespace

LevelSolver::LevelSolver(const Spectrum& spectrum, std::span<const Segment> surface, const Excitation& waves,
                         const ContactModel& model, const Options& options)
    : spectrum_(spectrum),
      rings_of_(waves.directions() ? harmonics_of(spectrum) : nullptr),
      surface_(surface),
      waves_(waves),
      model_(model),
      options_(options),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      edges_of_(waves, for_edges * model.rtol),
      known_(known_range(waves.rubber())) {
  if (has_own_rule(model.correction)) window_.emplace(surface);
  if (const auto* const series = std::get_if<PronySeries>(&waves.rubber())) {
    known_in_part_ = series->fitted_range().has_value();
    analytic_.emplace(PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times()));
    analytic_waves_.emplace(*analytic_, waves);
  }
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  const bool many_rows = table && table->wavenumber().size() >= RoughnessPieces::least_rows;
  if ((many_rows || !analytic_) && model.rtol >= least_rtol && !options.parts)
    pieces_.resize(rings_of_ || waves.softening() ? RoughnessPieces::levels_with_rows : RoughnessPieces::levels);
  for (Levels* const levels : {&panels_, &front_}) levels->resize(most_levels);
  constexpr double digits_a_level = 2;
  const double wanted = -std::log10(model.rtol) - 1 - ContactGrid::first_digits;
  while (first_level_ + 2 < finest + 1 && digits_a_level * static_cast<double>(first_level_ + 1) < wanted)
    ++first_level_;
}

/// How many harmonics matter, and the edges of contacts beside pieces.
void LevelSolver::begin(double velocity) {
  if (velocity == velocity_) return;
  velocity_ = velocity;
  if (rings_of_) take_harmonics();
  if (window_ && !pieces_.empty())
    edges_ = edges_of_(velocity, window_->end(), 1, partial_contact::tail_end, needed_.count);
}

/// I1 and I2 at all nodes of a level from the modulus itself, those of the edges among them. Beyond the band the
/// modulus keeps the value that it has at the last frequency that is known.
void LevelSolver::take_moduli(Level& level, bool first) {
  const ContactGrid& grid = *level.grid;
  const std::size_t n = grid.size();
  for (auto* const row : {&level.i1, &level.i2}) row->resize(n + RoughnessCells::excess);
  if (rings_of_) level.across.resize(n + RoughnessCells::excess);
  if (rings_of_ && window_) level.about.resize(n + RoughnessCells::excess);
  if (rings_of_ && grid.pieces() && kinks())
    for (auto* const row : {&level.mean_i1, &level.mean_i2}) row->resize(n);
  if (grid.pieces() && analytic_) {
    take_moduli_of_pieces(level, first);
    return;
  }
  level.frequency.resize(n);
  for (std::size_t i = 0; i < n; ++i) level.frequency[i] = velocity_ * grid.wavenumber()[i];
  if (known_ && !grid.pieces())
    for (double& w : level.frequency) w = std::min(w, known_->highest);
  const std::span<double> i1{level.i1.data(), n}, i2{level.i2.data(), n};
  const bool asked = analytic_ ? first && known_in_part_ : first || any_outside_;
  if (asked) level.i1_outside.resize(n);
  const Excitation& waves = analytic_waves_ ? *analytic_waves_ : waves_;
  const Directed directed = this->directed(level);
  const bool any = asked && waves_(level.frequency, level.factors, i1, i2, level.i1_outside, directed);
  if (first) any_outside_ = any;
  if (!any) level.i1_outside.clear();
  if (analytic_ || !asked) (void)waves(level.frequency, level.factors, i1, i2, {}, directed);
}

void LevelSolver::lay_out(Levels& levels, std::size_t number) {
  Level& level = levels[number];
  ContactGridOptions options{.poisson_ratio = model_.poisson_ratio};
  if (&levels == &pieces_) {
    const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum_);
    if (!table && !rings_of_ && waves_.kinks().empty())
      level.pieces = roughness_pieces(std::get<SelfAffineSpectrum>(spectrum_), number);
    else if (!table || !waves_.kinks().empty())
      level.pieces = std::make_shared<RoughnessPieces>(surface_, number, waves_.kinks(), rings_of_);
    options.pieces = level.pieces ? level.pieces.get() : &roughness_pieces(*table, number);
    if (window_) options.window = &options.pieces->window();
    options.edge_nodes = false;
  } else {
    const bool knots = kinks();
    const std::size_t of_nodes = knots ? finest_at_knots : finest;
    options.level = std::min(first_level_ + number, of_nodes);
    options.halvings = first_level_ + number - options.level;
    options.stops = &levels == &front_ ? front_stops_ : stops_;
    options.kinks_at_stops = knots;
    if (window_) options.window = &*window_;
    options.held_from = held_from_;
  }
  level.grid = std::make_unique<ContactGrid>(surface_, options);
  level.factors = waves_.factors(*level.grid);
  level.rings = waves_.rings(*level.grid);
  level.theory = contact_theory(model_, spectrum_, surface_, *level.grid, waves_.directions());
  if (number == 0) return;
  if (!levels[number - 1].grid) lay_out(levels, number - 1);
  level.common_ends_with_coarse = common_ends(*levels[number - 1].grid, *level.grid, between_ends);
}

LevelSolver::Level& LevelSolver::at_velocity(Levels& levels, std::size_t number) {
  Level& level = levels[number];
  if (level.velocity == velocity_) return level;
  if (!level.grid) lay_out(levels, number);
  level.velocity = velocity_;
  const std::size_t n = level.grid->size();
  if (!kinks() && !level.grid->pieces() && number == 0) {  // at hand from the next level, which every point needs
    const Level& next = at_velocity(levels, 1);
    if (!level.from_next) level.from_next = cells_between(*next.grid, *level.grid);
    for (auto* const row : {&level.i1, &level.i2}) row->resize(n + RoughnessCells::excess);
    level.from_next->at_nodes(next.i1.data(), next.i2.data(), level.i1.data(), level.i2.data());
    if (rings_of_) {
      level.across.resize(n + RoughnessCells::excess);
      level.about.resize(next.about.empty() ? 0 : n + RoughnessCells::excess);
      const std::vector<double>& second = next.about.empty() ? next.across : next.about;
      std::vector<double>& to_second = next.about.empty() ? level.across : level.about;
      level.from_next->at_nodes(next.across.data(), second.data(), level.across.data(), to_second.data());
    }
  } else {
    take_moduli(level, number == (kinks() || level.grid->pieces() ? 0 : 1));
  }
  check_directions(level);
  level.theory->take({{level.i1.data(), n}, {level.i2.data(), n}, level.about});
  if (window_ && level.grid->pieces()) level.theory->take_edges(edges_);
  return level;
}

/// The share of friction from frequencies outside of the measured range.
double LevelSolver::outside_share(const Level& level, const ContactSums& sums) const {
  if (!(sums.friction > 0)) return 0;
  double sum = 0;
  if (level.grid->pieces() && window_) {
    sum = sums.edges * level.grid->beyond().end->window * edges_.i1_outside;
    const VectorXd& stress = level.theory->stress();
    for (Index i = 0; !level.i1_outside.empty() && i < stress.size(); ++i)
      sum += level.grid->weight()[i] * stress[i] * level.i1_outside[static_cast<std::size_t>(i)];
    return sum / sums.friction;
  }
  if (level.i1_outside.empty() && (level.grid->pieces() || !known_)) return 0;
  const VectorXd& part = level.theory->part();
  for (std::size_t i = 0; i < level.grid->size(); ++i) {
    const bool held = i >= level.grid->band_size() && known_ && level.frequency[i] >= known_->highest;
    if (level.i1[i] > 0 && (held || !level.i1_outside.empty()))
      sum += part[static_cast<Index>(i)] * (held ? 1 : level.i1_outside[i] / level.i1[i]);
  }
  return sum / scale_ / sums.friction;
}

double LevelSolver::share_beyond(double wavenumber) const {
  if (!(sums_.friction > 0)) return 0;
  const ContactGrid& grid = *solved_->grid;
  const bool by_stress = window_ && grid.pieces();
  const VectorXd& of = by_stress ? solved_->theory->stress() : solved_->theory->part();
  double sum = 0;
  if (by_stress && window_->end() > wavenumber) sum = sums_.edges * grid.beyond().end->window * edges_.i1;
  const std::size_t n = grid.pieces() ? grid.band_size() : grid.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Index>(i);
    if (grid.wavenumber()[i] > wavenumber)
      sum += of[at] * (by_stress ? grid.weight()[at] * solved_->i1[i] : 1 / scale_);
  }
  return std::fmin(1, sum / sums_.friction);
}

void LevelSolver::solve(double pressure, double velocity, double shift, double others) {
  others_ = others;
  begin(velocity);
  solved_ = nullptr;
  if (!pieces_.empty() && solve_on(pieces_, pressure, shift)) return;
  begin_panels();
  if (solve_on(panels_, pressure, shift)) return;
  if (!window_) {
    lay_out_front();
    if (solve_on(front_, pressure, shift)) return;
  }
  throw NotConverged("mu_H = " + show(hysteresis_.value) + " with relative error " + show(error_) + " on " +
                     std::to_string(solved_->grid->size()) + " nodes where " + argument("rtol") + " = " +
                     show(model_.rtol) + " was asked for");
}

/// How far two levels are apart at most, in mu, the area, kappa and their slopes, over each, in sums over cells, and in
/// where friction comes from: two levels may agree in the whole by chance, but not in all of them too.
double LevelSolver::change_between(const Level& coarse, const ContactSums& before, const Level& fine,
                                   const ContactSums& now) const {
  const double whole = now.friction * scale_,
               apart = most_apart(coarse.cell_part, fine.cell_part, fine.common_ends_with_coarse);
  return std::max({difference(now.friction, before.friction), difference(now.share, before.share),
                   difference(fine.theory->unit_g(), coarse.theory->unit_g()), difference(now.kappa, before.kappa),
                   std::fabs(now.slope - before.slope), std::fabs(now.friction_slope - before.friction_slope),
                   std::fabs(fine.theory->mean_place() - coarse.theory->mean_place()), whole > 0 ? apart / whole : 0});
}

bool LevelSolver::solve_on(Levels& levels, double pressure, double shift) {
  const bool by_pieces = &levels == &pieces_;
  const double root = 1 / (pressure * shift);
  scale_ = root * root;
  mu_factor_ = 4 * pressure / stiffening_ * scale_;
  Level* coarse = &at_velocity(levels, 0);
  g_ = coarse->theory->unit_g() * scale_;
  sums_ = {};
  hysteresis_ = {};
  error_ = 0;
  if (g_ == 0) return !by_pieces;
  solved_ = coarse;
  check_g(g_, pressure);
  const bool friction = by_pieces || window_ || options_.hysteresis;  // an area of PartialContact asks for its kappa
  const auto solve_at = [&](Level& level, double kappa) {
    if (!friction) return ContactSums{};
    const ContactSums sums = level.theory->solve(scale_, model_.rtol, kappa);
    level.cell_part = level.theory->cell_part();
    return sums;
  };
  ContactSums before = solve_at(*coarse, usual_kappa);
  double outside = by_pieces || kinks() ? outside_share(*coarse, before) : 0, across_before = across(*coarse, before);
  const double of_edges = window_ && by_pieces
                              ? std::fmax(edges_.i2_error / edges_.i2, edges_.i1 > 0 ? edges_.i1_error / edges_.i1 : 0)
                              : 0;
  const bool knots = kinks();
  const auto accepted = [&](double share) {
    return std::fmax(share * model_.rtol - others_, least_accepted * model_.rtol);
  };
  double change_before = 0;
  bool with_rests = false;  // of harmonics, which are added where the levels do not do without
  for (std::size_t number = 1; number < levels.size(); ++number) {
    if (number > 1) heed();
    Level& level = at_velocity(levels, number);
    ContactSums now = solve_at(level, before.kappa);
    double lateral = across(level, now);
    const auto error_between = [&] {
      const double change = change_between(*coarse, before, level, now);
      double result = (by_pieces || window_ ? of_change : of_change_at_fronts) * change;
      if (!by_pieces) result = std::fmax(result, of_change_before * std::exchange(change_before, change));
      if (rings_of_ && now.friction > 0) {
        double off = of_change_across *
                     std::fmax(most_apart(coarse->cell_across, level.cell_across, level.common_ends_with_coarse),
                               std::fabs(lateral - across_before));
        if (by_pieces && needed_.count > 0)
          off = std::fmax(off, of_left_out * (with_rests ? level.next_order : left_out(level)));
        result = std::fmax(result, off / now.friction);
      }
      if (by_pieces && knots && result <= accepted(most_error)) result = std::fmax(result, beside_knots(level, now));
      return result + needed_.rest + (by_pieces ? of_rest * RoughnessPieces::roughest(number) + of_edges : 0);
    };
    if (with_rests) lateral += add_rests(level, now);
    double error = error_between();
    if (by_pieces && needed_.count > 0 && !with_rests && now.friction > 0 && !(error <= accepted(most_error))) {
      with_rests = true;
      across_before += add_rests(*coarse, before);
      lateral += add_rests(level, now);
      error = error_between();
    }
    across_before = lateral;
    if (!analytic_ || (number == 1 && !by_pieces && !kinks())) outside = outside_share(level, now);
    before = now;
    solved_ = coarse = &level;
    hysteresis_.value = mu_factor_ * now.friction;
    error_ = error;
    if (!(error <= accepted(most_error))) continue;
    const double misfit = !by_pieces && now.friction > 0 ? level.theory->front_misfit() / now.friction : 0;
    if (!(misfit <= accepted(most_misfit))) {
      if (number == levels_before_front && &levels != &front_) return false;
      continue;
    }
    sums_ = now;
    g_ = level.theory->unit_g() * scale_;
    const double value = mu_factor_ * now.friction, own = std::fmax(error, misfit),
                 least = by_pieces || !window_ ? least_error
                         : knots               ? least_at_knots
                                               : least_without_front;
    error_ = std::fmax(own, least * model_.rtol);
    const VectorXd steering = level.sideways.size() > 0 ? level.theory->steering() : VectorXd();
    const double steered = level.sideways.head(steering.size()).dot((steering.array() - 1).matrix());
    hysteresis_ = {value, value * own, value * error_, value * outside, mu_factor_ * (lateral + steered)};
    solved_ = &level;
    return true;
  }
  return false;
}

AngularIntegrals LevelSolver::modulus(double wavenumber, Waves waves) const {
  const double w = velocity_ * wavenumber;
  return waves_(known_ ? std::clamp(w, known_->lowest, known_->highest) : w, wavenumber, waves);
}

double LevelSolver::g(double wavenumber) const {
  if (!solved_ || solved_->grid->pieces() || wavenumber >= surface_.back().b) return g_;
  const ContactGrid::Place place = solved_->grid->place_of(wavenumber);
  std::vector<double> q, weight;
  solved_->grid->nodes_to(place, q, weight);
  double sum = 0;
  for (std::size_t i = 0; i < q.size(); ++i) sum += weight[i] * modulus(q[i]).i2;
  return scale_ * (solved_->theory->unit_g_before(place) + sum);
}

double LevelSolver::stress(double wavenumber) const {
  return solved_ ? solved_->theory->stress_at(g(wavenumber), wavenumber, modulus(wavenumber, Waves::of_edges).i2) : 1;
}

double LevelSolver::hysteresis_density(double wavenumber) const {
  if (!solved_) return 0;
  const AngularIntegrals of_edges = modulus(wavenumber, Waves::of_edges);
  const double per_stress = mu_factor_ / scale_,
               edges = per_stress * solved_->theory->density_of_edges(wavenumber, of_edges.i1, of_edges.i2);
  if (wavenumber > surface_.back().b) return edges;
  const AngularIntegrals at = modulus(wavenumber);
  const double rate = solved_->grid->place_of(wavenumber).rate;
  return edges + mu_factor_ * rate * at.i1 * solved_->theory->stress_at(g(wavenumber), wavenumber, of_edges.i2);
}

std::vector<PanelSum> LevelSolver::shares() const {
  if (!solved_) return {};
  std::vector<PanelSum> result = sums_of_panels(*solved_->grid, solved_->theory->part());
  for (PanelSum& one : result) one.sum *= mu_factor_ / scale_;
  return result;
}

}  // namespace asperity
