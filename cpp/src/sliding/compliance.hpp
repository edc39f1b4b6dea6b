// The compliance of sliding rubber, by wavenumber along the way.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "asperity/rubber.hpp"

namespace asperity {

struct Compliance {
  std::vector<std::complex<double>> column;  // 1 / conj E(v q_x) at q_x = 2 pi k / L, k = 0 .. nx / 2 [1/Pa]
  double band_loss;                          // mean of q_x Im 1/conj E over the band of q_x = 0 [1/(m Pa)]
};

/// At `velocity` [m/s] on a grid of nx points on a length of L [m]. The modes with q_x = 0 stand for a band of that
/// width, -pi / L to pi / L, and have its mean.
Compliance compliance(const Rubber& rubber, double velocity, std::size_t nx, double length);

}  // namespace asperity
