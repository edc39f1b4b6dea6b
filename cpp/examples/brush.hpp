// A brush model of a braked tire: 200 bristles in the contact patch, each with a friction of its own at every step.
//
// The patch is L long under a parabolic pressure. The wheel travels at v_x and, at a slip s, rolls at (1 - s) v_x: a
// bristle comes in at the front undeflected, its root moves through the patch at the rolling velocity and over the
// road at s v_x. Its tip sticks as long as the elastic traction k u stays below mu p, and slides when it does not:
//
//   k u = mu(p, w) p
//
// with the pressure p where the bristle is, and w the velocity at which its contact has slid: a contact is a new one,
// with another mu, once it has slid about the length D of the largest asperities, for which it takes the time D / w
// (J. H. Dieterich, J. Geophys. Res. 84, 2161 (1979)). So w follows the velocity x of the tip by
//
//   dw/dt = (w / D) (x - w)
//
// Where mu falls with the velocity, by c = p |d mu / d ln v| / (k D), this leaves x (1 - c) = s v_x - c w where the
// pressure does not change: the bristle is held back from stick-slip as long as c is below 1.
//
// A bristle comes into contact cold. The distance that its tip has slid since tells how far its rubber has heated up.
#ifndef BRUSH_HPP
#define BRUSH_HPP

#include <algorithm>
#include <cstddef>
#include <vector>

namespace brush {

struct Tire {
  double length = 0.1;           // L of the contact patch [m]
  double mean_pressure = 2.5e5;  // [Pa]
  double stiffness = 1e8;        // k, traction over deflection [Pa/m]
  double renewal = 3e-3;         // D [m]
  double velocity = 10;          // v_x [m/s]
  std::size_t bristles = 200;    // a step takes the wheel on by the distance between two
};

struct SlipPoint {
  double slip;     // s [-]
  double force;    // braking force over load [-]
  double sliding;  // share of the bristles that slide [-]
};

inline double pressure_at(const Tire& tire, double x) {
  const double part = x / tire.length;
  return 6 * tire.mean_pressure * part * (1 - part);
}

/// The steady state at one slip. `friction(pressure, velocity, distance, mu)` fills in mu [-] of every bristle from its
/// pressure [Pa], its sliding velocity [m/s] and the distance that it slid since it came in [m], in one call a step.
template <class Friction>
SlipPoint roll(const Tire& tire, double slip, const Friction& friction) {
  const std::size_t n = tire.bristles;
  const double spacing = tire.length / static_cast<double>(n), step = spacing / tire.velocity;
  const double rolling = (1 - slip) * tire.velocity, slipping = slip * tire.velocity;
  std::vector<double> x(n), deflection(n, 0.0), contact(n), pressure(n), velocity(n, slipping), distance(n, 0.0), mu(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = (static_cast<double>(i) + 0.5) * spacing;

  // Two patch lengths of travel until nothing changes any more, and a third one to take the mean over.
  double force = 0, sliding = 0;
  for (std::size_t k = 0; k < 3 * n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      contact[i] = step;
      x[i] += rolling * step;
      if (x[i] >= tire.length) {  // out at the back, in at the front
        x[i] -= tire.length;
        contact[i] = x[i] / rolling;
        deflection[i] = 0;
        velocity[i] = slipping;
        distance[i] = 0;
      }
      pressure[i] = pressure_at(tire, x[i]);
    }
    friction(pressure, velocity, distance, mu);
    for (std::size_t i = 0; i < n; ++i) {
      const double stuck = deflection[i] + slipping * contact[i];
      deflection[i] = std::min(stuck, mu[i] * pressure[i] / tire.stiffness);
      const double slid = stuck - deflection[i];
      distance[i] += slid;
      const double renewed = std::min(1.0, contact[i] * velocity[i] / tire.renewal);
      if (slid > 0) velocity[i] += renewed * (slid / contact[i] - velocity[i]);
      if (k < 2 * n) continue;
      force += tire.stiffness * deflection[i];
      sliding += slid > 0;
    }
  }
  const auto points = static_cast<double>(n * n);
  return {slip, force / points / tire.mean_pressure, sliding / points};
}

inline const std::vector<double>& slips() {
  static const std::vector<double> values = {0.0025, 0.005, 0.01,  0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045, 0.05,
                                             0.055,  0.06,  0.065, 0.07,  0.08, 0.09,  0.1,  0.11,  0.12, 0.13,  0.15,
                                             0.2,    0.25,  0.3,   0.4,   0.5,  0.6,   0.7,  0.8,   0.9,  1};
  return values;
}

}  // namespace brush

#endif  // BRUSH_HPP
