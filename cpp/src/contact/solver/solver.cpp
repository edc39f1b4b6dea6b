// Chooses the solver of a point: levels of nodes (level_solver.hpp), or GSL's adaptive rules (gsl_solver.hpp) as the
// independent check. Both solve Eqs 7 and 22. B. N. J. Persson, J. Chem. Phys. 115, 3840
// (2001).
#include "contact/solver/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

/// Rejects scales where q^4 C over- or underflows.
void check_scales(std::span<const Segment> surface) {
  for (const Segment& segment : surface)
    for (const auto& [q, c] : {std::pair{segment.a, segment.at_a}, std::pair{segment.b, segment.at_b}}) {
      const double fourth = (q * q) * (q * q);
      if (!is_representable(fourth) || (c != 0 && (!is_representable(c) || !is_representable(fourth * c))))
        throw InvalidInput(argument("spectrum") + ": density = " + value(c) + " m^4 at wavenumber = " + show(q) +
                           " 1/m" + must_be() + "such that C, q^4 and q^4 C are in [1e-280, 1e280]");
    }
}

}  // namespace

Adaptive adaptive_rule(Method method) {
  switch (method) {
    case Method::qags:
      return Adaptive::qags;
    case Method::cquad:
      return Adaptive::cquad;
    default:
      return Adaptive::qag;
  }
}

Solver::Solver(const Spectrum& spectrum, std::span<const Segment> surface, const Rubber& rubber,
               const ContactModel& model, const Options& options)
    : surface_(surface),
      model_(model),
      waves_(rubber, model, surface, harmonics_of(spectrum)),
      factor_(s_in_integrand(model.correction)),
      options_(options) {
  check_scales(surface);
  if (model.method == Method::gauss)
    levels_.emplace(
        spectrum, surface, waves_, model,
        LevelSolver::Options{.hysteresis = options.hysteresis, .parts = options.parts, .stops = options.stops});
}

void Solver::solve(double pressure, double velocity, double shift, double others) {
  if (levels_) {
    levels_->solve(pressure, velocity, shift, others);
    return;
  }
  std::vector<double> stops;
  for (const double w : options_.stops) stops.push_back(w / velocity);
  gsl_solver_.emplace(surface_, waves_, GslSolver::Point{model_.poisson_ratio, pressure, velocity, shift}, stops,
                      options_.hysteresis, model_.rtol, adaptive_rule(model_.method));
  if (const double g = gsl_solver_->g(surface_.back().b); g != 0) check_g(g, pressure);
  if (!options_.hysteresis) return;
  const GslSolver::Hysteresis result = gsl_solver_->hysteresis(model_.form, factor_);
  hysteresis_ = {result.value, result.error, 0, result.outside, 0};
  by_panel_ = result.by_panel;
}

double Solver::g(double wavenumber) const { return levels_ ? levels_->g(wavenumber) : gsl_solver_->g(wavenumber); }

double Solver::relative_error() const { return levels_ ? levels_->relative_error() : gsl_solver_->relative_error(); }

double Solver::hysteresis_density(double wavenumber) const {
  return levels_ ? levels_->hysteresis_density(wavenumber)
                 : gsl_solver_->hysteresis_density(wavenumber, model_.form, factor_);
}

std::vector<PanelSum> Solver::shares() const {
  if (levels_) return levels_->shares();
  std::vector<PanelSum> result;
  const auto panels = gsl_solver_->panels();
  result.reserve(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) result.push_back({panels[i][0], panels[i][1], by_panel_[i]});
  return result;
}

double Solver::share_of_held_strains() const {
  const double whole = hysteresis().value;
  const double from = waves_.softening() ? waves_.softening()->held_from() : HUGE_VAL;
  if (from == HUGE_VAL || !(whole > 0)) return 0;
  if (levels_) return levels_->share_beyond(from);
  double sum = 0;
  for (const auto& [lower, upper, part] : shares())
    if (std::sqrt(lower * upper) > from) sum += part;
  return std::fmin(1, sum / whole);
}

std::vector<std::size_t> by_velocity(std::span<const double> velocity) {
  std::vector<std::size_t> order(velocity.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t looks = 0;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    heed_at(looks++);
    return velocity[i];
  });
  return order;
}

}  // namespace asperity
