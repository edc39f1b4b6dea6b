// Rubber that slides at v along x answers a pressure p exp(i q x) with u = 2 (1 - nu^2) p / (|q| conj E(v q_x)). Modes
// with q_x = 0 would stay relaxed at any speed, though they stand for waves in a band of directions about y: they get
// the mean of 1 / E over it, and dissipate as the band does.
#include "sliding/compliance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Below the frequencies that are known the storage modulus is constant and the loss proportional to frequency, as
/// in the angular integrals.
std::complex<double> continued_modulus(const Rubber& rubber, double w) {
  const auto known = known_range(rubber);
  if (!known || w >= known->lowest) return modulus(rubber, w);
  const std::complex<double> first = modulus(rubber, known->lowest);
  return {first.real(), first.imag() * (w / known->lowest)};
}

void check_range(const Rubber& rubber, double velocity, double first, double last) {
  const auto known = known_range(rubber);
  if (!known) return;
  const double slowest = known->lowest / first, fastest = known->highest / last;
  if (velocity >= slowest && velocity <= fastest) return;
  throw OutOfRange("velocity = " + show(velocity, 6) + " m/s: the waves of this map have q_x from " + show(first, 4) +
                   " to " + show(last, 4) + " 1/m, and the modulus is known from " + show(known->lowest, 4) + " to " +
                   show(known->highest, 4) + " rad/s; " +
                   (slowest <= fastest
                        ? "velocities from " + show(slowest, 4) + " to " + show(fastest, 4) + " m/s are allowed"
                        : "no velocity has all of them in this range"));
}

}  // namespace

Compliance compliance(const Rubber& rubber, double velocity, std::size_t nx, double length) {
  const double dq = 2 * pi / length;
  const std::size_t last = nx / 2;
  check_range(rubber, velocity, dq, dq * static_cast<double>(last));
  Compliance result{std::vector<std::complex<double>>(last + 1), 0};
  if (velocity == 0) {
    const std::complex<double> relaxed = modulus(rubber, 0);
    if (relaxed == 0.0) refuse("velocity", 0, "positive for a rubber whose equilibrium_modulus is 0");
    std::ranges::fill(result.column, 1.0 / relaxed.real());
    return result;
  }
  for (std::size_t k = 1; k <= last; ++k) {
    heed_at(k);
    result.column[k] = 1.0 / std::conj(modulus(rubber, velocity * dq * static_cast<double>(k)));
  }
  // on a grid of even length the shortest wave is its own mirror image
  if (nx % 2 == 0) result.column[last] = result.column[last].real();
  // (2 / dq) int_0^{dq / 2}, on panels that are halved towards 0, where a modulus may change over many decades
  const LegendreRule& rule = legendre_rule(16);
  double upper = dq / 2, storage = 0, loss = 0;
  for (int panel = 0; panel < 60; ++panel, upper /= 2)
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double q = upper / 4 * (3 + rule.node[i]), weight = upper / 4 * rule.weight[i] * 2 / dq;
      const std::complex<double> inverse = 1.0 / std::conj(continued_modulus(rubber, velocity * q));
      storage += weight * inverse.real();
      loss += weight * q * inverse.imag();
    }
  result.column[0] = storage;
  result.band_loss = loss;
  return result;
}

}  // namespace asperity
