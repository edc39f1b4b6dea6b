// Area and hysteresis by the rule of PartialContact (contact/theory/partial_contact_rule.hpp):
//   A / A0 = A1,  mu_H = 4 (1 - nu^2) sigma0 (int (I1 / I2) R dG + int (I1 / I2) T d ln x),
// on panels that are halved until the sum of their stated errors is below the tolerance.
#include "contact/solver/partial_panel_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "contact/conditions.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/rule_error.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

/// |d ln R / d ln G| at most, with dG itself apart: of A 1/2, of (1 + Z)^-2 with Z ~ A^2 2.
constexpr double passed_on = 2;
constexpr double for_tail = 0.02;  // of the tolerance

/// What a rule in sqrt(G) misses of int R dG beside G = 0, where A leaves 1 / sqrt(pi G), and where R leaves A, at G of
/// about s = Z / A^2. It depends on G at the first node, whatever the number of nodes. Measured at n = 12 and 16, G
/// from 1e-6 to 1e12 and s from 0 to 1e8.
double foot_error(double g, double s) {
  const double z = std::sqrt(g), root = 1 / std::cbrt(z);
  const double exponent = std::min({0.45 / z, 0.92 * root * root, 3.1 * root});
  const double share_at_1 = 0.5204998778130465377;  // erf(1/2)
  const double beside_zero = 6 * std::exp(-exponent) * partial_contact::stress(share_at_1, s * share_at_1 * share_at_1);
  const double passed = std::fmin(1, 10 * g / std::fmax(s, 1e-300)), square = passed * passed;
  return beside_zero + (s > 1 ? 1.5 * std::sqrt(s) * square * square : 0);
}

/// What lies beyond the end q_e of the roughness, cut at those of the rising `stops` that lie there [1/m].
std::vector<std::array<double, 2>> tail_stretches(double q_e, std::span<const double> stops) {
  const double end = q_e * partial_contact::tail_end;
  std::vector<std::array<double, 2>> result;
  double from = q_e;
  for (const double q : stops) {
    if (!(q > from && q < end)) continue;
    result.push_back({from, q});
    from = q;
  }
  result.push_back({from, end});
  return result;
}

/// R at a place of a band.
double partial_stress(const ContactSums& root, double g, double steepness) {
  const double share = g > 0 ? std::erf(0.5 / std::sqrt(root.kappa * g)) : 1;
  return partial_contact::stress(share, root.obstacle * share * share * steepness);
}

/// d mu_H / dln q of the edges at unit load and window roughness 1; q_e is where the roughness ends.
double partial_edges(const ContactSums& root, const Excitation& waves, double velocity, double q_e, double q) {
  const double x = q / q_e;
  if (!(x >= 1 && x <= partial_contact::tail_end)) return 0;
  double w = velocity * q_e * x, end = velocity * q_e;
  if (const auto known = known_range(waves.rubber())) {
    w = std::fmin(w, known->highest);
    end = std::fmin(end, known->highest);
  }
  const AngularIntegrals here = waves(w, q);
  return root.edges * here.i1 * std::pow(here.i2 / waves(end, q_e).i2, partial_contact::tail_excess) *
         std::pow(x, -partial_contact::tail_power);
}

}  // namespace

PartialPanelSolver::PartialPanelSolver(std::span<const Segment> surface, const Excitation& waves,
                                       const ContactModel& model, std::span<const double> stops)
    : surface_(surface),
      waves_(waves),
      panels_(surface, waves, model.poisson_ratio, model.rtol),
      tail_(waves, for_tail * model.rtol),
      stiffening_(1 / (1 - model.poisson_ratio * model.poisson_ratio)),
      rtol_(model.rtol),
      stops_(stops) {}

void PartialPanelSolver::start(double velocity) {
  velocity_ = velocity;
  stop_wavenumbers_.clear();
  for (const double w : stops_) stop_wavenumbers_.push_back(w / velocity);
  std::vector<double> ends = stop_wavenumbers_;  // and at knots, behind which all is smooth up to the next
  if (const auto* const curve = std::get_if<MasterCurve>(&waves_.rubber()))
    for (const double w : curve->knots()) ends.push_back(w / velocity);
  ends.insert(ends.end(), waves_.kinks().begin(), waves_.kinks().end());
  panels_.start(velocity, ends);
  end_.window = panels_.end().window;
  end_.tail = tail_(velocity, panels_.end().wavenumber, 1, partial_contact::tail_end);
}

