// The part of I2 that the loss modulus has, and a rubber of which no one asks what was measured.
#pragma once

#include <optional>
#include <span>

#include "asperity/rubber.hpp"

namespace asperity {

/// Beyond it nothing changes with x = w tau any more; its square is a double.
inline constexpr double largest_x = 1e140;

/// int (Im E(w cos phi))^2 cos(2 m phi) dphi [Pa^2] at each of `w`, in as many rows of m = 0, 1 and so on as there is
/// room for, and the slope of the first over ln w where there is room for it.
void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part,
               std::span<double> slope = {});
void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part);

/// A series without the range that it was fitted on: the parts of I1 and I2 from outside of the range cost more than I1
/// and I2 do. None where `rubber` has no such range.
inline std::optional<Rubber> unlimited(const Rubber& rubber) {
  const auto* const series = std::get_if<PronySeries>(&rubber);
  if (!series || !series->fitted_range()) return std::nullopt;
  return PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times());
}

}  // namespace asperity
