// Friction of rubber on a rough surface: the hysteresis (Eq. 22),
//   mu_H = 1/2 int q^3 C(q) S(q) P(q) dq int cos(phi) Im E(q v cos phi) / ((1 - nu^2) sigma0) dphi,
// and the adhesion of the contact area (Eq. 23), at pairs of pressure and velocity.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "asperity/friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numbers>

#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "contact/model_error.hpp"
#include "contact/solver/solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/validity.hpp"
#include "friction/before_heating.hpp"
#include "friction/scan_friction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// Powers of ten that enclose every v q [rad/s].
std::vector<double> decades(double lowest, double highest) {
  std::vector<double> edges;
  for (int k = static_cast<int>(std::floor(std::log10(lowest) + rounding_error));; ++k) {
    edges.push_back(std::pow(10.0, k));
    if (!is_below(edges.back(), highest)) return edges;
  }
}

/// 32 wavenumbers a decade, both ends included; nearer to q0 than that they follow the narrowest front, of width
/// `front` in ln q, in steps that grow by a third.
std::vector<double> contribution_wavenumbers(double q0, double q1, double front) {
  const double length = std::log(q1 / q0);
  const double steps = std::ceil(32 * length / std::numbers::ln10), regular = length / steps;
  std::vector<double> s{0};
  for (double at = front / 8; at < regular; at *= 4.0 / 3) s.push_back(at);
  for (double i = 1; i <= steps; ++i) s.push_back(i * regular);
  for (double& at : s) at = std::fmin(q0 * std::exp(at), q1);
  s.back() = q1;
  return s;
}

/// The results at one pressure and velocity; zeros where there is no contact.
struct Point {
  double hysteresis = 0, lateral = 0, adhesion = 0, contact_area = 0, error_estimate = 0, extrapolated_share = 0;
  double model_error = std::numeric_limits<double>::quiet_NaN();
  ValidityFlags validity;
};

/// How an error of G passes on: |d ln P / d ln G| is 1/2 at most, and d ln F / d ln G is 1 at most whatever S is.
double sensitivity(bool with_s) { return with_s ? 1 : 0.5; }

/// Everything that points share.
struct Scene {
  const Spectrum& spectrum;
  const Rubber& rubber;
  const ContactModel& model;
  const std::optional<Adhesion>& adhesion;
  std::span<const Segment> surface;
  std::span<const double> stops;  // angular frequencies at which contributions are told apart
};

/// What one thread solves points with.
class PointSolver {
 public:
  explicit PointSolver(const Scene& scene)
      : scene_(scene),
        q1_(band(scene.spectrum)[1]),
        area_g_(scene.model, scene.spectrum, scene.surface, q1_),
        validity_(scene.surface, scene.model.form, q1_),
        model_error_(scene.model.correction, scene.spectrum, scene.rubber),
        solver_(scene.spectrum, scene.surface, scene.rubber, scene.model,
                {.parts = !scene.stops.empty(), .stops = scene.stops}) {}

  Point operator()(double pressure, double velocity, const Shift& shift);
  /// Of the last point: row i of the tables.
  void add_contributions(Contributions& c, std::size_t i, double velocity) const;

 private:
  const Scene& scene_;
  double q1_;
  AreaG area_g_;
  ValidityRange validity_;
  ModelError model_error_;
  double velocity_ = 0;  // of the point before
  Solver solver_;
  bool partial_ = has_own_rule(scene_.model.correction);
};

