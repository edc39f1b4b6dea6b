// The rise after the distance s is what the heat of the distance u before has left of it, for all u up to s:
//   theta(q, s) = int_0^s du / v h(u / 2 R) sum_q' K(q, q', u / v) f(q', s - u),
// K = a (b erfcx(a l) - a erfcx(b l)) / (b^2 - a^2) with a = 2 q, b = 2 q', l = sqrt(D u / v), h the overlap of two
// discs or 1 (box). f is linear between equal steps of s, and its last value follows from the one before.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "contact/correction.hpp"
#include "heat/flash_map.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

constexpr std::size_t level = 1;            // of the grid: six digits
constexpr std::size_t steps_a_length = 80;  // of the residence; errors of s0 are a small part of a step
constexpr std::size_t steps = steps_a_length * 3 / 2;

/// What is left of heat that came so many steps before, a unit of it that rises and falls over a step each. The kernel
/// is a sum of two products: (felt_i b_j - a_i^2 heated_j) / (b_j^2 - a_i^2) of temperature point i and node j, and
/// felt_i of the surface, so that two vectors a step are all of it.
struct Left {
  std::vector<VectorXd> felt, heated;
};
struct Response {
  Left whole, falling;  // of the very first heat there is but the fall: it does not rise from nothing
  VectorXd a, b;
  MatrixXd inverse;  // 1 / (b^2 - a^2), temperature points x nodes
};

double overlap(Residence residence, double share) {
  if (share >= 1) return 0;
  if (residence == Residence::box) return 1;
  return 1 - 2 / pi * (share * std::sqrt(1 - share * share) + std::asin(share));
}

VectorXd scaled_erfcs(const VectorXd& doubled, double length) {
  return doubled.unaryExpr([&](double a) { return scaled_erfc(a * length); });
}

Response response(const HeatScene& scene, const HeatGrid& grid, double residence_time) {
  const Heating& heating = scene.heating;
  const double diffusivity = heating.conductivity / (heating.density * heating.heat_capacity);
  const auto columns = [](const std::vector<double>& q) -> VectorXd {
    return 2 * Eigen::Map<const VectorXd>(q.data(), static_cast<Index>(q.size()));
  };
  Response result{{}, {}, columns(grid.temperature_points()), columns(grid.wavenumber()), {}};
  const VectorXd &a = result.a, &b = result.b;
  // moved a little off where the two are the same: K is smooth there
  result.inverse.resize(a.size(), b.size());
  for (Index j = 0; j < b.size(); ++j)
    for (Index i = 0; i < a.size(); ++i) {
      double apart = b[j] - a[i];
      if (std::fabs(apart) < 1e-7 * b[j]) apart = std::copysign(1e-7 * b[j], apart);
      result.inverse(i, j) = 1 / (apart * (b[j] + a[i]));
    }
  for (Left* const left : {&result.whole, &result.falling}) {
    left->felt.assign(steps_a_length + 1, VectorXd::Zero(a.size()));
    left->heated.assign(steps_a_length + 1, VectorXd::Zero(b.size()));
  }
  const LegendreRule& rule = legendre_rule(8);
  const double step = residence_time / steps_a_length;
  for (std::size_t k = 0; k < steps_a_length; ++k) {
    heed();
    // in sqrt(tau), of which erfcx is smooth
    const double lower = std::sqrt(step * static_cast<double>(k)), upper = std::sqrt(step * static_cast<double>(k + 1));
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double root = lower + (upper - lower) / 2 * (1 + rule.node[i]), tau = root * root;
      const double share = tau / step - static_cast<double>(k);  // of the step
      const double weight = (upper - lower) * rule.weight[i] * root * overlap(heating.residence, tau / residence_time);
      const double length = std::sqrt(diffusivity) * root;
      const VectorXd felt = weight * a.cwiseProduct(scaled_erfcs(a, length)), heated = weight * scaled_erfcs(b, length);
      result.whole.felt[k] += (1 - share) * felt;
      result.whole.heated[k] += (1 - share) * heated;
      result.falling.felt[k + 1] += share * felt;
      result.falling.heated[k + 1] += share * heated;
    }
  }
  for (std::size_t k = 0; k <= steps_a_length; ++k) {
    result.whole.felt[k] += result.falling.felt[k];
    result.whole.heated[k] += result.falling.heated[k];
  }
  return result;
}

