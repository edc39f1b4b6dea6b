// Rubber that slides at v along s answers a pressure p exp(i q x) with u = 2 (1 - nu^2) p / (|q| conj E(v q.s)). Modes
// across the way, q.s = 0, would stay relaxed at any speed, though they stand for a cell of wavevectors, 2 pi / L wide:
// they get the mean of 1 / E over it, and dissipate as the cell does.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/rounding.hpp"
#include "rubber/loss_part.hpp"
#include "sliding/contact_solver.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

struct Response {
  std::complex<double> inverse;  // 1 / conj E
  double loss;                   // q.s times its imaginary part
};

/// How the q.s of a cell are distributed about that of its mode: the sum of two even distributions, along x and y.
class CellDensity {
 public:
  CellDensity(double half_x, double half_y) : wide_(std::max(half_x, half_y)), narrow_(std::min(half_x, half_y)) {}
  [[nodiscard]] double half_width() const { return wide_ + narrow_; }
  [[nodiscard]] double operator()(double t) const {
    const double from_edge = half_width() - std::fabs(t);
    if (!(from_edge >= 0)) return 0;
    const double flat = 1 / (2 * wide_);
    return narrow_ > 0 ? flat * std::min(1.0, from_edge / (2 * narrow_)) : flat;
  }

 private:
  double wide_, narrow_;
};

/// The mean over a cell about `middle`, on panels that are halved towards 0, where a modulus may change over decades.
template <class Inverse>
Response mean_over_cell(const CellDensity& density, double middle, const Inverse& inverse) {
  const LegendreRule& rule = legendre_rule(16);
  Response mean{0, 0};
  double weight = 0, upper = std::fabs(middle) + density.half_width();
  for (int panel = 0; panel < 60; ++panel, upper /= 2)
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double t = upper / 4 * (3 + rule.node[i]), w = upper / 4 * rule.weight[i];
      const double along = w * density(t - middle), against = w * density(-t - middle);
      if (along + against == 0) continue;
      const std::complex<double> value = inverse(t);
      mean.inverse += along * value + against * std::conj(value);
      mean.loss += (along + against) * t * value.imag();
      weight += along + against;
    }
  return {mean.inverse / weight, mean.loss / weight};
}

}  // namespace

WaveModulus continued_modulus(const Rubber& rubber) {
  const auto at = [known = known_range(rubber), free = unlimited(rubber).value_or(rubber)](double, double w) {
    if (!known) return modulus(free, w);
    if (w >= known->lowest) return modulus(free, std::min(w, known->highest));
    const std::complex<double> first = modulus(free, known->lowest);
    return std::complex(first.real(), first.imag() * (w / known->lowest));
  };
  return {at};
}

Compliance compliance(const WaveModulus& modulus, double velocity, double direction, const Sides& sides) {
  const auto [ny, nx] = sides.points;
  const std::size_t half = nx / 2 + 1;
  const double step_x = 2 * pi / sides.x, step_y = 2 * pi / sides.y;
  const double cosine = std::cos(direction), sine = direction == 0 ? 0 : std::sin(direction);
  const CellDensity cell(step_x / 2 * std::fabs(cosine), step_y / 2 * std::fabs(sine));
  const auto across = [&](double along) { return is_below(std::fabs(along), cell.half_width()); };
  const auto response = [&](double q, double along) -> Response {
    const auto inverse = [&](double t) { return 1.0 / std::conj(modulus.at(q, velocity * t)); };
    if (across(along)) return mean_over_cell(cell, along, inverse);
    const std::complex<double> value = inverse(std::fabs(along));
    return {along > 0 ? value : std::conj(value), std::fabs(along) * value.imag()};
  };

  Compliance result{std::vector<std::complex<double>>(ny * half), std::vector<double>(ny * half)};
  if (velocity == 0) {
    const std::complex<double> relaxed = modulus.at(0, 0);
    if (relaxed == 0.0) refuse("velocity", 0, "positive for a rubber whose equilibrium_modulus is 0");
    std::ranges::fill(result.modes, 1.0 / relaxed.real());
    return result;
  }
  const bool by_column = direction == 0 && !modulus.by_wavenumber;
  for (std::size_t y = 0; y < ny; ++y) {
    heed();
    const double qy = step_y * (2 * y <= ny ? static_cast<double>(y) : -static_cast<double>(ny - y));
    for (std::size_t x = 0; x < half; ++x) {
      const std::size_t i = y * half + x;
      if (by_column && y > 0) {
        result.modes[i] = result.modes[x];
        result.loss[i] = result.loss[x];
        continue;
      }
      const double qx = step_x * static_cast<double>(x), q = std::hypot(qx, qy);
      const double along = qx * cosine + qy * sine;
      Response here = response(q, along);
      if (2 * x == nx || (2 * y == ny && sine != 0)) {  // a shortest wave of an even grid is its own mirror image
        const double mirrored = (2 * x == nx ? -qx : qx) * cosine + (2 * y == ny ? -qy : qy) * sine;
        const Response other = response(q, mirrored);
        here.inverse = (here.inverse + other.inverse) / 2.0;
        here.loss = across(along) ? (here.loss + other.loss) / 2 : (along + mirrored) / 2 * here.inverse.imag();
      }
      result.modes[i] = here.inverse;
      result.loss[i] = here.loss;
    }
  }
  return result;
}

}  // namespace asperity
