// The check of heat by GSL: mu_H of Eq. 22, P_m, A / A0 and
//   theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q') + chi (mu_A sigma0 v / (rho c_v P_m)) 2 q t N
// by adaptive rules over all of the roughness, G integrated anew inside of each. B. N. J. Persson, J. Phys.: Condens.
// Matter 18, 7789 (2006).
#include "heat/heat_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "contact/solver/gsl_solver.hpp"
#include "contact/solver/solver.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

GslHeat::GslHeat(const HeatScene& scene)
    : scene_(scene),
      factor_(s_in_integrand(scene.model.correction)),
      area_g_(scene.model, scene.spectrum, scene.surface, band(scene.spectrum)[1]) {}

GslHeat::Pass GslHeat::pass(const HeatPoint& point, const HeatGrid& grid, const VectorXd& theta) {
  const ContactModel& model = scene_.model;
  const Heating& heating = scene_.heating;
  const double q1 = band(scene_.spectrum)[1];
  const auto frequency = [&](double q) {
    const ShiftValue shift = held_shift(scene_.shift, point.temperature + grid.row_at(q).dot(theta));
    return point.velocity * q * std::pow(10.0, shift.log10_a_T);
  };
  const ShiftValue felt = grid.also_felt().size() == 0
                              ? ShiftValue{}
                              : held_shift(scene_.shift, point.temperature + grid.also_felt().dot(theta));
  Pass result;
  HotPoint& at = result.at;
  at.shift = hot_shift(model.correction, scene_.spectrum, scene_.rubber, felt, model.poisson_ratio, point.pressure,
                       point.velocity)
                 .shift;
  at.temperature = point.temperature + grid.row_at(q1).dot(theta);
  result.rise.setZero(theta.size());
  if (at.shift.state == ContactState::no_contact) return result;
  const GslSolver solver(scene_.surface, scene_.rubber,
                         {model.poisson_ratio, point.pressure, point.velocity, at.shift.p, frequency}, {}, true,
                         model.rtol, adaptive_rule(model.method));
  const GslSolver::Hysteresis hysteresis = solver.hysteresis(model.form, factor_);
  at.hysteresis = hysteresis.value;
  if (hysteresis.value > 0) at.extrapolated_share = std::min(1.0, hysteresis.outside / hysteresis.value);
  at.g = solver.g(q1);
  at.contact_area = contact_share(area_g_(at.g), model.form);
  at.adhesion = at.contact_area * point.adhesion_per_area;
  at.macro_area = heating.macro_area.value_or(contact_share(solver.g(scene_.macro_wavenumber), model.form));
  at.error_estimate = hysteresis.error + (solver.relative_error() + 2 * at.shift.relative_error) * hysteresis.value +
                      (solver.relative_error() / 2 + at.shift.relative_error) * at.adhesion;

  const HeatKernel kernel(heating, point.velocity);
  const double flux = point.velocity * point.pressure / (heating.density * heating.heat_capacity * at.macro_area);
  const std::vector<double>& points = grid.temperature_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    heed();
    const HeatKernel::Place place = kernel.at(points[i]);
    const auto weight = [&](double q) { return q * kernel(place, kernel.at(q)); };
    result.rise[static_cast<Index>(i)] = flux * (2 * solver.weighted_hysteresis(model.form, factor_, weight).value +
                                                 heating.interface_share * at.adhesion * kernel.from_surface(place));
  }
  return result;
}

HotPoint GslHeat::operator()(const HeatPoint& point, const HotPoint& found, FlashSolver& panels) {
  FlashMap& map = panels.finest_map();
  const HeatGrid& grid = map.grid();
  VectorXd theta = panels.rise();
  Tangent tangent;
  tangent.take(map);
  constexpr int passes = 12;
  for (int i = 0; i < passes; ++i) {
    Pass by_gsl = pass(point, grid, theta);
    HotPoint& at = by_gsl.at;
    const double mu = at.hysteresis + at.adhesion;
    const VectorXd step = tangent.lu.solve(by_gsl.rise - theta);
    const double left = tangent.slope_of_mu.cwiseAbs().dot(step.cwiseAbs());
    at.error_estimate += 2 * left;
    if (at.error_estimate <= scene_.model.rtol * mu || mu == 0) {
      at.gain = found.gain;
      at.branches = found.branches;
      return at;
    }
    if (!(left > 0.01 * scene_.model.rtol * mu)) break;
    theta = (theta + step).cwiseMax(0.0);
  }
  throw NotConverged("rtol = " + show(scene_.model.rtol) + ": GSL's integrals do not reach it with the heat");
}

}  // namespace asperity
