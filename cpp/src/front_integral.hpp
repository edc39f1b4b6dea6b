// F(G) = int_0^G P S(P) dG: what the hysteresis asks of the contact, a function of G alone.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "partial_contact.hpp"

namespace asperity {

/// F for P of one form and S of Eq. 8 or none. With z = sqrt(G), y = z / (1 + z), F = z y U1(y) for S = 1 and
/// y^2 U3(y) for S = P^2, U smooth on [0, 1]: both are kept as polynomials on equal steps of y, good to 1e-15.
class FrontIntegral {
 public:
  FrontIntegral(Form form, const std::optional<SFunction>& factor);
  [[nodiscard]] double operator()(double g) const;

  static constexpr std::size_t steps = 128, terms = 8;
  using Table = std::array<std::array<double, terms>, steps>;

 private:
  Table mixed_;         // gamma U1 + (1 - gamma) (1 - y) U3
  const Table* cubic_;  // U3 where gamma is 0: it is not to drown in the rounding of U1
};

}  // namespace asperity
