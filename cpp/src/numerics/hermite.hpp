// Cubic Hermite interpolation.
#pragma once

namespace asperity {

struct ValueAndSlope {
  double value, slope;
};

/// At `t` in [0, 1] of an interval `h` long: the cubic through a and b with the slopes da and db there.
inline ValueAndSlope hermite(double a, double da, double b, double db, double h, double t) {
  const double rise = b - a, square = 3 * rise - h * (2 * da + db), cube = h * (da + db) - 2 * rise;
  return {a + t * (h * da + t * (square + t * cube)), (h * da + t * (2 * square + 3 * t * cube)) / h};
}

}  // namespace asperity
