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
/// Adds to slopes of a number over ln E_k and ln tau_k what it has through this part at each of `w`, beside each other
/// through as many of its rows as there are.
void loss_part_gradient(const PronySeries& series, std::span<const double> w, std::span<const double> by_part,
                        std::span<double> moduli, std::span<double> relaxation_times);
void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part);

/// A series without the range that it was fitted on: the parts of I1 and I2 from outside of the range cost more than I1
/// and I2 do. None where `rubber` has no such range.
inline std::optional<Rubber> unlimited(const Rubber& rubber) {
  const auto* const series = std::get_if<PronySeries>(&rubber);
  if (!series || !series->fitted_range()) return std::nullopt;
  return PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times());
}

}  // namespace asperity
