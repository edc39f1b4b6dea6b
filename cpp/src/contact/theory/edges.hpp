// What the edges of contacts carry beyond the end of the roughness, as PartialContact has it.
#pragma once

#include <optional>

#include "asperity/rubber.hpp"

namespace asperity {

/// int I (I2 / I2(v q_e))^(1/4) x^-3 d ln x for I1 and I2, x = q / q_e, and the errors of them.
struct EdgeIntegrals {
  double i1 = 0, i2 = 0;
  double i1_outside = 0;  // part of i1 from frequencies outside of the measured range, to a hundredth
  double i1_error = 0, i2_error = 0;
  double i2_at_end = 0;  // I2(v q_e)
};

/// Of one rubber. Beyond the frequencies that are known, I1 and I2 keep the values that they have at the last of them.
class Edges {
 public:
  Edges(const Rubber& rubber, double rtol);
  /// For the frequency v q_e, from x = `lower` to `upper`.
  [[nodiscard]] EdgeIntegrals operator()(double frequency, double lower, double upper) const;

 private:
  [[nodiscard]] double outside(double frequency, double lower, double upper, double i2_at_end) const;

  const Rubber& rubber_;
  std::optional<Rubber> unlimited_;  // for all but the parts from outside
  bool limited_;
  double highest_, rtol_;
};

}  // namespace asperity
