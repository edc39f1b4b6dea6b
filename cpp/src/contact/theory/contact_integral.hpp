// F(G) = int_0^G P S(P) dG, the one function of the contact that the hysteresis needs, and F2 = int_0^G F dG.
#pragma once

#include <optional>

#include "contact/theory/s_factor.hpp"
#include "numerics/kernels.hpp"

namespace asperity {

/// F and F2 for P of one form and S of Eq. 8 or none, good to 5e-15, and to 2e-14 with gamma = 0 beyond G = 1e4.
struct ContactIntegral {
  ContactIntegral(Form form, const std::optional<SFunction>& factor);
  ContactTable table;
  double gamma;     // of S, 1 without
  double whole;     // G below which P S is 1 to rounding
  bool has_second;  // F2 of the interpolated P has a logarithm in it
};

}  // namespace asperity
