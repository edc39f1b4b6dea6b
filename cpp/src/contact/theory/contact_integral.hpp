// F(G) = int_0^G P S(P) dG, the one function of the contact that the hysteresis needs.
#pragma once

#include <optional>

#include "contact/theory/s_factor.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

/// F for P of one form and S of Eq. 8 or none, good to 5e-15, and to 2e-14 with gamma = 0 beyond G = 1e4.
struct ContactIntegral {
  ContactIntegral(Form form, const std::optional<SFunction>& factor);
  ContactTable table;
  double gamma;  // of S, 1 without
  double whole;  // G below which P S is 1 to rounding
};

}  // namespace asperity
