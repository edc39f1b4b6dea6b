// Steady sliding contact and its friction. A rigid periodic map h slides at v along x on a viscoelastic half-space: in
// the frame of the map u_q = K_q p_q, K_q = 2 (1 - nu^2) / (|q| conj E(v q_x)), and the contact is p >= 0, gap = u - h
// - delta >= 0, p gap = 0, <p> = sigma0. The rubber dissipates mu_H = sum q_x Im K_q |p_q|^2 / sigma0, as much as the
// slopes work, -<p dh/dx> / sigma0. B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001), for the modes.
#include "sliding/slide_period.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "asperity/sliding.hpp"
#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

constexpr std::size_t coarsest = 64;  // points along the shorter side that no coarser grid goes below
constexpr double coarse_tolerance = 1e-3;
// Points touch in whole pixels; this over the number of their free sides is what they have too much: V. A. Yastrebov,
// G. Anciaux and J.-F. Molinari, Tribology International 114, 161 (2017).
constexpr double excess = (pi - 1 + std::numbers::ln2) / 24;

/// The nearest points of a coarser or finer grid.
Eigen::ArrayXd resampled(const double* from, Grid shape, Grid wanted) {
  Eigen::ArrayXd result(static_cast<Eigen::Index>(wanted[0] * wanted[1]));
  double* to = result.data();
  for (std::size_t y = 0; y < wanted[0]; ++y)
    for (std::size_t x = 0; x < wanted[1]; ++x)
      *to++ = from[y * shape[0] / wanted[0] * shape[1] + x * shape[1] / wanted[1]];
  return result;
}

/// Everything that does not depend on the grid, [m] and [Pa].
struct Sliding {
  const Period& period;
  double length_y, length_x;
  const WaveModulus& modulus;
  const Way& way;
};

Compliance compliance_on(const Sliding& s, Grid grid) {
  return compliance(s.modulus, s.way.velocity, s.way.direction, {grid, s.length_y, s.length_x});
}

/// The problem on a grid, and the unit of its pressures [Pa].
std::pair<ContactProblem, double> problem_on(const Sliding& s, Grid grid, const Compliance& c) {
  const double dx = s.length_x / static_cast<double>(grid[1]), dy = s.length_y / static_cast<double>(grid[0]);
  double softest = 0;
  for (const std::complex<double>& one : c.modes) softest = std::max(softest, std::abs(one));
  const double nu = s.way.poisson_ratio;
  const double unit = s.period.rms_height / (2 * (1 - nu * nu) * dx * softest);
  ContactProblem problem{grid, dx / dy, {}, c.modes, s.way.pressure / unit};
  for (std::complex<double>& one : problem.modes) one /= softest;
  problem.heights = resampled(s.period.heights.data(), s.period.shape, grid) / s.period.rms_height;
  return {std::move(problem), unit};
}

double area(const std::vector<double>& pressure, Grid shape, double& raw) {
  const auto [ny, nx] = shape;
  std::size_t touching = 0, sides = 0;
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x) {
      const bool here = pressure[y * nx + x] > 0;
      touching += here ? 1 : 0;
      sides += here != (pressure[y * nx + (x + 1) % nx] > 0) ? 1 : 0;
      sides += here != (pressure[(y + 1) % ny * nx + x] > 0) ? 1 : 0;
    }
  const double points = static_cast<double>(pressure.size());
  raw = static_cast<double>(touching) / points;
  return raw - excess * static_cast<double>(sides) / points;
}

