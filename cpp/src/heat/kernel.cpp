// Heat of roughness q' lies exp(-2 q' z) deep below an insulated surface and spreads along z alone, exp(-D k^2 tau) in
// Fourier space; roughness q feels its mean with the weight 2 q exp(-2 q z). Over the residence of a spot in contact
// this is g(q, q'). B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006), with his residence for the box; the
// closed form is by partial fractions, K(tau) = a (b erfcx(a s) - a erfcx(b s)) / (b^2 - a^2), s = sqrt(D tau), a = 2
// q, b = 2 q'.
#include "heat/kernel.hpp"

#include <cmath>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

/// Refuses a number that only a slip of unit gives.
void require_between(std::string_view name, double value, double lowest, double highest, std::string_view unit) {
  if (!(value >= lowest && value <= highest))
    refuse(name, value, "in [" + show(lowest) + ", " + show(highest) + "] " + std::string(unit));
}

}  // namespace

void validate(const Heating& heating) {
  require_between("density", heating.density, 100, 1e4, "kg/m^3");
  require_between("heat_capacity", heating.heat_capacity, 100, 1e4, "J/(kg K)");
  require_between("conductivity", heating.conductivity, 0.01, 100, "W/(m K)");
  require_positive("contact_diameter", heating.contact_diameter);
  if (heating.macro_wavenumber && heating.macro_area)
    throw InvalidInput("macro_area = " + show(*heating.macro_area) +
                       ": must be left out where macro_wavenumber is given, which gives that area");
  if (heating.macro_wavenumber) require_positive("macro_wavenumber", *heating.macro_wavenumber);
  if (heating.macro_area && !(*heating.macro_area > 0 && *heating.macro_area <= 1))
    refuse("macro_area", *heating.macro_area, "in (0, 1]");
  if (!(heating.interface_share >= 0 && heating.interface_share <= 1))
    refuse("interface_share", heating.interface_share, "in [0, 1]");
}

HeatKernel::HeatKernel(const Heating& heating, double velocity)
    : residence_(heating.residence),
      time_(heating.contact_diameter / velocity / (residence_ == Residence::box ? 2 : 1)),
      length_(std::sqrt(heating.conductivity / (heating.density * heating.heat_capacity) * time_)) {}

HeatKernel::Place HeatKernel::at(double wavenumber) const {
  const double x = 2 * wavenumber * length_;
  const HeatFunctions f = heat_functions(residence_, x);
  return {x, f.n / x, f.q};
}

// N / x falls with the slope -Q / x^2: where x and y are near, the difference is the mean of that between them.
double HeatKernel::operator()(const Place& felt, const Place& heated) const {
  const double x = felt.x, y = heated.x, sum = x + y, apart = y - x;
  constexpr double near = 0.01;
  if (std::fabs(apart) > near * sum) return time_ * x * x * y * ((felt.psi - heated.psi) / (apart * sum));
  if (apart == 0) return time_ / 2 * felt.q;
  const LegendreRule& rule = legendre_rule(4);
  double mean = 0;
  for (std::size_t i = 0; i < rule.n; ++i) {
    const double z = sum / 2 + apart / 2 * rule.node[i];
    mean += rule.weight[i] / 2 * heat_functions(residence_, z).q / (z * z);
  }
  return time_ * x * x * y / sum * mean;
}

std::vector<double> heat_kernel(std::span<const double> q, std::span<const double> q_prime, double velocity,
                                const Heating& heating) {
  validate(heating);
  require_positive("velocity", velocity);
  require_each_positive("q", q);
  require_each_positive("q_prime", q_prime);
  require_same_size("q_prime", q_prime.size(), "q", q.size());
  const HeatKernel kernel(heating, velocity);
  std::vector<double> g(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    heed_at(i);
    g[i] = kernel(kernel.at(q[i]), kernel.at(q_prime[i]));
  }
  return g;
}

}  // namespace asperity
