// The compliance of sliding rubber, mode by mode.
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "asperity/rubber.hpp"
#include "numerics/fft.hpp"

namespace asperity {

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