/// Friction by dissipation and by the work of the slopes, along the way and across it.
void add_friction(const Sliding& s, const Compliance& c, SlidingContact& contact) {
  const auto [ny, nx] = contact.shape;
  const std::size_t half = nx / 2 + 1;
  const double points = static_cast<double>(ny * nx), nu = s.way.poisson_ratio;
  const double cosine = std::cos(s.way.direction), sine = s.way.direction == 0 ? 0 : std::sin(s.way.direction);
  const auto p = forward_transform(contact.pressure, contact.shape);
  const auto h = forward_transform(s.period.heights, contact.shape);
  double dissipated = 0, along = 0, across = 0;
  for (std::size_t y = 0; y < ny; ++y) {
    const double qy = 2 * pi / s.length_y * (2 * y < ny ? static_cast<double>(y) : -static_cast<double>(ny - y));
    for (std::size_t x = 0; x < half; ++x) {
      if (x + y == 0) continue;
      const std::size_t i = y * half + x;
      const std::complex<double> mode = p[i] / points;
      const double qx = 2 * pi / s.length_x * static_cast<double>(x);
      const double images = x == 0 || 2 * x == nx ? 1 : 2;
      dissipated += images * c.loss[i] / std::hypot(qx, qy) * std::norm(mode);
      // shortest waves have no slope at their points
      const double slope_x = 2 * x == nx ? 0 : qx, slope_y = 2 * y == ny ? 0 : qy;
      const double work = images * (std::conj(mode) * h[i]).imag() / points;
      along += (slope_x * cosine + slope_y * sine) * work;
      across += (slope_y * cosine - slope_x * sine) * work;
    }
  }
  contact.hysteresis = 2 * (1 - nu * nu) * dissipated / s.way.pressure;
  contact.work_of_slopes = along / s.way.pressure;
  contact.lateral = across / s.way.pressure;
}

SlidingContact figures(const Sliding& s, const Compliance& c, ContactSolution solution, double unit) {
  SlidingContact contact{};
  contact.shape = s.period.shape;
  contact.pixel_size = {s.length_y / static_cast<double>(contact.shape[0]),
                        s.length_x / static_cast<double>(contact.shape[1])};
  contact.error = solution.error;
  solution.pressure *= unit;
  solution.gap *= s.period.rms_height;
  contact.pressure.assign(solution.pressure.begin(), solution.pressure.end());
  contact.gap.assign(solution.gap.begin(), solution.gap.end());
  contact.contact_area = area(contact.pressure, contact.shape, contact.contact_area_raw);
  // u is h + gap + delta of mean 0
  const auto heights = Eigen::ArrayXd::Map(s.period.heights.data(), solution.pressure.size());
  contact.elastic_energy = ((solution.pressure * heights).mean() - s.way.pressure * solution.gap.mean()) / 2;
  add_friction(s, c, contact);
  return contact;
}

}  // namespace

PeriodContact slide_period(const Period& period, HeightMap::PixelSize pixel_size, const WaveModulus& modulus,
                           const Way& way, double rtol, const Course& course) {
  const auto [dy, dx] = pixel_size;
  const Sliding s{period, dy * static_cast<double>(period.shape[0]), dx * static_cast<double>(period.shape[1]), modulus,
                  way};
  const Compliance c = compliance_on(s, period.shape);
  const auto [problem, unit] = problem_on(s, period.shape, c);

  ContactSolution solution{{}, Eigen::ArrayXd::Zero(problem.heights.size()), 0, 0, true};
  if (auto pressure = complete_contact(problem)) {
    solution.pressure = *std::move(pressure);
  } else {
    std::vector<Grid> grids{period.shape};
    while (std::min(grids.back()[0], grids.back()[1]) >= 2 * coarsest)
      grids.push_back({(grids.back()[0] + 1) / 2, (grids.back()[1] + 1) / 2});
    Eigen::ArrayXd start;
    for (std::size_t level = grids.size(); level-- > 1;) {
      const auto [coarse, _] = problem_on(s, grids[level], compliance_on(s, grids[level]));
      const ContactSolution found = solve_contact(coarse, std::move(start), std::max(rtol, coarse_tolerance), course);
      start = resampled(found.pressure.data(), grids[level], grids[level - 1]);
    }
    solution = solve_contact(problem, std::move(start), rtol, course);
  }
  const bool converged = solution.converged;
  const int steps = solution.steps;
  return {figures(s, c, std::move(solution), unit), converged, steps};
}

