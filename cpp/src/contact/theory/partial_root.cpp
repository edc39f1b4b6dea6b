// The root of PartialContact's rule in ln kappa, by Newton's steps in a bracket
// (contact/theory/partial_contact_rule.hpp).
#include "contact/theory/partial_root.hpp"

#include <cmath>
#include <limits>

#include "numerics/arguments.hpp"

namespace asperity {

RoughnessEnd::RoughnessEnd(const RoughnessWindow& roughness, double g_factor)
    : wavenumber(roughness.end()),
      window(g_factor * std::fmax(roughness(wavenumber), partial_contact::last / 2 * roughness.total())),
      total(g_factor * roughness.total()),
      factor(total > 0 ? std::pow(4 * (window / total), 0.2) : 1) {}

namespace {

struct Residual {
  double value;  // ln (F spread) - ln variance
  ContactSums at;
};

Residual residual(const PartialNodes& nodes, const PartialEnd& end, double scale, double kappa,
                  const PartialColumns& columns) {
  const double g = kappa * scale * end.g;
  const partial_contact::AtEnd rule(g, kappa, end.band);
  const PartialSums sums =
      partial_sums(nodes, kappa * scale, rule.obstacle.value * scale, rule.obstacle.log_slope, columns);
  const double in_tail = rule.edges.value * end.window;
  const double variance = sums.variance + in_tail * end.tail.i2, friction = sums.friction + in_tail * end.tail.i1;
  Residual result{};
  ContactSums& at = result.at;
  at.kappa = kappa;
  at.share = rule.share;
  at.variance = variance;
  at.friction = friction;
  at.edges = rule.edges.value;
  at.obstacle = rule.obstacle.value;
  at.share_slope = rule.share_slope / rule.share;
  at.friction_slope =
      friction > 0 ? (sums.friction_slope + in_tail * end.tail.i1 * rule.edges.log_slope) / friction : 0;
  // dF / d ln kappa = g A1
  at.slope = g * rule.share / rule.integral + rule.spread.log_slope -
             (sums.variance_slope + in_tail * end.tail.i2 * rule.edges.log_slope) / variance;
  result.value = std::log(rule.integral * rule.spread.value / (variance * scale));
  return result;
}

}  // namespace

ContactSums partial_root(const PartialNodes& nodes, const PartialEnd& end, double scale, double rtol, double start,
                         const PartialColumns& columns) {
  constexpr double longest_step = 1.5;
  const double good = std::fmin(1e-4, 0.03 * std::sqrt(rtol));
  double x = std::log(start), below = -std::numeric_limits<double>::infinity(), above = -below;
  for (int i = 0; i < 100; ++i) {
    Residual found = residual(nodes, end, scale, std::exp(x), columns);
    if (!std::isfinite(found.value)) break;
    (found.value < 0 ? below : above) = x;
    double step = -found.value / found.at.slope;
    // between three roots, as heat may make them, Newton's steps lead away from all
    if (!(found.at.slope > 0 && std::fabs(step) <= longest_step)) step = std::copysign(longest_step, -found.value);
    if (std::fabs(step) <= good) {
      // the step's own error is its square, and so is what is left out here
      found.at.missed = step * step;
      ContactSums& at = found.at;
      at.kappa *= std::exp(step);
      at.share = partial_contact::AtEnd(at.kappa * scale * end.g, at.kappa, end.band).share;
      at.friction *= 1 + at.friction_slope * step;
      return at;
    }
    double next = x + step;
    if (!(next > below && next < above))
      next = std::isfinite(below) && std::isfinite(above) ? (below + above) / 2 : next;
    if (next == x) break;
    x = next;
  }
  throw NotConverged("the root of PartialContact's rule: at kappa = " + show(std::exp(x)) +
                     " for G = " + show(end.g * scale));
}

}  // namespace asperity
