// The root of PartialContact's rule, int R dG + int T d ln x = F(kappa G1), in ln kappa, by Newton's steps in a bracket
// (contact/partial_contact_rule.hpp).
#include <cmath>
#include <limits>

#include "contact/partial_contact_rule.hpp"
#include "contact/solver/partial_solver.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

struct Residual {
  double value;  // ln F - ln variance
  PartialRoot at;
};

Residual residual(const PartialNodes& nodes, double g1, double scale, const TailIntegrals& tail, double tail_rate,
                  double kappa, double* stress) {
  const partial_contact::End end(kappa * scale * g1);
  const partial_contact::Factor obstacle = partial_contact::obstacle(end), edges = partial_contact::edges(end);
  const PartialSums sums = partial_sums(nodes, kappa * scale, obstacle.value * scale, obstacle.log_slope, stress);
  const double in_tail = edges.value * tail_rate, variance = sums.variance + in_tail * tail.i2;
  const double friction = sums.friction + in_tail * tail.i1, log_edges = edges.log_slope;
  Residual result{};
  PartialRoot& at = result.at;
  at.kappa = kappa;
  at.share = end.share;
  at.variance = variance;
  at.friction = friction;
  at.tail_friction = in_tail * tail.i1;
  at.edges = edges.value;
  at.obstacle = obstacle.value;
  at.share_slope = end.share_slope / end.share;
  at.friction_slope = friction > 0 ? (sums.friction_slope + in_tail * tail.i1 * log_edges) / friction : 0;
  // dF / d ln kappa = kappa G1 A1
  at.slope = kappa * scale * g1 * end.share / end.integral -
             (sums.variance_slope + in_tail * tail.i2 * log_edges) / variance;
  result.value = std::log(end.integral / (variance * scale));
  return result;
}

}  // namespace

PartialRoot partial_root(const PartialNodes& nodes, double g1, double scale, const TailIntegrals& tail, double tail_rate,
                         double rtol, double* stress) {
  // kappa is 0.3 to 2 where it was seen; the start knows no other point
  constexpr double start = -0.3, longest_step = 1.5;
  const double good = std::fmin(1e-4, 0.03 * std::sqrt(rtol));
  double x = start, below = -std::numeric_limits<double>::infinity(), above = -below;
  for (int i = 0; i < 100; ++i) {
    Residual found = residual(nodes, g1, scale, tail, tail_rate, std::exp(x), stress);
    if (!std::isfinite(found.value)) break;
    (found.value < 0 ? below : above) = x;
    double step = -found.value / found.at.slope;
    if (!(std::fabs(step) <= longest_step)) step = std::copysign(longest_step, -found.value);
    if (std::fabs(step) <= good) {
      // the step's own error is its square, and so is what is left out here
      PartialRoot& at = found.at;
      at.kappa *= std::exp(step);
      at.share = partial_contact::End(at.kappa * scale * g1).share;
      at.friction *= 1 + at.friction_slope * step;
      return at;
    }
    double next = x + step;
    if (!(next > below && next < above)) next = std::isfinite(below) && std::isfinite(above) ? (below + above) / 2 : next;
    if (next == x) break;
    x = next;
  }
  throw NotConverged("the root of PartialContact's rule: at kappa = " + show(std::exp(x)) + " for G = " +
                     show(g1 * scale));
}

}  // namespace asperity