/// The numbers of the active panels side by side.
void PartialPanelSolver::gather() {
  g_.clear();
  steepness_.clear();
  weight_.clear();
  ratio_.clear();
  double g = 0;
  for (ActivePanel& active : active_) {
    const PartialPanel& p = panels_[active.panel];
    const std::size_t n = p.rule->n;
    const double *const cumulative = panels_.row(p, PartialPanel::cumulative),
                        *const rate = panels_.row(p, PartialPanel::rate),
                        *const steepness = panels_.row(p, PartialPanel::steepness),
                        *const ratio = panels_.row(p, PartialPanel::ratio);
    active.g_lower = g;
    for (std::size_t i = 0; i < n; ++i) {
      g_.push_back(std::fmax(g + cumulative[i], 1e-300 / scale_));
      weight_.push_back(rate[i] * p.rule->weight[i]);
    }
    steepness_.insert(steepness_.end(), steepness, steepness + n);
    ratio_.insert(ratio_.end(), ratio, ratio + n);
    g += p.g_total;
  }
  end_.g = g;
  end_.band = panels_.end().band(g, end_.tail.i2_at_end);
  stress_.resize(g_.size());
}

/// The relative error of mu_H and of the area, each part of it kept with its panel. Returns the larger one.
double PartialPanelSolver::judge() {
  const Kernels& loops = kernels();
  double f[LegendreRule::most], tail[LegendreRule::kept], total = 0;
  const double by_kappa = 1 / root_.slope, kappa_on_mu = std::fabs(root_.friction_slope) * by_kappa,
               kappa_on_area = std::fabs(root_.share_slope) * by_kappa;
  const double variance_share = 1 / root_.variance, friction_share = root_.friction > 0 ? 1 / root_.friction : 0;
  double of_mu = (1 + kappa_on_mu) * root_.missed, of_area = kappa_on_area * root_.missed, outside = 0;
  std::size_t first = 0;
  for (ActivePanel& active : active_) {
    const PartialPanel& p = panels_[active.panel];
    const std::size_t n = p.rule->n;
    const double *const rate = panels_.row(p, PartialPanel::rate), *const ratio = panels_.row(p, PartialPanel::ratio);
    const double per_scale = 1 / (root_.kappa * scale_);
    const double at_foot = p.root && p.lower == 0 ? per_scale * foot_error(root_.kappa * scale_ * g_[0],
                                                                           root_.obstacle * scale_ * steepness_[0])
                                                  : 0;
    const double g_upper = active.g_lower + p.g_total;
    for (std::size_t i = 0; i < n; ++i) f[i] = rate[i] * stress_[first + i];
    loops.add_up(*p.rule, f, &total, tail);
    const double variance = (rule_error(tail) + at_foot) * variance_share;
    active.variance_by_g = passed_on * total / g_upper * variance_share;
    for (std::size_t i = 0; i < n; ++i) f[i] *= ratio[i];
    loops.add_up(*p.rule, f, &total, tail);
    const double friction = (rule_error(tail) + at_foot * ratio[0]) * friction_share;
    active.friction_by_g = passed_on * total / g_upper * friction_share;
    of_mu += friction + kappa_on_mu * variance;
    of_area += kappa_on_area * variance;
    active.error = friction + std::fmax(kappa_on_mu, kappa_on_area) * variance;
    if (p.any_outside) {
      const double* const beyond = panels_.row(p, PartialPanel::outside);
      for (std::size_t i = 0; i < n; ++i) outside += p.rule->weight[i] * rate[i] * stress_[first + i] * beyond[i];
    }
    first += n;
  }
  // an error of G passes on to all that follows, and to F at the end of the spectrum
  double variance_behind = 1 / end_.g, friction_behind = 0;
  for (std::size_t i = active_.size(); i-- > 0;) {
    ActivePanel& active = active_[i];
    variance_behind += active.variance_by_g;
    friction_behind += active.friction_by_g;
    const double error = panels_[active.panel].g_error;
    const double on_mu = error * (friction_behind + kappa_on_mu * variance_behind);
    const double on_area = error * (kappa_on_area * variance_behind + 1 / (2 * end_.g));
    of_mu += on_mu;
    of_area += on_area;
    active.error += std::fmax(on_mu, on_area);
  }
  const double in_tail = root_.edges * end_.window;
  const double tail_variance = in_tail * end_.tail.i2_error * variance_share,
               tail_friction = in_tail * end_.tail.i1_error * friction_share;
  of_mu += tail_friction + kappa_on_mu * tail_variance;
  of_area += kappa_on_area * tail_variance;
  hysteresis_ = {mu_factor_ * root_.friction, mu_factor_ * root_.friction * of_mu,
                 mu_factor_ * (outside + in_tail * end_.tail.i1_outside)};
  area_error_ = of_area;
  return std::fmax(of_mu, of_area);
}

