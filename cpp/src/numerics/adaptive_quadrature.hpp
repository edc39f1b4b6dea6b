// Adaptive integration, our own and GSL's (gsl_quadrature.cpp, the one place that knows it).
#pragma once

#include <cstddef>
#include <exception>

namespace asperity {

struct Integral {
  double value;
  double error;  // absolute, an estimate
};

/// Bisection with a Gauss rule, and GSL's adaptive routines: QAG with the 21-point Gauss-Kronrod rule, QAGS, which
/// extrapolates as well (Wynn's epsilon algorithm), and CQUAD, doubly adaptive Clenshaw-Curtis rules (Gonnet, ACM TOMS
/// 37, 26 (2010)).
enum class Adaptive { bisection, qag, qags, cquad };

namespace detail {

/// A callable that C can call: exceptions wait in `failure` until the routine has returned.
struct Callback {
  double (*call)(double x, void* self) noexcept;
  void* self;
};
/// One Gauss rule of 20 nodes.
Integral one_rule(const Callback& f, double lower, double upper);
/// Throw NotConverged where neither tolerance is reached.
Integral adaptive(const Callback& f, double lower, double upper, double atol, double rtol, Adaptive rule);
Integral by_gsl(const Callback& f, double lower, double upper, double atol, double rtol, Adaptive rule);

template <class F>
struct Guarded {
  F& f;
  std::exception_ptr failure = nullptr;
  static double call(double x, void* self) noexcept {
    auto& guarded = *static_cast<Guarded*>(self);
    if (guarded.failure) return 0;
    try {
      return guarded.f(x);
    } catch (...) {
      guarded.failure = std::current_exception();
      return 0;
    }
  }
};

template <class F, class Rule>
Integral run(F& f, Rule rule) {
  Guarded<F> guarded{f};
  const Integral result = rule(Callback{&Guarded<F>::call, &guarded});
  if (guarded.failure) std::rethrow_exception(guarded.failure);
  return result;
}

}  // namespace detail

/// int_lower^upper f(x) dx by one rule, for pieces known to be smooth.
template <class F>
Integral integrate_smooth(F&& f, double lower, double upper) {
  return detail::run(f, [&](const detail::Callback& c) { return detail::one_rule(c, lower, upper); });
}

/// int_lower^upper f(x) dx to the looser of an absolute and a relative tolerance.
template <class F>
Integral integrate(F&& f, double lower, double upper, double rtol, double atol = 0,
                   Adaptive rule = Adaptive::bisection) {
  return detail::run(f, [&](const detail::Callback& c) { return detail::adaptive(c, lower, upper, atol, rtol, rule); });
}

}  // namespace asperity