/// Where a curve first comes within 1 / e of its last value; its values are steps apart.
double distance_to_last(const std::vector<double>& values, double step) {
  const double last = values.back(), span = values.front() - last;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double before = (values[i - 1] - last) / span, here = (values[i] - last) / span;
    if (here <= 1 / std::numbers::e)
      return step * (static_cast<double>(i - 1) + (before - 1 / std::numbers::e) / (before - here));
  }
  return step * static_cast<double>(values.size());
}

}  // namespace

double sliding_length(const HeatScene& scene, const HeatPoint& point) {
  const RoughnessWindow window(scene.surface);
  const ContactGridOptions options{.poisson_ratio = scene.model.poisson_ratio,
                                   .level = level,
                                   .tabulated = std::holds_alternative<MasterCurve>(scene.rubber),
                                   .macro_wavenumber = scene.macro_wavenumber,
                                   .window = has_own_rule(scene.model.correction) ? &window : nullptr};
  const HeatGrid grid(scene.surface, options, asperity_wavenumber(scene.model.correction, scene.spectrum));
  FlashMap map(scene, grid);
  map.start(point);
  const double reach = scene.heating.contact_diameter / (scene.heating.residence == Residence::box ? 2 : 1);
  const Response after = response(scene, grid, reach / point.velocity);
  const VectorXd a2 = after.a.cwiseAbs2();
  const MatrixXd at_once =
      (after.whole.felt[0] * after.b.transpose() - a2 * after.whole.heated[0].transpose()).cwiseProduct(after.inverse);
  const Eigen::RowVectorXd at_end = grid.row_at(scene.surface.back().b);
  std::vector<VectorXd> nodes, felt;  // heat, and what each temperature point makes of it together with the surface's
  std::vector<double> mu, rise;
  double heat_of_surface = 0;
  VectorXd theta = VectorXd::Zero(after.a.size());
  for (std::size_t n = 0; n <= steps; ++n) {
    heed();
    if (n > 0) {
      VectorXd of_felt = VectorXd::Zero(after.a.size()), of_heated = VectorXd::Zero(after.b.size());
      for (std::size_t k = 1; k <= std::min(n, steps_a_length); ++k) {
        const Left& left = k == n ? after.falling : after.whole;
        of_felt += left.felt[k].cwiseProduct(felt[n - k]);
        of_heated += left.heated[k].cwiseProduct(nodes[n - k]);
      }
      const VectorXd before = of_felt - a2.cwiseProduct(after.inverse * of_heated);
      for (int pass = 0; pass < 3; ++pass) {  // the last heat, by what it was a step before at first
        const VectorXd& f = pass == 0 ? nodes.back() : map.heat_of_nodes();
        theta = (before + at_once * f + heat_of_surface * after.whole.felt[0]).cwiseMax(0.0);
        map(theta);
        heat_of_surface = map.heat_of_surface();
      }
    } else {
      map(theta);
      heat_of_surface = map.heat_of_surface();
    }
    nodes.push_back(map.heat_of_nodes());
    felt.emplace_back(after.inverse * after.b.cwiseProduct(nodes.back()));
    felt.back().array() += heat_of_surface;
    mu.push_back(map.hysteresis() + map.adhesion());
    rise.push_back(at_end.dot(theta));
  }
  const double step = reach / static_cast<double>(steps_a_length);
  const double least = scene.model.rtol * mu.front();
  return distance_to_last(std::fabs(mu.front() - mu.back()) > least ? mu : rise, step);
}

}  // namespace asperity
