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
    throw InvalidInput(argument("macro_area") + " = " + value(*heating.macro_area) + must_be() + "left out where " +
                           argument("macro_wavenumber") + " is given, which gives that area",
                       "invalid-value");
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

// The mean of a smooth function over a thousandth of its argument: that of its values at two Gauss nodes.
double HeatKernel::near(double felt, double heated) const {
  const double x = 2 * felt * length_, y = 2 * heated * length_, sum = x + y, apart = y - x;
  constexpr double node = 0.57735026918962576;
  double mean = 0;
  for (const double side : {-node, node}) {
    const double z = sum / 2 + apart / 2 * side;
    mean += heat_functions(residence_, z).q / (2 * z * z);
  }
  return time_ * x * x * y / sum * mean;
}

namespace {

constexpr double near_in_table = 0.004;  // |q - q'| / (q + q'), where differences keep twelve digits

}  // namespace

HeatKernelTable::HeatKernelTable(std::span<const double> felt, std::span<const double> heated)
    : felt_(felt.begin(), felt.end()), heated_(heated.begin(), heated.end()) {
  using Eigen::Index;
  factor_.resize(static_cast<Index>(felt.size()), static_cast<Index>(heated.size()));
  for (Index j = 0; j < factor_.cols(); ++j)
    for (Index i = 0; i < factor_.rows(); ++i) {
      const double a = felt[static_cast<std::size_t>(i)], b = heated[static_cast<std::size_t>(j)];
      const double apart = b - a, sum = a + b;
      if (std::fabs(apart) > near_in_table * sum) {
        factor_(i, j) = 2 * (a * a) * (b * b) / (apart * sum);
      } else {
        factor_(i, j) = 0;
        near_.push_back({i, j});
      }
    }
}

void HeatKernelTable::fill(const Heating& heating, double velocity, Eigen::MatrixXd& table, Eigen::VectorXd& surface) {
  using Eigen::Index;
  const HeatKernel kernel(heating, velocity);
  psi_felt_.resize(factor_.rows());
  psi_heated_.resize(factor_.cols());
  surface.resize(factor_.rows());
  for (Index i = 0; i < factor_.rows(); ++i) {
    const HeatKernel::Place place = kernel.at(felt_[static_cast<std::size_t>(i)]);
    psi_felt_[i] = place.psi;
    surface[i] = kernel.from_surface(place);
  }
  for (Index j = 0; j < factor_.cols(); ++j) psi_heated_[j] = kernel.at(heated_[static_cast<std::size_t>(j)]).psi;
  // t x^2 y q' (psi - psi') / (y^2 - x^2)
  table.resize(factor_.rows(), factor_.cols());
  for (Index j = 0; j < factor_.cols(); ++j)
    table.col(j).array() =
        kernel.time() * kernel.length() * factor_.col(j).array() * (psi_felt_.array() - psi_heated_[j]);
  for (const auto& [i, j] : near_) {
    const double q = felt_[static_cast<std::size_t>(i)], heated = heated_[static_cast<std::size_t>(j)];
    table(i, j) = heated * kernel.near(q, heated);
  }
}

std::vector<double> heat_kernel(std::span<const double> q, std::span<const double> q_prime,
                                std::span<const double> velocity, const Heating& heating) {
  validate(heating);
  for (const double v : velocity) require_positive("velocity", v);
  require_each_positive("q", q);
  require_each_positive("q_prime", q_prime);
  require_same_size("q_prime", q_prime.size(), "q", q.size());
  require_same_size("velocity", velocity.size(), "q", q.size());
  std::vector<double> g(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    heed_at(i);
    const HeatKernel kernel(heating, velocity[i]);
    g[i] = kernel(kernel.at(q[i]), kernel.at(q_prime[i]));
  }
  return g;
}

std::vector<double> heat_kernel(std::span<const double> q, std::span<const double> q_prime, double velocity,
                                const Heating& heating) {
  require_positive("velocity", velocity);
  return heat_kernel(q, q_prime, std::vector<double>(q.size(), velocity), heating);
}

}  // namespace asperity
