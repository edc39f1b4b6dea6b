// A word on friction that no rubber has on a rough surface: on clean glass, where the contact is whole, it reaches 2 to
// 3 (K. A. Grosch, Proc. R. Soc. A 274, 21 (1963)). More comes from inputs that do not belong together, and the larger
// part of mu = mu_H + mu_A tells which.
#include "friction/large_friction.hpp"

#include <algorithm>

#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr double largest = 4;

}  // namespace

void note_large_friction(Friction& friction) {
  const auto top = std::ranges::max_element(friction.mu);
  if (top == friction.mu.end() || !(*top > largest)) return;
  const auto i = static_cast<std::size_t>(top - friction.mu.begin());
  const double hysteresis = friction.hysteresis[i], adhesion = friction.adhesion[i];
  const bool sticks = adhesion > hysteresis;
  friction.notes.insert(
      friction.notes.begin(),
      fatal("large-friction",
            "mu reaches " + value(*top, 3) + " at " + show(friction.velocity[i], 3) + " m/s and " +
                show(friction.pressure[i], 3) + " Pa, above " + show(largest) +
                ", more than rubber has on clean glass: " + (sticks ? "adhesion" : "hysteresis") + " makes " +
                show(std::max(adhesion, hysteresis), 3) + " of it, so " +
                (sticks ? "its shear stress was found on another surface, or with another end of the spectrum"
                        : "the spectrum goes on too far, or its heights, the modulus or the pressure are in another "
                          "unit"),
            {sticks ? "fit the adhesion on this surface" : "check where the spectrum ends, and the units"}));
}

}  // namespace asperity
