// GSL's quadrature behind a function that throws: QAG, QAGS and CQUAD.
// R. Piessens et al., QUADPACK (1983); P. Gonnet, ACM Trans. Math. Softw. 37, 26 (2010).
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cfenv>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace detail {

namespace {

constexpr std::size_t most_intervals = 1000;

/// GSL's default handler ends the process. Ours is a private copy of GSL (its symbols are hidden), so that the
/// host's handler stays as it is; return codes are checked instead.
void silence_private_gsl() {
  static std::once_flag once;
  std::call_once(once, [] { gsl_set_error_handler_off(); });
}

/// A workspace for the time of one integral. An integrand may itself integrate: each depth has a workspace of its
/// own, kept by the thread for the next call.
template <class Workspace, Workspace* allocate(std::size_t), void release(Workspace*)>
class Borrowed {
 public:
  Borrowed() {
    if (depth_ == pool_.size()) pool_.emplace_back(allocate(most_intervals), release);
    if (!pool_[depth_]) {
      pool_.pop_back();
      throw std::bad_alloc();
    }
    mine_ = pool_[depth_++].get();
  }
  ~Borrowed() { --depth_; }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  Borrowed(Borrowed&&) = delete;
  Borrowed& operator=(Borrowed&&) = delete;
  [[nodiscard]] Workspace* get() const { return mine_; }

 private:
  static inline thread_local std::vector<std::unique_ptr<Workspace, void (*)(Workspace*)>> pool_;
  static inline thread_local std::size_t depth_ = 0;
  Workspace* mine_;
};
using Intervals = Borrowed<gsl_integration_workspace, gsl_integration_workspace_alloc, gsl_integration_workspace_free>;
using Polynomials = Borrowed<gsl_integration_cquad_workspace, gsl_integration_cquad_workspace_alloc,
                             gsl_integration_cquad_workspace_free>;

/// GSL divides by zero on its way (CQUAD), which ends a process whose host has floating-point traps on: off meanwhile.
/// The flags are left as they were found too.
class Untrapped {
 public:
  Untrapped() { std::feholdexcept(&host_); }
  ~Untrapped() { std::fesetenv(&host_); }
  Untrapped(const Untrapped&) = delete;
  Untrapped& operator=(const Untrapped&) = delete;
  Untrapped(Untrapped&&) = delete;
  Untrapped& operator=(Untrapped&&) = delete;

 private:
  std::fenv_t host_;
};

int call(Adaptive rule, const gsl_function& f, double lower, double upper, double atol, double rtol, Integral& result) {
  switch (rule) {
    case Adaptive::qag:
      return gsl_integration_qag(&f, lower, upper, atol, rtol, most_intervals, GSL_INTEG_GAUSS21, Intervals().get(),
                                 &result.value, &result.error);
    case Adaptive::qags:
      return gsl_integration_qags(&f, lower, upper, atol, rtol, most_intervals, Intervals().get(), &result.value,
                                  &result.error);
    case Adaptive::cquad:
      return gsl_integration_cquad(&f, lower, upper, atol, rtol, Polynomials().get(), &result.value, &result.error,
                                   nullptr);
    case Adaptive::bisection:
      break;
  }
  return GSL_EINVAL;
}

}  // namespace

Integral by_gsl(const Callback& f, double lower, double upper, double atol, double rtol, Adaptive rule) {
  silence_private_gsl();
  const Untrapped here;
  Integral result{};
  const int status = call(rule, gsl_function{f.call, f.self}, lower, upper, atol, rtol, result);
  const double allowed = std::fmax(atol, rtol * std::fabs(result.value));
  // CQUAD may miss the tolerance and report success, and says of what diverges that it is infinite
  if (!(result.error <= allowed && std::isfinite(result.value)))
    throw NotConverged("integral over [" + show(lower) + ", " + show(upper) + "] = " + show(result.value) +
                       " with error " + show(result.error) + " where " + show(allowed) + " was asked for" +
                       (status == GSL_SUCCESS ? "" : std::string(": ") + gsl_strerror(status)));
  return result;
}

}  // namespace detail

}  // namespace asperity
