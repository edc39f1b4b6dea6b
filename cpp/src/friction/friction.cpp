// Friction of rubber on a rough surface: the hysteresis (Eq. 22),
//   mu_H = 1/2 int q^3 C(q) S(q) P(q) dq int cos(phi) Im E(q v cos phi) / ((1 - nu^2) sigma0) dphi,
// and the adhesion of the contact area (Eq. 23), at pairs of pressure and velocity.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include "asperity/friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/solver/solver.hpp"
#include "contact/validity.hpp"
#include "numerics/arguments.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// mu_A per contact share (Eq. 23).
double adhesion_per_share(const Adhesion& a, double pressure, double velocity) {
  const double decades = std::log10(velocity / a.reference_velocity);
  return a.shear_stress / pressure * std::exp(-a.width * decades * decades);
}

/// Powers of ten that enclose every v q [rad/s].
std::vector<double> decades(double lowest, double highest) {
  std::vector<double> edges;
  for (int k = static_cast<int>(std::floor(std::log10(lowest) + 1e-9));; ++k) {
    edges.push_back(std::pow(10.0, k));
    if (edges.back() >= highest * (1 - 1e-9)) return edges;
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
  double hysteresis = 0, adhesion = 0, contact_area = 0, error_estimate = 0, extrapolated_share = 0;
  ValidityFlags validity;
};

/// How an error of G passes on: |d ln P / d ln G| is 1/2 at most, and d ln F / d ln G is 1 at most whatever S is.
double sensitivity(bool with_s) { return with_s ? 1 : 0.5; }

/// Row i of the tables of contributions, from the panels that `hysteresis` was summed over.
void add_contributions(Contributions& c, std::size_t i, const Solver& solver, double velocity) {
  const std::size_t n = c.wavenumber.size(), m = c.decade_edges.size() - 1;
  for (std::size_t j = 0; j < n; ++j) c.dmu_dlnq[i * n + j] = solver.hysteresis_density(c.wavenumber[j]);
  const double whole = solver.hysteresis().value;
  if (whole == 0) return;
  for (const auto& [lower, upper, hysteresis] : solver.shares()) {
    const double w = velocity * std::sqrt(lower * upper);
    const auto above = std::ranges::upper_bound(c.decade_edges, w) - c.decade_edges.begin();
    const auto decade = std::clamp<std::size_t>(static_cast<std::size_t>(above), 1, m) - 1;
    c.decade_share[i * m + decade] += hysteresis / whole;
  }
}

}  // namespace

void validate(const Adhesion& adhesion) {
  require_not_negative("shear_stress", adhesion.shear_stress);
  require_positive("reference_velocity", adhesion.reference_velocity);
  require_not_negative("width", adhesion.width);
}

Friction friction(const Spectrum& spectrum, const Rubber& rubber, const Conditions& conditions,
                  std::span<const double> velocity) {
  const std::vector<double> pressure(velocity.size(), conditions.pressure);
  const ContactModel model{conditions.poisson_ratio, conditions.correction, conditions.form, conditions.rtol,
                           conditions.method};
  return friction(spectrum, rubber, model, conditions.adhesion, pressure, velocity, conditions.contributions);
}

