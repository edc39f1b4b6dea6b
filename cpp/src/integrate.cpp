#include "integrate.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "checks.hpp"

namespace asperity {

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

/// A workspace for the time of one integral. An integrand may itself integrate: each depth has a workspace of its
/// own, kept by the thread for the next call.
class Borrowed {
 public:
  Borrowed() {
    if (depth_ == pool_.size())
      pool_.emplace_back(gsl_integration_workspace_alloc(max_intervals), &gsl_integration_workspace_free);
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
  [[nodiscard]] gsl_integration_workspace* get() const { return mine_; }

 private:
  static thread_local std::vector<Workspace> pool_;
  static thread_local std::size_t depth_;
  gsl_integration_workspace* mine_;
};
thread_local std::vector<Workspace> Borrowed::pool_;
thread_local std::size_t Borrowed::depth_ = 0;

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
  const Borrowed workspace;
  const int status = gsl_integration_qag(&function, lower, upper, atol, rtol, max_intervals, GSL_INTEG_GAUSS21,
                                         workspace.get(), &result.value, &result.error);
  const double allowed = std::fmax(atol, rtol * std::fabs(result.value));
  if (status != GSL_SUCCESS && !(result.error <= allowed))
    throw NotConverged("integral over [" + show(lower) + ", " + show(upper) + "] = " + show(result.value) +
                       " with error " + show(result.error) + " where " + show(allowed) +
                       " was asked for: " + gsl_strerror(status));
  return result;
}

}  // namespace detail

const GaussRule& gauss_rule() {
  static const GaussRule rule = [] {
    detail::silence_private_gsl();
    GaussRule r{};
    gsl_integration_glfixed_table* const table = gsl_integration_glfixed_table_alloc(GaussRule::size);
    if (!table) throw std::bad_alloc();
    for (std::size_t i = 0; i < GaussRule::size; ++i)
      gsl_integration_glfixed_point(-1, 1, i, &r.node[i], &r.weight[i], table);
    gsl_integration_glfixed_table_free(table);
    return r;
  }();
  return rule;
}

}  // namespace asperity
