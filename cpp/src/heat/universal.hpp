// The two functions of one variable that every heat kernel is made of.
#pragma once

#include "asperity/heating.hpp"

namespace asperity {

/// N(x) = int_0^1 h(w) erfcx(x sqrt w) dw and Q = N - x dN/dx, both positive.
struct HeatFunctions {
  double n, q;
};

/// At x >= 0, to about 1e-15; h is the overlap of two discs, 1 - (2 / pi) (w sqrt(1 - w^2) + asin w), or 1 for the box.
HeatFunctions heat_functions(Residence residence, double x);

/// exp(x^2) erfc(x) at x >= 0.
double scaled_erfc(double x);

}  // namespace asperity
