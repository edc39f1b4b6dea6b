// What the edges of contacts carry beyond the end of the spectrum, as PartialContact has it.
#pragma once

#include "asperity/rubber.hpp"

namespace asperity {

/// int I (I2 / I2(v q1))^(1/4) x^-3 d ln x for I1 and I2, x = q / q1, and the errors of them.
struct TailIntegrals {
  double i1 = 0, i2 = 0;
  double i1_outside = 0;  // part of i1 from frequencies outside of the measured range
  double i1_error = 0, i2_error = 0;
};

/// From x = `lower` to `upper`, for the frequency v q1. Beyond the frequencies that are known, I1 and I2 keep the
/// values that they have at the last of them.
TailIntegrals tail_integrals(const Rubber& rubber, double frequency, double lower, double upper, double rtol);

}  // namespace asperity
