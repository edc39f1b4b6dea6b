// F(G) = int_0^G P S(P) dG: what the hysteresis asks of the contact, a function of G alone; and F2 = int_0^G F dG.
#pragma once

#include <optional>

#include "kernels.hpp"
#include "partial_contact.hpp"

namespace asperity {

/// F and F2 for P of one form and S of Eq. 8 or none, good to 1e-15.
struct FrontIntegral {
  FrontIntegral(Form form, const std::optional<SFunction>& factor);
  FrontTable first;
  double whole;  // G below which P S is 1 to rounding
  std::optional<FrontTable> second;  // of the exact P: the other has a logarithm in it
};

}  // namespace asperity
