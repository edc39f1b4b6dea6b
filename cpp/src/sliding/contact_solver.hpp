// The contact of one map on one grid, in units without dimensions, and the compliance of sliding rubber for it.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "asperity/rubber.hpp"
#include "asperity/sliding.hpp"
#include "numerics/fft.hpp"

namespace asperity {

/// p >= 0, gap = K p - h - delta >= 0, p gap = 0, <p> = load, with K_q = modes(q) / |q|, K_0 = 0, and q in radians a
/// pixel along x.
struct ContactProblem {
  Grid shape;
  double aspect;                            // dx / dy
  Eigen::ArrayXd heights;                   // h, of mean 0 and rms 1
  std::vector<std::complex<double>> modes;  // ny x (nx / 2 + 1), |.| <= 1
  double load;
};

struct ContactSolution {
  Eigen::ArrayXd pressure;  // p >= 0, <p> = load
  Eigen::ArrayXd gap;       // >= 0
  double error;             // <p gap> / load
  int steps;
  bool converged;
};

/// When an iteration gives up, and who is told its steps.
struct Course {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  const std::function<void(const SlidingStep&)>& progress;
};

/// From the pressure `start`, of any scale; none: equal everywhere.
ContactSolution solve_contact(const ContactProblem& problem, Eigen::ArrayXd start, double rtol, const Course& course);

/// The pressure that makes contact everywhere, where it has no tension.
std::optional<Eigen::ArrayXd> complete_contact(const ContactProblem& problem);

/// E of the waves of a map.
struct WaveModulus {
  /// At a wavenumber [1/m] and an angular frequency [rad/s], 0 or more.
  std::function<std::complex<double>(double wavenumber, double angular_frequency)> at;
  bool by_wavenumber = false;  // whether it depends on the wavenumber
};

/// The modulus, beyond the frequencies that are known too: below them the storage modulus is constant and the loss
/// proportional to frequency, as in the angular integrals; above them both keep their last values.
WaveModulus continued_modulus(const Rubber& rubber);

/// A grid of points on the sides of a map [m].
struct Sides {
  Grid points;  // ny, nx
  double y, x;
};

/// Of the modes k_y, k_x of a real grid, ny x (nx / 2 + 1).
struct Compliance {
  std::vector<std::complex<double>> modes;  // 1 / conj E(v q.s) [1/Pa]
  std::vector<double> loss;                 // q.s Im 1 / conj E(v q.s) [1/(m Pa)]
};

/// At `velocity` [m/s] in the direction s, an angle from x towards y [rad]. A mode stands for a cell of wavevectors:
/// where some of those run along the way and others against it, it has their mean.
Compliance compliance(const WaveModulus& modulus, double velocity, double direction, const Sides& sides);

}  // namespace asperity