Friction friction(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                  const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                  std::span<const double> velocity, bool contributions) {
  check_contact(model, pressure, velocity);
  if (adhesion) validate(*adhesion);
  const SurfaceSegments kept(spectrum);
  const std::span<const Segment> surface = kept.get();
  const auto [q0, q1] = band(spectrum);
  for (const double v : velocity) check_frequencies(spectrum, rubber, v);

  AreaG area_g(model, spectrum, surface, q1);
  ValidityRange validity(surface, model.form, q1);
  const std::optional<SFunction> factor = s_in_integrand(model.correction);

  const std::size_t n = velocity.size();
  Friction f;
  f.pressure.assign(pressure.begin(), pressure.end());
  f.velocity.assign(velocity.begin(), velocity.end());
  for (auto* column : {&f.mu, &f.hysteresis, &f.adhesion, &f.contact_area, &f.shift_factor, &f.error_estimate,
                       &f.extrapolated_share}) {
    heed();  // a gigabyte each where there are many points
    column->assign(n, 0.0);
  }
  if (contributions && n > 0) {
    const auto [slowest, fastest] = std::ranges::minmax(velocity);
    double front = 1;
    for (std::size_t i = 0; i < n; ++i) {
      heed();
      front = std::fmin(front, front_width(surface, rubber, {model.poisson_ratio, pressure[i], velocity[i], 1}));
    }
    f.contributions =
        Contributions{contribution_wavenumbers(q0, q1, front), {}, decades(slowest * q0, fastest * q1), {}};
    f.contributions->dmu_dlnq.assign(n * f.contributions->wavenumber.size(), 0.0);
    f.contributions->decade_share.assign(n * (f.contributions->decade_edges.size() - 1), 0.0);
  }

  Notes notes(spectrum, rubber, model.correction);
  // the error of I1 and I2: rounding of closed forms, or the tolerance of a table's pieces, over all their passes
  const double angular_error = std::holds_alternative<MasterCurve>(rubber) ? 3e-13 : 1e-15;
  std::span<const double> stops;
  if (f.contributions) stops = f.contributions->decade_edges;
  Solver solver(surface, rubber, model, true, factor, stops);
  if (!f.contributions) solver.use_rings_of(spectrum);
  const auto compute = [&](double p, double v, const Shift& shift) {
    Point at;
    solver.solve(p, v, shift.p);
    const Solver::Hysteresis& hysteresis = solver.hysteresis();
    at.hysteresis = hysteresis.value;
    if (hysteresis.value > 0) at.extrapolated_share = hysteresis.outside / hysteresis.value;

    const double g = solver.g(q1);
    at.contact_area = contact_share(area_g(g), model.form);
    at.validity = validity(g, shift.p);
    if (adhesion) {
      at.adhesion = at.contact_area * adhesion_per_share(*adhesion, p, v);
      if (!std::isfinite(at.adhesion))
        throw InvalidInput("shear_stress = " + show(adhesion->shear_stress) + ": overflows over pressure = " + show(p) +
                           ", their ratio must be finite");
    }
    const double mu = at.hysteresis + at.adhesion;

    const double g_error = solver.relative_error() + 2 * shift.relative_error + angular_error;
    const double area_error = sensitivity(false) * g_error;
    at.error_estimate =
        hysteresis.error +
        at.hysteresis * (sensitivity(factor.has_value()) * g_error + 2 * shift.relative_error + angular_error) +
        at.adhesion * area_error;
    if (!(at.error_estimate <= model.rtol * mu && std::isfinite(mu)))
      throw NotConverged("mu = " + show(mu) + " with error " + show(at.error_estimate) +
                         " where rtol = " + show(model.rtol) + " was asked for");
    return at;
  };
  for (const std::size_t i : by_velocity(velocity)) {
    heed();
    const double p = pressure[i], v = velocity[i];
    const Shift shift = affine_shift(model.correction, spectrum, rubber, p, v, model.poisson_ratio);
    Point at;
    if (shift.state != ContactState::no_contact) {
      at_point(p, v, [&] { at = compute(p, v, shift); });
      if (f.contributions) add_contributions(*f.contributions, i, solver, v);
    }
    notes.add(shift, v, at.extrapolated_share, at.validity);
    // all at once, as in a grid each of them waits for memory
    f.mu[i] = at.hysteresis + at.adhesion;
    f.hysteresis[i] = at.hysteresis;
    f.adhesion[i] = at.adhesion;
    f.contact_area[i] = at.contact_area;
    f.shift_factor[i] = shift.p;
    f.error_estimate[i] = at.error_estimate;
    f.extrapolated_share[i] = at.extrapolated_share;
  }
  f.notes = notes.texts();
  return f;
}

}  // namespace asperity
