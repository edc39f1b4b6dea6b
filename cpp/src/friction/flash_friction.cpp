// Friction of a rubber that the friction heats: mu_H of Eq. 22 and mu_A of Eq. 23 with the modulus at the temperature
// that roughness of each wavenumber feels, beside the same without heat. B. N. J. Persson, J. Phys.: Condens. Matter
// 18, 7789 (2006).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "asperity/friction.hpp"
#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "friction/before_heating.hpp"
#include "friction/scan_friction.hpp"
#include "heat/flash_map.hpp"
#include "heat/flash_solver.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// What there is to say of the points, a bit each.
struct HeatNotes {
  bool hot = false, wide = false, several = false, crowded = false;
  void add(const HeatNotes& other) {
    hot |= other.hot;
    wide |= other.wide;
    several |= other.several;
    crowded |= other.crowded;
  }
};

constexpr double published_rise = 100;  // [K]
constexpr double least_peclet = 10, telling_rise = 1;
constexpr double crowded_area = 0.3;

std::vector<Diagnostic> texts(const HeatNotes& notes, const Heating& heating, const Spectrum& spectrum) {
  std::vector<Diagnostic> result;
  if (notes.hot)
    result.push_back(warning("hot-rubber",
                             "the rubber heats itself by more than " + value(published_rise) +
                                 " K at some points, beyond what the model was compared with experiments on",
                             {"hold these points against a measurement"}));
  if (notes.wide)
    result.push_back(note("heat-flows-sideways", "heat flows to the sides too at some points, where v R / D is below " +
                                                     value(least_peclet) +
                                                     ": the rise there is up to 5 % too high, at v R / D = 1 by half"));
  if (notes.several)
    result.push_back(warning(
        "several-states",
        "the heat has more than one steady state at some points, " + advice("see-branches", "see branches") +
            ": the one that sliding from rest reaches is given, unless branch=\"hot\" asked for the other end"));
  const auto [q0, q1] = band(spectrum);
  const double q = 2 * std::numbers::pi / heating.contact_diameter;
  if (!heating.macro_wavenumber && !heating.macro_area && (q < q0 || q > q1))
    result.push_back(
        warning("macro-wavenumber-held", "the macro-asperities' wavenumber, 2 pi / " + argument("contact_diameter") +
                                             " = " + value(q, 4, "1/m") + " 1/m, is held to the spectrum's end: " +
                                             advice("give-macro-wavenumber", "give macro_wavenumber or macro_area")));
  if (notes.crowded)
    result.push_back(note("crowded-contacts",
                          "the macro-asperity contacts cover more than " + value(crowded_area) +
                              " of the surface at some points: they touch, and the heat of one reaches the next"));
  return result;
}

HeatNotes notes_of(double rise, double velocity, int branches, double macro_area, const Heating& heating) {
  const double diffusivity = heating.conductivity / (heating.density * heating.heat_capacity);
  const bool slow = velocity * heating.contact_diameter / 2 / diffusivity < least_peclet;
  return {rise > published_rise, rise > telling_rise && slow, branches > 1, macro_area > crowded_area};
}

void add_contributions(const FlashSolver& solver, FlashFriction& f, std::size_t i) {
  Contributions& c = *f.hot.contributions;
  const std::size_t n = c.wavenumber.size();
  for (std::size_t j = 0; j < n; ++j) {
    c.dmu_dlnq[i * n + j] = solver.hysteresis_density(c.wavenumber[j]);
    f.temperature_profile[i * n + j] = solver.temperature_at(c.wavenumber[j]);
  }
  if (const double whole = f.hot.hysteresis[i]; whole > 0) add_decades(c, i, f.hot.velocity[i], whole, solver.shares());
}

/// The contact of the scan with each wave at its temperature T(q), which is the theory's.
void take_scan(ScanFriction& scan, const FlashSolver& solver, const TemperatureShift& shift, double pressure,
               double velocity, HotPoint& at) {
  const auto [q0, q1] = band(scan.spectrum());
  constexpr std::size_t steps = 96;
  HotRule rule{at.hysteresis, at.contact_area, q0, q1, {}};
  for (std::size_t i = 0; i <= steps; ++i) {
    const double q = i == steps ? q1 : q0 * std::pow(q1 / q0, static_cast<double>(i) / steps);
    rule.a_T.push_back(std::pow(10, shift_at(shift, solver.temperature_at(q)).log10_a_T));
  }
  const ScanRatio ratio = scan.hot(pressure, velocity, rule);
  at.error_estimate *= ratio.error_factor(at.adhesion);
  at.hysteresis *= ratio.hysteresis;
  at.lateral = ratio.across * at.hysteresis;
  at.adhesion *= ratio.area;
  at.contact_area *= ratio.area;
}

/// Columns for the hot points, cleared.
FlashFriction cleared(Friction cold, std::size_t n) {
  FlashFriction f;
  f.hot = cold;
  f.cold = std::move(cold);
  f.macro_area.assign(n, 0.0);
  f.gain.assign(n, 0.0);
  f.branches.assign(n, 1);
  f.hot.model_error.assign(n, std::numeric_limits<double>::quiet_NaN());  // exact contacts were cold
  if (f.hot.contributions) {
    Contributions& c = *f.hot.contributions;
    std::ranges::fill(c.dmu_dlnq, 0.0);
    std::ranges::fill(c.decade_share, 0.0);
    f.temperature_profile.assign(c.dmu_dlnq.size(), 0.0);
  }
  return f;
}

}  // namespace