Point PointSolver::operator()(double pressure, double velocity, const Shift& shift) {
  Point at;
  // the error of I1 and I2: rounding of closed forms, or the tolerance of a table's pieces, over all their passes
  const bool tabulated = std::holds_alternative<MasterCurve>(scene_.rubber);
  const double angular_error = tabulated ? 3e-13 : 1e-15;
  const double others = 2 * shift.relative_error + angular_error,
               of_g_in_mu = sensitivity(s_in_integrand(scene_.model.correction).has_value() || partial_);
  solver_.solve(pressure, velocity, shift.p, (1 + of_g_in_mu) * others);
  const Solver::Hysteresis& hysteresis = solver_.hysteresis();
  at.hysteresis = hysteresis.value;
  at.lateral = hysteresis.lateral;
  // both are integrals with errors of their own, which may carry a share of all above one
  if (hysteresis.value > 0) at.extrapolated_share = std::min(1.0, hysteresis.outside / hysteresis.value);

  const double g = solver_.g(q1_);
  at.contact_area = partial_ ? solver_.partial_area() : contact_share(area_g_(g), scene_.model.form);
  at.validity = validity_(g, shift.p);
  if (velocity != velocity_) model_error_.start(velocity_ = velocity);
  at.model_error = model_error_(g);
  if (partial_ && !std::isnan(at.model_error)) at.validity.regime = model_error_.regime();
  at.validity.strained = solver_.share_of_held_strains();
  if (scene_.adhesion) {
    at.adhesion = at.contact_area * adhesion_per_share(*scene_.adhesion, pressure, velocity);
    if (!std::isfinite(at.adhesion))
      throw InvalidInput(argument("shear_stress") + " = " + value(scene_.adhesion->shear_stress) + ": overflows over " +
                         argument("pressure") + " = " + value(pressure) + ", their ratio must be finite");
  }
  const double mu = at.hysteresis + at.adhesion;

  const double of_g = solver_.relative_error();
  const double g_error = (solver_.g_error_is_in_hysteresis() ? 0 : of_g) + others;
  const double area_error =
      partial_ ? solver_.partial_area_error() + angular_error : sensitivity(false) * (of_g + others);
  const double with_g = hysteresis.error + at.hysteresis * (of_g_in_mu * g_error + others);
  at.error_estimate = std::fmax(with_g, hysteresis.least_error) + at.adhesion * area_error;
  if (!(at.error_estimate <= scene_.model.rtol * mu && std::isfinite(mu)))
    throw NotConverged(argument("mu") + " = " + value(mu) + " with error " + show(at.error_estimate) + " where " +
                       argument("rtol") + " = " + show(scene_.model.rtol) + " was asked for");
  return at;
}

void PointSolver::add_contributions(Contributions& c, std::size_t i, double velocity) const {
  const std::size_t n = c.wavenumber.size();
  for (std::size_t j = 0; j < n; ++j) c.dmu_dlnq[i * n + j] = solver_.hysteresis_density(c.wavenumber[j]);
  if (const double whole = solver_.hysteresis().value; whole > 0) add_decades(c, i, velocity, whole, solver_.shares());
}

/// Points of one rubber: `order` are their indices, those of one velocity side by side.
struct RubberPoints {
  const Rubber& rubber;
  std::vector<std::size_t> order;
};

/// Tables of zeros over wavenumbers that resolve the narrowest front of all points.
Contributions empty_contributions(const Spectrum& spectrum, std::span<const Segment> surface, const ContactModel& model,
                                  std::span<const RubberPoints> groups, std::span<const double> pressure,
                                  std::span<const double> velocity) {
  const auto [q0, q1] = band(spectrum);
  const auto [slowest, fastest] = std::ranges::minmax(velocity);
  double front = 1;
  for (const RubberPoints& group : groups) {
    const Excitation waves(group.rubber, model, surface);
    for (const std::size_t i : group.order) {
      heed();
      front = std::fmin(front, front_width(surface, waves, {model.poisson_ratio, pressure[i], velocity[i], 1}));
    }
  }
  double end = q1;
  std::vector<double> wavenumber = contribution_wavenumbers(q0, q1, front);
  if (has_own_rule(model.correction)) {
    // the density jumps where the edges begin, and at q1
    const double edges = RoughnessWindow(surface).end(), last = edges * partial_contact::tail_end;
    for (const double q : {std::nextafter(edges, q0), edges}) {
      const auto above = std::ranges::lower_bound(wavenumber, q);
      if (above != wavenumber.end() && *above != q) wavenumber.insert(above, q);
    }
    if (last > q1) {
      end = last;
      for (const double q : contribution_wavenumbers(std::nextafter(q1, end), end, 1)) wavenumber.push_back(q);
    }
  }
  Contributions c{std::move(wavenumber), {}, decades(slowest * q0, fastest * end), {}};
  c.dmu_dlnq.assign(velocity.size() * c.wavenumber.size(), 0.0);
  c.decade_share.assign(velocity.size() * (c.decade_edges.size() - 1), 0.0);
  return c;
}