/// Replaces each panel that has more than its part of the error by its halves.
void PartialPanelSolver::refine(double allowed) {
  double worst = 0;
  for (const ActivePanel& active : active_) worst = std::fmax(worst, active.error);
  const double even = 0.3 * allowed / static_cast<double>(active_.size());
  const double part = std::fmax(1e-3 * worst, std::fmin(worst / 2, even));
  next_.clear();
  for (const ActivePanel& active : active_) {
    if (active.error <= part) {
      next_.push_back(active);
      continue;
    }
    const std::size_t child = panels_.children(active.panel);
    next_.push_back({child});
    next_.push_back({child + 1});
  }
  active_.swap(next_);
}

void PartialPanelSolver::solve(double pressure, double velocity) {
  if (velocity != velocity_) start(velocity);
  scale_ = 1 / pressure / pressure;
  mu_factor_ = 4 / (stiffening_ * pressure);
  root_ = {};
  hysteresis_ = {};
  g1_ = area_error_ = 0;
  active_.clear();
  for (const std::size_t root : panels_.roots()) active_.push_back({root});
  if (active_.empty()) return;
  constexpr int most_rounds = 60;
  const std::size_t most_panels = 20000 + 4 * active_.size();
  const double allowed = 0.85 * rtol_;
  for (int round = 0;; ++round) {
    gather();
    g1_ = end_.g * scale_;
    check_g(g1_, pressure);
    const PartialNodes nodes{g_.data(), steepness_.data(), weight_.data(), ratio_.data(), g_.size()};
    root_ = partial_root(nodes, end_, scale_, rtol_, round == 0 ? usual_kappa : root_.kappa, stress_.data());
    const double error = judge();
    if (error <= allowed) return;
    if (round == most_rounds || active_.size() > most_panels)
      throw NotConverged("PartialContact: mu_H = " + show(hysteresis_.value) + " with relative error " + show(error) +
                         " on " + std::to_string(active_.size()) + " panels where " + argument("rtol") + " = " +
                         show(rtol_) + " was asked for");
    refine(allowed);
  }
}

const PartialPanelSolver::ActivePanel& PartialPanelSolver::panel_at(double wavenumber) const {
  const double y = panels_.y_of(wavenumber);
  const auto after = std::ranges::partition_point(
      active_, [&](const ActivePanel& active) { return panels_[active.panel].lower <= y; });
  return after == active_.begin() ? *after : *(after - 1);
}

double PartialPanelSolver::g_at(double wavenumber) const {
  if (wavenumber >= surface_.back().b) return g1_;
  const ActivePanel& active = panel_at(wavenumber);
  const PartialPanel& p = panels_[active.panel];
  return (active.g_lower + (panels_.y_of(wavenumber) >= p.upper ? p.g_total : panels_.g_to(p, wavenumber))) * scale_;
}

double PartialPanelSolver::stress(double wavenumber) const {
  if (active_.empty()) return 1;
  return partial_stress(root_, g_at(wavenumber), panels_.at(wavenumber).steepness * scale_);
}

double PartialPanelSolver::hysteresis_density(double wavenumber) const {
  if (active_.empty()) return 0;
  const double q_e = panels_.end().wavenumber;
  const double edges = mu_factor_ * end_.window * partial_edges(root_, waves_, velocity_, q_e, wavenumber);
  if (wavenumber > surface_.back().b) return edges;
  const PartialPanels::Place here = panels_.at(wavenumber);
  return edges + mu_factor_ * here.rate * here.ratio * stress(wavenumber);
}

std::vector<PanelSolver::PanelShare> PartialPanelSolver::shares() const {
  std::vector<PanelSolver::PanelShare> result;
  std::size_t first = 0;
  for (const ActivePanel& active : active_) {
    const PartialPanel& p = panels_[active.panel];
    double sum = 0;
    for (std::size_t i = 0; i < p.rule->n; ++i) sum += weight_[first + i] * ratio_[first + i] * stress_[first + i];
    first += p.rule->n;
    result.push_back({panels_.wavenumber_at(p.lower), panels_.wavenumber_at(p.upper), mu_factor_ * sum});
  }
  if (active_.empty()) return result;
  const double q_e = panels_.end().wavenumber;
  for (const auto& [lower, upper] : tail_stretches(q_e, stop_wavenumbers_)) {
    const EdgeIntegrals part = tail_(velocity_, q_e, lower / q_e, upper / q_e);
    result.push_back({lower, upper, mu_factor_ * root_.edges * end_.window * part.i1});
  }
  return result;
}

}  // namespace asperity
