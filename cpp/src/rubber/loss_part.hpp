// The part of I2 that the loss modulus has.
#pragma once

#include <span>

#include "asperity/rubber.hpp"

namespace asperity {

/// int (Im E(w cos phi))^2 cos(2 m phi) dphi [Pa^2] at each of `w`, in as many rows of m = 0, 1 and so on as there is
/// room for, and the slope of the first over ln w where there is room for it.
void loss_part(const PronySeries& series, std::span<const double> w, std::span<double> part,
               std::span<double> slope = {});
/// Adds to slopes of a number over ln E_k and ln tau_k what it has through this part at each of `w`.
void loss_part_gradient(const PronySeries& series, std::span<const double> w, std::span<const double> by_part,
                        std::span<double> moduli, std::span<double> relaxation_times);
void loss_part(const Rubber& rubber, std::span<const double> w, std::span<double> part);

}  // namespace asperity
