// GSL's quadrature behind a function that throws: QAG, QAGS and CQUAD.
// R. Piessens et al., QUADPACK (1983); P. Gonnet, ACM Trans. Math. Softw. 37, 26 (2010).
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cfenv>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <string>

#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

/// GSL's default handler ends the process. Ours is a private copy of GSL (its symbols are hidden), so that the
/// host's handler stays as it is; return codes are checked instead.
void silence_private_gsl() {
  static std::once_flag once;
  std::call_once(once, [] { gsl_set_error_handler_off(); });
}

/// A workspace for the time of one integral: an integrand may itself integrate.
template <class Workspace>
std::unique_ptr<Workspace, void (*)(Workspace*)> made(Workspace* allocate(std::size_t), void release(Workspace*)) {
  std::unique_ptr<Workspace, void (*)(Workspace*)> result(allocate(most_parts), release);
  if (!result) throw std::bad_alloc();
  return result;
}

/// What C calls: an exception waits until GSL has returned.
struct Guarded {
  const Integrand& f;
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

/// GSL divides by zero on its way (CQUAD), which ends a process whose host has floating-point traps on: off meanwhile.
/// The flags are left as they were found too.
class Untrapped {
 public:
  Untrapped() { std::feholdexcept(&host_); }
  ~Untrapped() { std::fesetenv(&host_); }
  Untrapped(const Untrapped&) = delete;
  Untrapped& operator=(const Untrapped&) = delete;

 private:
  std::fenv_t host_;
};

int call(Adaptive rule, const gsl_function& f, double lower, double upper, double rtol, double atol, Integral& result) {
  if (rule == Adaptive::cquad)
    return gsl_integration_cquad(
        &f, lower, upper, atol, rtol,
        made(&gsl_integration_cquad_workspace_alloc, &gsl_integration_cquad_workspace_free).get(), &result.value,
        &result.error, nullptr);
  const auto intervals = made(&gsl_integration_workspace_alloc, &gsl_integration_workspace_free);
  if (rule == Adaptive::qags)
    return gsl_integration_qags(&f, lower, upper, atol, rtol, most_parts, intervals.get(), &result.value,
                                &result.error);
  return gsl_integration_qag(&f, lower, upper, atol, rtol, most_parts, GSL_INTEG_GAUSS21, intervals.get(),
                             &result.value, &result.error);
}

}  // namespace

Integral integrate_by_gsl(const Integrand& f, double lower, double upper, double rtol, double atol, Adaptive rule) {
  silence_private_gsl();
  const Untrapped here;
  Integral result{};
  Guarded guarded{f};
  const int status = call(rule, gsl_function{&Guarded::call, &guarded}, lower, upper, rtol, atol, result);
  if (guarded.failure) std::rethrow_exception(guarded.failure);
  const double allowed = std::fmax(atol, rtol * std::fabs(result.value));
  // CQUAD may miss the tolerance and report success, and says of what diverges that it is infinite
  if (!(result.error <= allowed && std::isfinite(result.value)))
    throw NotConverged("integral over [" + show(lower) + ", " + show(upper) + "] = " + show(result.value) +
                       " with error " + show(result.error) + " where " + show(allowed) + " was asked for" +
                       (status == GSL_SUCCESS ? "" : std::string(": ") + gsl_strerror(status)));
  return result;
}

}  // namespace asperity
