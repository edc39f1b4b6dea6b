// A root and a minimum of functions of one variable, from a bracket.
#pragma once

#include <cmath>
#include <numbers>

#include "numerics/arguments.hpp"

namespace asperity {

/// Root of f between `a` and `b`, whose signs there differ, to rounding or `tolerance`: the Illinois form of the false
/// position, with a bisection wherever it fails to halve the bracket. (M. Dowell, P. Jarratt, BIT 11, 168 (1971).)
template <class F>
double bracketed_root(F&& f, double a, double b, double tolerance = 0) {
  double fa = f(a), fb = f(b);
  if (fa == 0) return a;
  if (fb == 0) return b;
  if (!(std::signbit(fa) != std::signbit(fb)) || std::isnan(fa) || std::isnan(fb))
    throw NotConverged("no root between " + show(a) + " and " + show(b) + ", where the function is " + show(fa) +
                       " and " + show(fb));
  for (int i = 0; i < 200; ++i) {
    const double width = std::fabs(b - a);
    if (width <= std::fmax(tolerance, 4e-16 * std::fmax(std::fabs(a), std::fabs(b)))) break;
    double c = b - fb * (b - a) / (fb - fa);
    if (i % 3 == 2 || !(std::fmin(a, b) < c && c < std::fmax(a, b))) c = a + (b - a) / 2;
    const double fc = f(c);
    if (fc == 0) return c;
    if (std::signbit(fc) != std::signbit(fb)) {
      a = b;
      fa = fb;
    } else {
      fa /= 2;
    }
    b = c;
    fb = fc;
  }
  return b;
}

/// Where f is least between `a` and `b`, to `tolerance`: the best of so many equal steps, then golden section between
/// its neighbours.
template <class F>
double least_of(F&& f, double a, double b, int steps, double tolerance) {
  const double step = (b - a) / steps;
  double best = a, least = f(a);
  for (int i = 1; i <= steps; ++i)
    if (const double at = a + step * i, value = f(at); value < least) {
      best = at;
      least = value;
    }
  a = std::fmax(a, best - step);
  b = std::fmin(b, best + step);
  constexpr double golden = std::numbers::phi - 1;
  double left = b - golden * (b - a), right = a + golden * (b - a), at_left = f(left), at_right = f(right);
  while (b - a > tolerance) {
    if (at_left < at_right) {
      b = right;
      right = left;
      at_right = at_left;
      at_left = f(left = b - golden * (b - a));
    } else {
      a = left;
      left = right;
      at_left = at_right;
      at_right = f(right = a + golden * (b - a));
    }
  }
  return (a + b) / 2;
}

}  // namespace asperity
