// Chooses the solver of a point: levels of nodes (level_solver.hpp), panels (panel_solver.hpp), or GSL's adaptive rules
// (gsl_solver.hpp) as the independent check. All solve Eqs 7 and 22. B. N. J. Persson, J. Chem. Phys. 115, 3840
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
      options_(options),
      panel_solver_(surface, waves_, model.poisson_ratio, model.rtol) {
  check_scales(surface);
  if (model.method != Method::gauss) return;
  const bool panels = options.levels || has_own_rule(model.correction) || waves_.directions() != nullptr;
  if (panels || !options.parts)
    levels_.emplace(spectrum, surface, waves_, model,
                    LevelSolver::Options{.parts = options.parts, .stops = options.stops, .panels = panels});
  if (!panels && options.hysteresis) contact_.emplace(model.form, factor_);
}

void Solver::start(double velocity) {
  velocity_ = velocity;
  stop_wavenumbers_.clear();
  for (const double w : options_.stops) stop_wavenumbers_.push_back(w / velocity);
  if (model_.method == Method::gauss)
    stop_wavenumbers_.insert(stop_wavenumbers_.end(), waves_.kinks().begin(), waves_.kinks().end());
}

void Solver::solve(double pressure, double velocity, double shift) {
  by_levels_ = levels_ && levels_->solve(pressure, velocity, shift);
  if (by_levels_) return;
  if (velocity != velocity_) start(velocity);
  if (model_.method == Method::gauss) {
    if (panel_velocity_ != velocity) panel_solver_.start(velocity, stop_wavenumbers_);
    panel_velocity_ = velocity;
    panel_solver_.solve(pressure, shift, contact_ ? &*contact_ : nullptr);
    return;
  }
  gsl_solver_.emplace(surface_, waves_, GslSolver::Point{model_.poisson_ratio, pressure, velocity, shift},
                      stop_wavenumbers_, options_.hysteresis, model_.rtol, adaptive_rule(model_.method));
  if (const double g = gsl_solver_->g(surface_.back().b); g != 0) check_g(g, pressure);
  if (!options_.hysteresis) return;
  const GslSolver::Hysteresis found = gsl_solver_->hysteresis(model_.form, factor_);
  hysteresis_ = {found.value, found.error, found.outside};
  by_panel_ = found.by_panel;
}

double Solver::g(double wavenumber) const {
  return by_levels_ ? levels_->g(wavenumber) : gsl_solver_ ? gsl_solver_->g(wavenumber) : panel_solver_.g(wavenumber);
}

double Solver::relative_error() const {
  return by_levels_    ? levels_->relative_error()
         : gsl_solver_ ? gsl_solver_->relative_error()
                       : panel_solver_.relative_error();
}

double Solver::hysteresis_density(double wavenumber) const {
  if (by_levels_) return levels_->hysteresis_density(wavenumber);
  if (gsl_solver_) return gsl_solver_->hysteresis_density(wavenumber, model_.form, factor_);
  const double full = panel_solver_.full_density(wavenumber);
  if (full == 0) return 0;
  const double share = contact_share(panel_solver_.g(wavenumber), model_.form);
  return full * share * (factor_ ? (*factor_)(share) : 1);
}

std::vector<ContactGrid::PanelSum> Solver::shares() const {
  if (by_levels_) return levels_->shares();
  if (!gsl_solver_) return panel_solver_.shares();
  std::vector<ContactGrid::PanelSum> result;
  const auto panels = gsl_solver_->panels();
  result.reserve(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) result.push_back({panels[i][0], panels[i][1], by_panel_[i]});
  return result;
}

double Solver::share_of_held_strains() const {
  const double whole = hysteresis().value;
  const double from = waves_.softening() ? waves_.softening()->held_from() : HUGE_VAL;
  if (from == HUGE_VAL || !(whole > 0)) return 0;
  if (by_levels_) return levels_->share_beyond(from);
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