// A map that slides on rubber: what is asked of it, what of the modulus, and what there is to say of the result.

namespace {

void validate(const SlidingModel& model, double pressure, double velocity) {
  require_positive("pressure", pressure);
  require_not_negative("velocity", velocity);
  require_poisson("poisson_ratio", model.poisson_ratio);
  require_rtol(model.rtol);
  require_finite("direction", model.direction);
  if (!(model.time_limit > 0)) refuse("time_limit", model.time_limit, "positive (infinite for none)");
}

/// The modulus must be known at the waves along the way, from the longest to that of two pixels.
void check_range(const Rubber& rubber, double velocity, const Period& period, HeightMap::PixelSize pixel_size,
                 double direction) {
  const auto known = known_range(rubber);
  if (!known) return;
  const double cosine = std::fabs(std::cos(direction)), sine = direction == 0 ? 0 : std::fabs(std::sin(direction));
  const auto [dy, dx] = pixel_size;
  const double first = 2 * pi *
                       std::min(cosine > 0 ? 1 / (dx * static_cast<double>(period.shape[1])) : 1e300,
                                sine > 0 ? 1 / (dy * static_cast<double>(period.shape[0])) : 1e300);
  const double last = pi * (cosine / dx + sine / dy);
  const double slowest = known->lowest / first, fastest = known->highest / last;
  if (velocity >= slowest && velocity <= fastest) return;
  throw OutOfRange(argument("velocity") + " = " + value(velocity, 6) + " m/s: the waves of this map have q_x from " +
                   show(first, 4) + " to " + show(last, 4) + " 1/m, and the modulus is known from " +
                   show(known->lowest, 4) + " to " + show(known->highest, 4) + " rad/s; " +
                   (slowest <= fastest
                        ? "velocities from " + show(slowest, 4) + " to " + show(fastest, 4) + " m/s are allowed"
                        : "no velocity has all of them in this range"));
}

std::string description(Continuation continuation) {
  if (continuation == Continuation::mirror)
    return "the map was continued by its mirror images: it slides over its slopes in both directions";
  if (continuation == Continuation::blend)
    return "the map was made periodic by blending about two of its shortest waves at its end into its beginning";
  return "the map was made periodic by fading its last eighth along either axis into its beginning";
}

}  // namespace

SlidingContact slide(const HeightMap& map, const Rubber& rubber, double pressure, double velocity,
                     const SlidingModel& model) {
  validate(model, pressure, velocity);
  const auto begin = std::chrono::steady_clock::now();
  Course course{.progress = model.progress};
  if (model.time_limit < 1e9)
    course.deadline = begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                  std::chrono::duration<double>(model.time_limit));
  const Period period = one_period(map, model.continuation);
  check_range(rubber, velocity, period, map.pixel_size(), model.direction);
  auto [contact, converged, steps] =
      slide_period(period, map.pixel_size(), continued_modulus(rubber),
                   {model.poisson_ratio, pressure, velocity, model.direction}, model.rtol, course);
  if (!converged)
    throw NotConverged("the contact at " + show(pressure, 6) + " Pa and " + show(velocity, 6) +
                       " m/s reached an error of " + show(contact.error, 2) + " in " + std::to_string(steps) +
                       " steps: must be " + show(model.rtol, 2) + "; its contact area was " +
                       show(contact.contact_area, 4) + " and its hysteresis " + show(contact.hysteresis, 4) +
                       (std::chrono::steady_clock::now() > course.deadline ? " at the end of time_limit" : ""));
  if (model.continuation != Continuation::periodic)
    contact.notes.push_back(note("map-continued", {description(model.continuation)}));
  if (auto angle = note_on_angle(model.direction)) contact.notes.push_back(*std::move(angle));
  return std::move(contact);
}

}  // namespace asperity
