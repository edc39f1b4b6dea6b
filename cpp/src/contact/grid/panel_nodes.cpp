// A Gauss-Legendre rule of n nodes on a panel of length L misses rho^(-2 n) of a function with singularities no nearer
// than d, ln rho = asinh(2 d / L). L. N. Trefethen, SIAM Rev. 50, 67 (2008).
#include "contact/grid/panel_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/grid/grid.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

using std::numbers::pi;

std::size_t nodes_for(double length, std::size_t level, bool front, bool tabulated) {
  const double falling = std::asinh(pi / length) * (front ? 0.6 : 1);
  const double nodes = (front ? 8 : tabulated ? 8 : 4) + ContactGrid::first_digits * std::numbers::ln10 / (2 * falling);
  return 4 * static_cast<std::size_t>(std::ceil(nodes / 4)) + 4 * level;
}

/// As if the singularity were twice as near, since its distance is an estimate.
std::size_t most_for(double length, double distance) {
  constexpr double digits = 16;
  const double nodes = 4 + digits * std::numbers::ln10 / (2 * std::asinh(distance / length));
  return 4 * static_cast<std::size_t>(std::ceil(std::fmin(nodes, LegendreRule::most) / 4));
}

double pieces_for(double length, double longest, std::size_t level, bool tabulated) {
  constexpr double shortest = 0.05;
  const auto too_few = [&](double pieces) {
    return nodes_for(length / pieces, level, false, tabulated) > LegendreRule::most;
  };
  double pieces = std::ceil(length / longest);
  while (too_few(pieces) && length / pieces > shortest) ++pieces;
  return too_few(pieces) ? 2 * pieces : pieces;
}

/// The modulus may rise by orders of magnitude over the band, so only the roughness of a unit before counts for G.
double singularity(const PanelPlace& panel, std::span<const Segment> surface, const RoughnessWindow* window) {
  double nearest = pi / 2;
  const auto largest = [&](const Segment& segment, double shift) {  // c on the panel that is so far away in ln q
    const auto c_at = [&](double y) {
      const double q = std::exp(y + shift), square = q * q;
      return square * square * segment.density_at(std::clamp(y + shift - std::log(segment.a), 0.0, segment.length()));
    };
    const double at_lower = c_at(panel.lower), at_upper = c_at(panel.upper);
    if (at_lower == at_upper) return at_lower;
    nearest = std::fmin(nearest, pi * (panel.upper - panel.lower) / std::fabs(std::log(at_upper / at_lower)));
    return std::fmax(at_lower, at_upper);
  };
  nearest = std::fmin(nearest, panel.before / largest(panel.segment, 0));
  if (!window) return nearest;
  const double middle = std::exp((panel.lower + panel.upper) / 2);
  double slope = 0;
  for (const double side : {-RoughnessWindow::half_length, RoughnessWindow::half_length}) {
    const double q = middle * std::exp(side);
    const auto met = std::ranges::lower_bound(surface, q, {}, &Segment::b);
    if (met != surface.end() && q > surface.front().a)
      slope += largest(*met, side) / (2 * RoughnessWindow::half_length);
  }
  return std::fmin(nearest, (*window)(middle) / slope);
}

}  // namespace asperity
