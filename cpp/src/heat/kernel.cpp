// Heat of roughness q' lies exp(-2 q' z) deep below an insulated surface and spreads along z alone, exp(-D k^2 tau) in
// Fourier space; roughness q feels its mean with the weight 2 q exp(-2 q z). Over the residence of a spot in contact
// this is g(q, q'). B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006), with his residence for the box; the
// closed form is by partial fractions, K(tau) = a (b erfcx(a s) - a erfcx(b s)) / (b^2 - a^2), s = sqrt(D tau), a = 2
// q, b = 2 q'.
#include "heat/kernel.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/simd.hpp"

namespace asperity {

// N(x) = int_0^1 h(w) erfcx(x sqrt w) dw. For the box, h = 1, it is M(x) = (erfcx(x) - 1 + 2 x / sqrt pi) / x^2, and
// for the disc, by parts, N(x) = (4 / pi) int_0^1 w sqrt(1 - w^2) M(x sqrt w) dw. Since x M' = 2 (erfcx - M), Q = N -
// x N' is 3 M - 2 erfcx for the box and the same integral over it for the disc; all integrands are positive. The disc's
// functions are series in 1 / x beyond e^12.5, and polynomials in ln x before.

using std::numbers::inv_sqrtpi;
using std::numbers::pi;

double scaled_erfc(double x) {
  if (x < 10) {
    const double square = x * x, rest = std::fma(x, x, -square);
    return std::exp(square) * (1 + rest) * std::erfc(x);
  }
  double sum = 1, term = 1;
  const double step = 0.5 / (x * x);
  for (int n = 1; n < 30 && std::fabs(term) > 1e-17; ++n) {
    term *= -(2 * n - 1) * step;
    sum += term;
  }
  return sum / x * inv_sqrtpi;
}

namespace {

HeatFunctions box(double x) {
  if (x < 0.5) {                                                   // M = sum (-x)^n / Gamma(n / 2 + 2)
    double n = 0, q = 0, even = 1, odd = -x * 4 / 3 * inv_sqrtpi;  // Gamma(2) = 1, Gamma(5/2) = 3 sqrt(pi) / 4
    for (int k = 0; k < 40; k += 2) {
      n += even + odd;
      q += (1 - k) * even - k * odd;
      even *= x * x / (0.5 * k + 2);
      odd *= x * x / (0.5 * (k + 1) + 2);
    }
    return {n, q};
  }
  const double e = scaled_erfc(x), m = (e - 1 + 2 * x * inv_sqrtpi) / (x * x);
  return {m, 3 * m - 2 * e};
}

/// With w = sin^2(phi), on Gauss panels that halve towards phi = 0, where M(x sin phi) changes.
HeatFunctions disc_by_quadrature(double x) {
  const LegendreRule& rule = legendre_rule(24);
  HeatFunctions sum{0, 0};
  double lower = pi / 2;
  while (lower > 0) {
    const double upper = lower;
    lower = x * upper < 0.5 ? 0 : upper / 2;
    const double half = (upper - lower) / 2;
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double phi = lower + half * (1 + rule.node[i]), s = std::sin(phi), c = std::cos(phi);
      const double weight = half * rule.weight[i] * 8 / pi * c * c * std::sqrt(1 + s * s) * s * s * s;
      const HeatFunctions m = box(x * s);
      sum.n += weight * m.n;
      sum.q += weight * m.q;
    }
  }
  return sum;
}

// h's expansion at w = 0 gives the even powers of 1 / x and erfcx's the odd ones; c_h = (4 / pi) B(3/4, 3/2).
constexpr double c_h = 1.2204156216029011;
constexpr double c_3 = 2 * 3.4960767390561597 * inv_sqrtpi * inv_sqrtpi * inv_sqrtpi;  // B(1/4, 3/2)

HeatFunctions disc_far(double x) {
  const double first = c_h * inv_sqrtpi / x, second = -1 / (x * x), third = c_3 / (x * x * x);
  return {first + second + third, 2 * first + 3 * second + 4 * third};
}

/// (1 + x) N and (1 + x) Q over ln x.
Pair scaled_disc(double log_x) {
  const double x = std::exp(log_x);
  const HeatFunctions at = disc_by_quadrature(x);
  return Pair{(1 + x) * at.n, (1 + x) * at.q};
}

}  // namespace

HeatFunctions heat_functions(Residence residence, double x) {
  if (residence == Residence::box) return box(x);
  static PiecewiseChebyshev<Pair> table(-37.25, 12.5, scaled_disc);  // below, nothing changes any more
  const double log_x = std::log(x);
  if (log_x > table.highest()) return disc_far(x);
  const Pair scaled = table(log_x) * (1 / (1 + x));
  return {scaled[0], scaled[1]};
}

namespace {

constexpr double near = 0.004;  // |q - q'| / (q + q'), where differences keep twelve digits

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
  return {x, heat_functions(residence_, x).n / x};
}

// N / x falls with the slope -Q / x^2: where x and y are near, the difference is the mean of that between them, by
// Gauss's rule of three nodes.
double HeatKernel::operator()(const Place& felt, const Place& heated) const {
  const double x = felt.x, y = heated.x, sum = x + y, apart = y - x;
  if (std::fabs(apart) > near * sum) return time_ * x * x * y * ((felt.psi - heated.psi) / (apart * sum));
  double mean = 0;
  for (const double side : {-1.0, 0.0, 1.0}) {
    const double z = sum / 2 + side * std::sqrt(0.15) * apart;
    mean += (side == 0 ? 8.0 : 5.0) / 18 * heat_functions(residence_, z).q / (z * z);
  }
  return time_ * x * x * y / sum * mean;
}

HeatKernelTable::HeatKernelTable(std::span<const double> felt, std::span<const double> heated)
    : felt_(felt.begin(), felt.end()), heated_(heated.begin(), heated.end()) {
  using Eigen::Index;
  factor_.resize(static_cast<Index>(felt.size()), static_cast<Index>(heated.size()));
  for (Index j = 0; j < factor_.cols(); ++j)
    for (Index i = 0; i < factor_.rows(); ++i) {
      const double a = felt[static_cast<std::size_t>(i)], b = heated[static_cast<std::size_t>(j)];
      const double apart = b - a, sum = a + b;
      if (std::fabs(apart) > near * sum) {
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
    const double doubled = 2 * kernel.length();
    table(i, j) = heated * kernel({doubled * q, psi_felt_[i]}, {doubled * heated, psi_heated_[j]});
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

}  // namespace asperity
