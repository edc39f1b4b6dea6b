#include "fourier.hpp"

#include <fftw3.h>

#include <memory>
#include <mutex>
#include <type_traits>

#include "checks.hpp"

namespace asperity {

namespace {

/// FFTW's planner is not thread-safe, execution is. The copy of FFTW in here is private (its symbols are
/// hidden), so that this lock covers every use of it and the host's own FFTW is left alone.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

struct DestroyPlan {
  void operator()(fftw_plan plan) const {
    const std::lock_guard lock(planner());
    fftw_destroy_plan(plan);
  }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

int side(std::size_t n) {
  if (n > 1u << 30) throw InvalidInput("shape: a side of " + std::to_string(n) + " points: must be at most 2^30");
  return static_cast<int>(n);
}

fftw_complex* raw(std::vector<std::complex<double>>& modes) { return reinterpret_cast<fftw_complex*>(modes.data()); }

template <class Make>
void plan_and_execute(Make make) {
  Plan plan;
  {
    const std::lock_guard lock(planner());
    plan.reset(make());
  }
  if (!plan) throw Error("FFTW could not plan this transform");
  fftw_execute(plan.get());
}

}  // namespace

std::vector<std::complex<double>> forward_transform(std::vector<double>& heights, Grid shape) {
  std::vector<std::complex<double>> modes(shape[0] * (shape[1] / 2 + 1));
  const int ny = side(shape[0]), nx = side(shape[1]);
  plan_and_execute([&] { return fftw_plan_dft_r2c_2d(ny, nx, heights.data(), raw(modes), FFTW_ESTIMATE); });
  return modes;
}

std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape) {
  std::vector<double> heights(shape[0] * shape[1]);
  const int ny = side(shape[0]), nx = side(shape[1]);
  plan_and_execute([&] { return fftw_plan_dft_c2r_2d(ny, nx, raw(modes), heights.data(), FFTW_ESTIMATE); });
  return heights;
}

}  // namespace asperity
