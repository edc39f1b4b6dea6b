// The rubber on the cells of a surface's grid at a velocity: I2 and R = I1 / I2 as the polynomials through their
// values, G where cells end, and how much of the errors of G and of mu_H (ring_solver.hpp) these polynomials make.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/solver/ring_solver.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes;
constexpr double of_points = 3e-9;  // relative error of G by the fine rules of blocks: on sparse rows 2e-9 at most
constexpr double unknown = std::numeric_limits<double>::infinity();

/// The largest of the last coefficients of the polynomial through values at Gauss-Legendre nodes. Those beyond are no
/// larger where I1 and I2 are analytic, as of a Prony series, and fall like n^-3.5 where they are not, as at the knots
/// of a master curve.
double last_coefficient(const double* values) {
  double total = 0, tail[LegendreRule::kept], last = 0;
  kernels().add_up(legendre_rule(nodes), values, &total, tail);
  for (std::size_t k = 0; k < LegendreRule::tails; ++k) last = std::fmax(last, std::fabs(tail[k]));
  return last;
}

/// The error of the integral of such a polynomial over m or u, in units of the last coefficient and of m or u. Beyond
/// the known coefficients polynomials of high degree meet the roughness of the surface, and the rule takes those of the
/// twice as high degree for a constant: they are the smaller the fewer knots of a master curve a cell has. Expected are
/// 2 and 1; one random table in a hundred had more than they tell, and 2.3 times as much at most.
double passed_on(double roughness, std::size_t knots) {
  const double apart = static_cast<double>(knots) / static_cast<double>(nodes);
  return 6 * roughness * std::sqrt(std::fmax(1, 2 * apart)) + 3 * std::clamp(apart * apart, 0.03, 1.0);
}

}  // namespace

/// I2, R and the part of it from outside at the points of a group.
void RingSolver::take_modulus(const RingSurface::Group& group, Modulus& at) {
  const std::size_t n = group.wavenumber.size();
  for (std::size_t k = 0; k < n; ++k) frequency_[k] = velocity_ * group.wavenumber[k];
  const bool any_outside = angular_integrals(rubber_, {frequency_.data(), n}, at.ratio, at.i2, {i1_outside_.data(), n});
  at.outside.clear();
  for (std::size_t k = 0; k < n; ++k) {
    at.ratio[k] /= at.i2[k];
    if (any_outside) at.outside.push_back(i1_outside_[k] / at.i2[k]);
    at.i2[k] *= g_factor_;
  }
}

void RingSolver::start(double velocity) {
  velocity_ = velocity;
  ++starts_;
  unit_g_ = 0;
  g_relative_error_ = 0;
  double error = 0, mu = 0, of_ratio = 0, of_ratio_ahead = 0, mu_ahead = 0, before = 0;
  std::size_t index = 0;
  const auto* const curve = std::get_if<MasterCurve>(&rubber_);
  const std::span<const double> knots = curve ? curve->knots() : std::span<const double>();
  auto passed = knots.begin();
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    const RingSurface::Group& group = surface_.groups()[i];
    Modulus& at = moduli_[i];
    take_modulus(group, at);
    passed = std::lower_bound(passed, knots.end(), frequency_[0]);
    parts_[i].g_lower = unit_g_;
    for (std::size_t cell = 0; cell < group.cells.size(); ++cell) {
      const RingSurface::Cell& is = group.cells[cell];
      const double *const i2 = &at.i2[nodes * cell], *const to_g = &group.to_g[nodes * cell];
      double part = 0;
      for (std::size_t k = 0; k < nodes; ++k) part += to_g[k] * i2[k];
      const auto next = std::upper_bound(passed, knots.end(), frequency_[nodes * (cell + 1) - 1]);
      const auto between = static_cast<std::size_t>(next - passed);
      passed = next;
      unit_g_ += part;
      error += last_coefficient(i2) * is.m_part * passed_on(is.roughness_of_m, between);
      // where I2 spans decades polynomials through it may come out below zero, and so may G at the front
      if (part != 0) g_relative_error_ = std::fmax(g_relative_error_, unit_g_ > 0 ? error / unit_g_ : unknown);
      const double root = std::sqrt(std::fmax(0, unit_g_));
      root_at_cells_[index++] = root;
      const double* const ratio = &at.ratio[nodes * cell];
      at.ratio_error[cell] =
          last_coefficient(ratio) * passed_on(std::fmax(is.roughness_of_m, is.roughness_of_u), between);
      const double rise = root - before;
      before = root;
      of_ratio += at.ratio_error[cell] * part;
      mu += ratio[nodes / 2] * part;
      of_ratio_ahead += at.ratio_error[cell] * rise;
      mu_ahead += ratio[nodes / 2] * rise;
    }
  }
  g_relative_error_ += of_points;
  // F is between G and its root
  excess_ = unit_g_ == 0 ? 0
                         : std::fmax(g_relative_error_ / (of_g * rtol_),
                                     std::fmax(of_ratio / mu, of_ratio_ahead / mu_ahead) / (of_hysteresis / 2 * rtol_));
}

/// Of R in the cells, on int R dF.
double RingSolver::interpolation_error(const ContactIntegral& contact) {
  kernels().contact_integral_of_roots(contact.table, root_at_cells_.data(), root_of_scale_, 0, root_at_cells_.size(),
                                      f_at_cells_.data());
  double result = 0, before = 0;
  std::size_t index = 0;
  for (const Modulus& at : moduli_)
    for (const double error : at.ratio_error) {
      result += error * (f_at_cells_[index] - before);
      before = f_at_cells_[index++];
    }
  return result;
}

}  // namespace asperity
