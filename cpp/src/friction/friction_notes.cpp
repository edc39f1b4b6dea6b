// Notes on friction as it is returned: on the share of the hysteresis that comes from frequencies outside of the
// measured ones, which heat moves, and on friction that no rubber has on a rough surface.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "friction/before_heating.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

void keep_each_once(std::vector<double>& values) {
  std::ranges::sort(values);
  const auto rest = std::ranges::unique(values);
  values.erase(rest.begin(), rest.end());
}

/// At which of the velocities the share is above a limit; empty where it is at none.
std::string where_above(std::span<const double> velocity, std::span<const double> share, double limit) {
  std::vector<double> above;
  for (std::size_t i = 0; i < share.size(); ++i)
    if (share[i] > limit) above.push_back(velocity[i]);
  if (above.empty()) return {};
  keep_each_once(above);
  std::vector<double> velocities(velocity.begin(), velocity.end());
  keep_each_once(velocities);
  const std::size_t all = velocities.size();
  if (above.size() == all) return "all velocities";
  const std::string first = show(above.front(), 3), last = show(above.back(), 3);
  return std::to_string(above.size()) + " of " + std::to_string(all) + " velocities, " +
         (above.size() == 1 ? first : "from " + first + " to " + last) + " m/s";
}

}  // namespace

std::vector<Diagnostic> extrapolation_notes(std::span<const double> velocity, std::span<const double> share) {
  const char* step = "measure the modulus there, at other temperatures, or leave these velocities out";
  std::vector<Diagnostic> notes;
  if (const std::string at = where_above(velocity, share, fatal_extrapolation); !at.empty())
    notes.push_back(
        fatal("modulus-extrapolated", {"most of the hysteresis is that of an extrapolated modulus at " + at}, {step}));
  if (const std::string at = where_above(velocity, share, noted_extrapolation); !at.empty())
    notes.push_back(warning("modulus-unmeasured",
                            "more than " + value(100 * noted_extrapolation) +
                                " % of the hysteresis comes from frequencies outside of the measured ones at " + at,
                            {step}));
  return notes;
}

void note_extrapolated_modulus(Friction& friction) {
  for (Diagnostic& note : extrapolation_notes(friction.velocity, friction.extrapolated_share))
    friction.notes.insert(note.severity == Severity::fatal ? friction.notes.begin() : friction.notes.end(),
                          std::move(note));
}

// On clean glass, where the contact is whole, friction reaches 2 to 3 (K. A. Grosch, Proc. R. Soc. A 274, 21 (1963)).
// More comes from inputs that do not belong together, and the larger part of mu = mu_H + mu_A tells which.

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
