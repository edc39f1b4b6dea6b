// Notes on the share of the hysteresis that comes from frequencies outside of the measured ones, of the friction that
// is returned: heat moves it.
#include "friction/extrapolated_modulus.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "numerics/arguments.hpp"

namespace asperity {

void note_extrapolated_modulus(Friction& friction) {
  if (friction.extrapolated_share.empty()) return;
  const double largest = std::ranges::max(friction.extrapolated_share);
  std::vector<std::string> notes;
  if (largest > fatal_extrapolation)
    notes.emplace_back("fatal: most of the hysteresis is that of an extrapolated modulus at some points");
  std::ranges::move(friction.notes, std::back_inserter(notes));
  if (largest > noted_extrapolation)
    notes.push_back("more than " + show(100 * noted_extrapolation) +
                    " % of the hysteresis comes from frequencies outside of the measured ones at some points");
  friction.notes = std::move(notes);
}

}  // namespace asperity
