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
  constexpr double part = 0.05, most = 0.5;
  if (friction.extrapolated_share.empty()) return;
  const double largest = std::ranges::max(friction.extrapolated_share);
  std::vector<std::string> notes;
  if (largest > most)
    notes.emplace_back("fatal: most of the hysteresis is that of an extrapolated modulus at some points");
  std::ranges::move(friction.notes, std::back_inserter(notes));
  if (largest > part)
    notes.push_back("more than " + show(100 * part) +
                    " % of the hysteresis comes from frequencies outside of the measured ones at some points");
  friction.notes = std::move(notes);
}

}  // namespace asperity