/// The points of `order`, each at its place in the columns of f; notes of them go to `notes`.
void solve_points(const Scene& scene, PointSolver& solve, std::span<const std::size_t> order, Friction& f,
                  Notes& notes) {
  for (const std::size_t i : order) {
    heed();
    const double p = f.pressure[i], v = f.velocity[i];
    const Shift shift =
        affine_shift(scene.model.correction, scene.spectrum, scene.rubber, p, v, scene.model.poisson_ratio);
    Point at;
    if (shift.state != ContactState::no_contact) {
      at_point(p, v, [&] { at = solve(p, v, shift); });
      if (f.contributions) solve.add_contributions(*f.contributions, i, v);
    }
    notes.add(shift, v, at.validity);
    // all at once, as in a grid each of them waits for memory
    f.mu[i] = at.hysteresis + at.adhesion;
    f.hysteresis[i] = at.hysteresis;
    f.adhesion[i] = at.adhesion;
    f.contact_area[i] = at.contact_area;
    f.shift_factor[i] = shift.p;
    f.error_estimate[i] = at.error_estimate;
    f.extrapolated_share[i] = at.extrapolated_share;
    f.model_error[i] = at.model_error;
    f.lateral[i] = at.lateral;
  }
}

/// Columns with room for every point.
Friction columns_for(std::span<const double> pressure, std::span<const double> velocity) {
  Friction f;
  f.pressure.assign(pressure.begin(), pressure.end());
  f.velocity.assign(velocity.begin(), velocity.end());
  for (auto* column : {&f.mu, &f.hysteresis, &f.adhesion, &f.contact_area, &f.shift_factor, &f.error_estimate,
                       &f.extrapolated_share, &f.model_error, &f.lateral}) {
    heed();  // a gigabyte each where there are many points
    column->assign(velocity.size(), 0.0);
  }
  return f;
}

/// The points of all groups, whose arguments have been checked. `correction` is the one that notes are of.
Friction solve_groups(const Spectrum& spectrum, const ContactModel& model, const Correction& correction,
                      const std::optional<Adhesion>& adhesion, std::span<const RubberPoints> groups,
                      std::span<const double> pressure, std::span<const double> velocity, bool contributions,
                      unsigned threads, bool heated = false) {
  const SurfaceSegments kept(spectrum);
  Friction f = columns_for(pressure, velocity);
  if (contributions) f.contributions = empty_contributions(spectrum, kept.get(), model, groups, pressure, velocity);
  const std::span<const double> stops =
      f.contributions ? std::span<const double>(f.contributions->decade_edges) : std::span<const double>();
  std::vector<Notes> notes;
  for (const auto& [rubber, order] : groups) {
    const Scene scene{spectrum, rubber, model, adhesion, kept.get(), stops};
    const std::size_t n = order.size(), first = notes.size();
    const unsigned workers = workers_for(n, threads);
    notes.resize(first + workers, Notes(spectrum, rubber, correction));
    std::vector<std::optional<PointSolver>> solvers(workers);
    in_blocks(workers, n, workers == 1 ? n : points_a_block, [&](unsigned worker, std::size_t begin, std::size_t end) {
      if (!solvers[worker]) solvers[worker].emplace(scene);
      solve_points(scene, *solvers[worker], std::span(order).subspan(begin, end - begin), f, notes[first + worker]);
    });
  }
  for (const Notes& others : std::span(notes).subspan(1)) notes.front().add(others);
  f.notes = notes.front().texts(heated);
  if (model.strain_factors)
    if (auto held = note_on_strain(*model.strain_factors, rms_slope(spectrum), notes.front().strained()))
      f.notes.push_back(*std::move(held));
  if (auto angle = note_on_angle(model.direction)) f.notes.push_back(std::move(*angle));
  if (heated) return f;  // notes on what is computed then are not of this
  note_extrapolated_modulus(f);
  note_large_friction(f);
  return f;
}

}  // namespace

