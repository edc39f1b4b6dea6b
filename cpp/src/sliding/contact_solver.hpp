// The contact of one map on one grid, in units without dimensions.
#pragma once

#include <chrono>
#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "asperity/sliding.hpp"
#include "numerics/fft.hpp"

namespace asperity {

/// p >= 0, gap = K p - h - delta >= 0, p gap = 0, <p> = load, with K_q = modes(q) / |q|, K_0 = 0, and q in radians a
/// pixel along x.
struct ContactProblem {
  Grid shape;
  double aspect;                            // dx / dy
  std::vector<double> heights;              // h, of mean 0 and rms 1
  std::vector<std::complex<double>> modes;  // ny x (nx / 2 + 1), |.| <= 1
  double load;
};

struct ContactSolution {
  std::vector<double> pressure;  // p >= 0, <p> = load
  std::vector<double> gap;       // >= 0
  double error;                  // <p gap> / load
  int steps;
  bool converged;
};

/// When an iteration gives up, and who is told its steps.
struct Course {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  const std::function<void(const SlidingStep&)>& progress;
};

/// From the pressure `start`, of any scale; none: equal everywhere.
ContactSolution solve_contact(const ContactProblem& problem, std::vector<double> start, double rtol,
                              const Course& course);

/// Where the pressure that makes contact everywhere has no tension, this pressure; otherwise empty.
std::vector<double> complete_contact(const ContactProblem& problem);

}  // namespace asperity