void check_heating(const Heating& heating, const TemperatureShift& shift, const std::optional<Adhesion>& adhesion) {
  validate(heating);
  if (const auto* const law = std::get_if<WLF>(&shift)) validate(*law);
  if (heating.interface_share != 1 && !adhesion)
    refuse("interface_share", heating.interface_share, "1, its default, where there is no adhesion");
}

std::vector<std::size_t> by_curve(std::span<const double> pressure, std::span<const double> velocity,
                                  std::span<const double> temperature) {
  std::vector<std::size_t> order(velocity.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::tuple(temperature[i], pressure[i], velocity[i]); });
  return order;
}

bool begins(std::span<const std::size_t> order, std::size_t k, std::span<const double> pressure,
            std::span<const double> temperature) {
  return k == 0 || pressure[order[k - 1]] != pressure[order[k]] || temperature[order[k - 1]] != temperature[order[k]];
}

FlashFriction friction(const Spectrum& given, const Rubber& rubber, const TemperatureShift& shift,
                       const Heating& heating, const ContactModel& model, const std::optional<Adhesion>& adhesion,
                       std::span<const double> pressure, std::span<const double> velocity,
                       std::span<const double> temperature, Branch branch, bool contributions, unsigned threads) {
  check_heating(heating, shift, adhesion);
  check_gauss(model.method, "where heating is given, as GSL's methods have one temperature for all waves");
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  const double q_m = macro_wavenumber(heating, spectrum);
  const std::size_t n = velocity.size();
  FlashFriction f = cleared(friction_before_heating(spectrum, rubber, shift, model, adhesion, pressure, velocity,
                                                    temperature, contributions, threads, true),
                            n);
  ScanFriction scan(spectrum, rubber, model);
  const SurfaceSegments kept(scan.spectrum());
  const HeatScene scene{scan.spectrum(), kept.get(), rubber, shift, heating, scan.model(), q_m};
  f.parts_error.assign(n, 0.0);
  const std::vector<std::size_t> order = by_curve(pressure, velocity, temperature);
  const unsigned workers = workers_for(n, threads);
  std::vector<HeatNotes> notes(workers);
  std::vector<std::optional<FlashSolver>> solvers(workers);
  // a block begins without a guess: the numbers do not depend on the threads
  in_blocks(workers, n, points_a_block, [&](unsigned worker, std::size_t begin, std::size_t end) {
    if (!solvers[worker]) solvers[worker].emplace(scene, branch);
    FlashSolver& solve = *solvers[worker];
    for (std::size_t k = begin; k < end; ++k) {
      heed();
      const std::size_t i = order[k];
      const double p = pressure[i], v = velocity[i], t = temperature[i];
      if (k == begin || begins(order, k, pressure, temperature)) solve.forget();
      if (f.hot.contributions) {
        std::vector<double> stops = f.hot.contributions->decade_edges;
        for (double& stop : stops) stop /= v;
        solve.set_stops(std::move(stops));
      }
      const double per_area = adhesion ? adhesion_per_share(*adhesion, p, v) : 0;
      HotPoint at;
      at_point(p, v, t, [&] {
        at = solve({p, v, t, per_area});
        if (scan.of_scan()) take_scan(scan, solve, shift, p, v, at);
      });
      if (scan.of_scan()) f.hot.model_error[i] = f.cold.model_error[i];
      f.hot.mu[i] = at.hysteresis + at.adhesion;
      f.hot.hysteresis[i] = at.hysteresis;
      f.hot.lateral[i] = at.lateral;
      f.hot.adhesion[i] = at.adhesion;
      f.hot.contact_area[i] = at.contact_area;
      f.hot.shift_factor[i] = at.shift.p;
      f.hot.error_estimate[i] = at.error_estimate;
      f.parts_error[i] = at.parts_error;
      f.hot.extrapolated_share[i] = at.extrapolated_share;
      f.hot.temperature[i] = at.temperature;
      f.macro_area[i] = at.macro_area;
      f.gain[i] = at.gain;
      f.branches[i] = at.branches;
      if (f.hot.contributions) add_contributions(solve, f, i);
      notes[worker].add(notes_of(at.temperature - t, v, at.branches, at.macro_area, heating));
    }
  });
  for (const HeatNotes& others : std::span(notes).subspan(1)) notes.front().add(others);
  std::ranges::move(texts(notes.front(), heating, spectrum), std::back_inserter(f.hot.notes));
  note_extrapolated_modulus(f.hot);
  note_large_friction(f.hot);
  return f;
}

std::vector<double> sliding_length(const Spectrum& given, const Rubber& rubber, const TemperatureShift& shift,
                                   const Heating& heating, const ContactModel& model,
                                   const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                                   std::span<const double> velocity, std::span<const double> temperature) {
  check_contact(model, pressure, velocity);
  require_same_size("temperature", temperature.size(), "velocity", velocity.size());
  if (adhesion) validate(*adhesion);
  check_heating(heating, shift, adhesion);
  check_gauss(model.method, "for sliding_length, as GSL's methods know nothing of the history of the heat");
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  const SurfaceSegments kept(spectrum);
  const HeatScene scene{spectrum, kept.get(), rubber, shift, heating, model, macro_wavenumber(heating, spectrum)};
  std::vector<double> result;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double p = pressure[i], v = velocity[i], t = temperature[i];
    at_point(p, v, t, [&] {
      result.push_back(sliding_length(scene, {p, v, t, adhesion ? adhesion_per_share(*adhesion, p, v) : 0}));
    });
  }
  return result;
}

}  // namespace asperity
