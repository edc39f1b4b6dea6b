// Adaptive integration, our own and GSL's (gsl_quadrature.cpp, the one place that knows it).
#pragma once

#include <cstddef>
#include <functional>

namespace asperity {

struct Integral {
  double value;
  double error;  // absolute, an estimate
};

inline constexpr std::size_t most_parts = 1000;  // of an interval, before an integral is given up

using Integrand = std::function<double(double)>;

/// Bisection with a Gauss rule, and GSL's adaptive routines: QAG with the 21-point Gauss-Kronrod rule, QAGS, which
/// extrapolates as well (Wynn's epsilon algorithm), and CQUAD, doubly adaptive Clenshaw-Curtis rules (Gonnet, ACM TOMS
/// 37, 26 (2010)).
enum class Adaptive { bisection, qag, qags, cquad };

/// int_lower^upper f(x) dx by one Gauss rule of 20 nodes, for pieces known to be smooth.
Integral integrate_smooth(const Integrand& f, double lower, double upper);

/// int_lower^upper f(x) dx to the looser of an absolute and a relative tolerance; NotConverged where neither is
/// reached.
Integral integrate(const Integrand& f, double lower, double upper, double rtol, double atol = 0,
                   Adaptive rule = Adaptive::bisection);

Integral integrate_by_gsl(const Integrand& f, double lower, double upper, double rtol, double atol, Adaptive rule);

}  // namespace asperity
