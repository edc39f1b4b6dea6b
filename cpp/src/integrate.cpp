#include "integrate.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>
#include <mutex>

#include "checks.hpp"

namespace asperity {

const GaussRule& gauss_rule() {
  static const GaussRule rule = [] {
    GaussRule r{};
    gsl_integration_glfixed_table* const table = gsl_integration_glfixed_table_alloc(GaussRule::size);
    for (std::size_t i = 0; i < GaussRule::size; ++i)
      gsl_integration_glfixed_point(-1, 1, i, &r.node[i], &r.weight[i], table);
    gsl_integration_glfixed_table_free(table);
    return r;
  }();
  return rule;
}

namespace detail {

namespace {

constexpr std::size_t max_intervals = 1000;

/// GSL's default handler ends the process. Ours is a private copy of GSL (its symbols are hidden), so that the
/// host's handler stays as it is; return codes are checked instead.
void silence_private_gsl() {
  static std::once_flag once;
  std::call_once(once, [] { gsl_set_error_handler_off(); });
}

using Workspace = std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)>;

gsl_integration_workspace* workspace() {
  thread_local const Workspace mine{gsl_integration_workspace_alloc(max_intervals), &gsl_integration_workspace_free};
  return mine.get();
}

}  // namespace

Integral kronrod(const Callback& f, double lower, double upper) {
  gsl_function function{f.call, f.self};
  Integral result{};
  double about_mean = 0;
  gsl_integration_qk21(&function, lower, upper, &result.value, &result.error, &result.magnitude, &about_mean);
  return result;
}

Integral adaptive(const Callback& f, double lower, double upper, double atol, double rtol) {
  silence_private_gsl();
  gsl_function function{f.call, f.self};
  Integral result{};
  const int status = gsl_integration_qag(&function, lower, upper, atol, rtol, max_intervals, GSL_INTEG_GAUSS21,
                                         workspace(), &result.value, &result.error);
  const double allowed = std::fmax(atol, rtol * std::fabs(result.value));
  if (status != GSL_SUCCESS && !(result.error <= allowed))
    throw NotConverged("integral over [" + show(lower) + ", " + show(upper) + "] = " + show(result.value) +
                       " with error " + show(result.error) + " where " + show(allowed) +
                       " was asked for: " + gsl_strerror(status));
  return result;
}

}  // namespace detail
}  // namespace asperity
