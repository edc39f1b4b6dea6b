// Which rows of a measured spectrum can be trusted.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "asperity/spectrum.hpp"

namespace asperity {

/// Limits that follow from the scan and the window.
struct Reliability {
  double lowest;   // [1/m]: rows below hold too few periods of the window's
  double highest;  // [1/m]: rows above are aliased
  double fewest;   // modes: fewer make a mean that is uncertain by more than a quarter

  /// `length` and `pixel` [m] of the shorter side and the coarser pixel. A mean of |h|^2 over n modes, every other one
  /// a mirror image, has the relative standard error sqrt(2 f / n), f the window's variance factor.
  Reliability(Window window, double length, double pixel, double variance_factor)
      : lowest(2 * std::numbers::pi / length *
               (window == Window::none   ? 0
                : window == Window::hann ? 10
                                         : 16)),
        highest(std::numbers::pi / pixel / 2),
        fewest(32 * variance_factor) {}

  [[nodiscard]] std::uint8_t flag(double wavenumber, double modes) const {
    constexpr double rounding = 1e-9;  // exactly 16 periods are 16 periods
    int bits = 0;
    if (wavenumber < lowest * (1 - rounding)) bits |= few_periods;
    if (wavenumber > highest * (1 + rounding)) bits |= near_nyquist;
    if (modes < fewest) bits |= few_modes;
    return static_cast<std::uint8_t>(bits);
  }
};

}  // namespace asperity