void check_points(const ContactModel& model, const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                  std::span<const double> velocity, unsigned threads) {
  check_contact(model, pressure, velocity);
  if (adhesion) validate(*adhesion);
  if (threads == 0) throw InvalidInput(argument("threads") + " = " + word("0") + must_be() + "1 or more");
}

void add_decades(Contributions& c, std::size_t i, double velocity, double whole, std::span<const PanelSum> shares) {
  const std::size_t m = c.decade_edges.size() - 1;
  for (const auto& [lower, upper, hysteresis] : shares) {
    const double w = velocity * std::sqrt(lower * upper);
    const auto above = std::ranges::upper_bound(c.decade_edges, w) - c.decade_edges.begin();
    const auto decade = std::clamp<std::size_t>(static_cast<std::size_t>(above), 1, m) - 1;
    c.decade_share[i * m + decade] += hysteresis / whole;
  }
}

double adhesion_per_share(const Adhesion& a, double pressure, double velocity) {
  const double decades = std::log10(velocity / a.reference_velocity);
  return a.shear_stress / pressure * std::exp(-a.width * decades * decades);
}

void validate(const Adhesion& adhesion) {
  require_not_negative("shear_stress", adhesion.shear_stress);
  require_positive("reference_velocity", adhesion.reference_velocity);
  require_not_negative("width", adhesion.width);
}

Friction friction(const Spectrum& spectrum, const Rubber& rubber, const Conditions& conditions,
                  std::span<const double> velocity) {
  const std::vector<double> pressure(velocity.size(), conditions.pressure);
  const ContactModel model{conditions.poisson_ratio, conditions.correction,     conditions.form,     conditions.rtol,
                           conditions.method,        conditions.strain_factors, conditions.direction};
  return friction(spectrum, rubber, model, conditions.adhesion, pressure, velocity, conditions.contributions);
}

Friction friction(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                  const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                  std::span<const double> velocity, bool contributions, unsigned threads) {
  check_points(model, adhesion, pressure, velocity, threads);
  check_frequencies(spectrum, rubber, velocity);
  const RubberPoints all{rubber, by_velocity(velocity)};
  const AsSolved as_solved(spectrum, model);
  ScanFriction scan(as_solved.get(), rubber, model);
  Friction f = solve_groups(scan.spectrum(), scan.model(), model.correction, adhesion, {&all, 1}, pressure, velocity,
                            contributions, threads);
  scan.apply(f, {}, threads);
  return f;
}

Friction friction(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                  const ContactModel& model, const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                  std::span<const double> velocity, std::span<const double> temperature, bool contributions,
                  unsigned threads) {
  return friction_before_heating(spectrum, rubber, shift, model, adhesion, pressure, velocity, temperature,
                                 contributions, threads, false);
}

Friction friction_before_heating(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                                 const ContactModel& model, const std::optional<Adhesion>& adhesion,
                                 std::span<const double> pressure, std::span<const double> velocity,
                                 std::span<const double> temperature, bool contributions, unsigned threads,
                                 bool heated) {
  check_points(model, adhesion, pressure, velocity, threads);
  require_same_size("temperature", temperature.size(), "velocity", velocity.size());
  std::map<double, std::vector<std::size_t>> points;  // by temperature
  for (const std::size_t i : by_velocity(velocity)) points[temperature[i]].push_back(i);
  std::deque<Rubber> rubbers;
  std::vector<RubberPoints> groups;
  for (auto& [at, order] : points) {
    heed();
    rubbers.push_back(shifted(rubber, shift, at));
    const std::array ends{velocity[order.front()], velocity[order.back()]};
    at_temperature(at, [&] { check_frequencies(spectrum, rubbers.back(), ends); });
    groups.push_back({rubbers.back(), std::move(order)});
  }
  const AsSolved as_solved(spectrum, model);
  ScanFriction scan(as_solved.get(), rubber, model);
  Friction f = solve_groups(scan.spectrum(), scan.model(), model.correction, adhesion, groups, pressure, velocity,
                            contributions, threads, heated);
  std::vector<double> a_T;
  for (const double one : temperature) a_T.push_back(std::pow(10, shift_at(shift, one).log10_a_T));
  scan.apply(f, a_T, threads);
  f.temperature.assign(temperature.begin(), temperature.end());
  return f;
}

}  // namespace asperity
