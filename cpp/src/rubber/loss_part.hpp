// The part of I2 that the loss modulus has.
#pragma once

#include <span>

#include "asperity/rubber.hpp"

namespace asperity {

/// int (Im E(w cos phi))^2 dphi [Pa^2] at each of `w`, and its slope over ln w where there is room for it.
void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part,
               std::span<double> slope = {});
void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part);

}  // namespace asperity
