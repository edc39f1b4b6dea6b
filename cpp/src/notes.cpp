#include "notes.hpp"

#include "checks.hpp"

namespace asperity {

namespace {

// Lorenz et al., the article's Ref. [37]: the spectrum is cut where the rms slope reaches it.
constexpr double slope_limit = 1.3;
// B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006): local heating lowers the friction above 0.01 m/s.
constexpr double flash_velocity = 0.01;  // [m/s]
// THEORY: beyond it the contact area stops falling with the load.
constexpr double separation_limit = 3;  // d~ / h_rms

}  // namespace

void Notes::add(const Shift& shift, double velocity) {
  fast_ |= velocity > flash_velocity;
  full_ |= shift.state == ContactState::full;
  no_contact_ |= shift.state == ContactState::no_contact;
  far_ |= shift.state == ContactState::partial && shift.separation_over_rms > separation_limit;
}

// One sentence a kind of trouble, the same for any number of points: notes on parts of a sweep join as a set.
std::vector<std::string> Notes::texts() const {
  std::vector<std::string> result;
  // a spectrum cut by the rule itself ends at the limit to rounding
  if (rms_slope_ > slope_limit * (1 + 1e-9))
    result.push_back("the rms slope is " + show(rms_slope_, 4) +
                     ", above 1.3, where the cut-off rule ends the spectrum: see cutoff_for_slope");
  if (fast_)
    result.emplace_back(
        "above 0.01 m/s flash heating, which is not modelled, lowers the friction (Persson 2006, J. Phys.: Condens. "
        "Matter 18, 7789)");
  if (full_)
    result.emplace_back(
        "Greenwood-Williamson: full conformity where shift_factor is 1, the separation is below the lowest point "
        "z_min");
  if (far_)
    result.emplace_back(
        "Greenwood-Williamson has left its range at some points, where the separation is above 3 rms heights: the area "
        "there does not fall with the load as it must");
  if (no_contact_)
    result.emplace_back(
        "Greenwood-Williamson: no contact where shift_factor is infinite, the separation is above the highest point "
        "z_max; area and mu are 0 there");
  return result;
}

}  // namespace asperity
