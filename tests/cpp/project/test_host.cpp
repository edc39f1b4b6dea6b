// A host with a GSL error handler, FFTW plans, a locale, a rounding mode, traps and signal handlers of its own calls
// from sixteen threads: all of it stays, nothing is printed, nothing leaks, and the bits are those of one thread.
#include <doctest/doctest.h>
#include <fftw3.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <malloc.h>
#include <unistd.h>

#include <cfenv>
#include <clocale>
#include <cmath>
#include <complex>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <limits>
#include <locale>
#include <string>
#include <thread>
#include <vector>

#include "asperity/dma.hpp"
#include "asperity/friction.hpp"
#ifndef ASPERITY_SHARED
#include "numerics/adaptive_quadrature.hpp"
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // whose header not every compiler brings
#endif

using namespace asperity;

namespace {

constexpr std::size_t many = 16;

// An arena that malloc opens for threads that wait for another counts as 2 kB in use, and is no leak.
[[maybe_unused]] const int one_arena = mallopt(M_ARENA_MAX, 1);

const SelfAffineSpectrum road{.rms_height = 50e-6, .hurst = 0.87, .q0 = 2000, .q1 = 1e5};
const PronySeries series(2e6, {1e9, 1e8, 1e7}, {1e-8, 1e-6, 1e-4});

/// One of every kind of call, refusals among them; what they computed, one after the other.
std::vector<double> one_of_each() {
  std::vector<double> bits;
  const auto keep = [&](const std::vector<double>& values) { bits.insert(bits.end(), values.begin(), values.end()); };
  const double velocity[] = {1e-3, 0.1};
  for (const Method method : {Method::gauss, Method::qag, Method::qags, Method::cquad}) {
    Conditions at{.pressure = 1e5, .correction = NayakSFactor{}, .adhesion = Adhesion{.shear_stress = 5e6}};
    at.method = method;
    const Friction found = friction(road, series, at, velocity);
    keep(found.mu);
    keep(found.error_estimate);
  }
  const HeightMap map = synthesize(road, {48, 40}, {3e-5, 3e-5}, 5);
  keep(power_spectrum(map).density());
  keep(map.detrend(Detrend::quadratic).local_peaks(1e-4));
  std::vector<double> w, storage, loss;
  for (double x = -1; x < 9; x += 0.25) {
    w.push_back(std::pow(10, x));
    storage.push_back(series.modulus(w.back()).real());
    loss.push_back(series.modulus(w.back()).imag());
  }
  keep(fit_prony(w, storage, loss).series.moduli());
  keep(friction(road, MasterCurve(w, storage, loss), {.pressure = 1e5}, velocity).mu);
  try {
    (void)friction(road, series, {.pressure = -1234.5}, velocity);
  } catch (const InvalidInput& error) {
    for (const char c : std::string(error.what())) bits.push_back(c);
  }
  return bits;
}

/// The same from sixteen threads that start together, one of each a thread.
std::vector<std::vector<double>> together() {
  std::vector<std::vector<double>> result(many);
  std::latch start(many);
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < many; ++i)
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      result[i] = one_of_each();
    });
  threads.clear();
  return result;
}

int handler_calls = 0;
void host_handler(const char*, const char*, int, int) { ++handler_calls; }

/// Makes GSL, the host's, fail.
void fail_at_gsl() {
  gsl_integration_workspace* const workspace = gsl_integration_workspace_alloc(2);
  gsl_function steep{[](double x, void*) { return std::sin(1 / x); }, nullptr};
  double value = 0, error = 0;
  gsl_integration_qag(&steep, 1e-9, 1, 0, 1e-12, 2, GSL_INTEG_GAUSS15, workspace, &value, &error);
  gsl_integration_workspace_free(workspace);
}

std::string wisdom() {
  char* const text = fftw_export_wisdom_to_string();
  std::string result(text);
  std::free(text);  // NOLINT: FFTW's own way
  return result;
}

/// The bytes that are in use.
std::size_t live_bytes() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return __sanitizer_get_current_allocated_bytes();
#else
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd;
#endif
}

/// What is written to standard output and error, by whomever, while it lives.
class Captured {
 public:
  Captured() {
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
      kept_[i] = dup(i + 1);
      dup2(fileno(file_), i + 1);
    }
  }
  long stop() {
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
      dup2(kept_[i], i + 1);
      close(kept_[i]);
    }
    std::fseek(file_, 0, SEEK_END);
    const long size = std::ftell(file_);
    std::fclose(file_);
    return size;
  }

 private:
  std::FILE* file_ = std::tmpfile();
  int kept_[2];
};

/// Sets a locale of C with a decimal comma, which is made where none is installed.
bool comma_locale() {
  if (std::setlocale(LC_ALL, "de_DE.UTF-8")) return true;
  char folder[] = "/tmp/asperity_locale_XXXXXX";
  if (!mkdtemp(folder)) return false;
  const std::string name = std::string(folder) + "/de_DE.UTF-8";
  const bool made = std::system(("localedef -i de_DE -f UTF-8 " + name + " 2>/dev/null").c_str()) == 0;
  setenv("LOCPATH", folder, 1);
  const bool set = made && std::setlocale(LC_ALL, "de_DE.UTF-8");
  std::filesystem::remove_all(folder);
  return set;
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("sixteen threads get the bits of one") {
  const std::vector<double> alone = one_of_each();
  CHECK(alone.size() > 100);
  for (const std::vector<double>& each : together()) CHECK(each == alone);
}

TEST_CASE("the host's GSL error handler stays and is not called") {
  gsl_error_handler_t* const before = gsl_set_error_handler(&host_handler);
  (void)together();
#ifndef ASPERITY_SHARED                                        // which does not show what is internal
  for (const Adaptive rule : {Adaptive::qag, Adaptive::qags})  // here GSL, ours, calls the handler that it has
    CHECK_THROWS_AS((void)integrate([](double x) { return 1 / x; }, 0, 1, 1e-9, 0, rule), NotConverged);
#endif
  CHECK(handler_calls == 0);
  fail_at_gsl();
  CHECK(handler_calls == 1);
  CHECK((gsl_set_error_handler(before) == &host_handler));
}

TEST_CASE("the host's FFTW: plans, wisdom and number of threads stay") {
  fftw_init_threads();
  fftw_plan_with_nthreads(2);
  constexpr int n = 360;
  std::vector<std::complex<double>> in(n * n), out(n * n);
  auto* const raw_in = reinterpret_cast<fftw_complex*>(in.data());
  auto* const raw_out = reinterpret_cast<fftw_complex*>(out.data());
  const fftw_plan plan = fftw_plan_dft_2d(n, n, raw_in, raw_out, FFTW_FORWARD, FFTW_MEASURE);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = {std::sin(0.1 * static_cast<double>(i)), 1};
  fftw_execute(plan);
  const std::vector<std::complex<double>> first = out;
  const std::string known = wisdom();

  std::vector<std::vector<double>> found;
  std::jthread([&] { found = together(); }).join();
  std::jthread host([&] {  // while the host transforms too
    for (int i = 0; i < 20; ++i) fftw_execute(plan);
  });
  (void)together();
  host.join();

  CHECK(wisdom() == known);
  CHECK(fftw_planner_nthreads() == 2);
  fftw_execute(plan);
  CHECK(out == first);
  fftw_destroy_plan(plan);
  fftw_cleanup_threads();
  for (const std::vector<double>& each : found) CHECK(each == one_of_each());  // ours has survived the host's clean-up
}

TEST_CASE("rounding mode and traps stay, and are lived with") {
  const std::vector<double> alone = one_of_each();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const double velocity[] = {1e-3, 0.1};
    const std::vector<double> mu =
        friction(road, series, {.pressure = 1e5, .correction = NayakSFactor{}, .adhesion = Adhesion{5e6}}, velocity).mu;
    CHECK(std::fegetround() == mode);
    std::fesetround(FE_TONEAREST);
    for (std::size_t i = 0; i < 2; ++i) CHECK(mu[i] == doctest::Approx(alone[i]).epsilon(1e-6));  // rtol
  }
  // As compiled with Fortran's -ffpe-trap=invalid,zero,overflow: a signal would end this process.
  std::feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  if (fegetexcept() == 0) {
    MESSAGE("there are no traps here, as under valgrind: not tried");
    return;
  }
  const std::vector<double> trapped = one_of_each();
  const int traps = fegetexcept();
  fedisableexcept(FE_ALL_EXCEPT);
  CHECK(traps == (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW));
  CHECK(trapped == alone);
}

TEST_CASE("a decimal comma changes neither numbers nor messages, and stays") {
  const std::vector<double> alone = one_of_each();
  const std::string c_locale = std::setlocale(LC_ALL, nullptr);
  if (!comma_locale()) MESSAGE("no locale with a decimal comma can be had: the streams' alone is tried");
  const std::string set = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  for (const std::vector<double>& each : together()) CHECK(each == alone);  // the message of a refusal among them
  CHECK(std::use_facet<std::numpunct<char>>(std::locale()).decimal_point() == ',');
  CHECK(std::setlocale(LC_ALL, nullptr) == set);
  std::locale::global(before);
  std::setlocale(LC_ALL, c_locale.c_str());
}

TEST_CASE("nothing is printed, no signal handler, random state or handler of C++ is touched") {
  const auto list = [] {
    std::vector<void (*)(int)> result;
    for (int number = 1; number < SIGRTMAX; ++number) {
      struct sigaction action {};
      if (sigaction(number, nullptr, &action) == 0) result.push_back(action.sa_handler);
    }
    return result;
  };
  std::signal(SIGUSR1, [](int) {});
  std::signal(SIGFPE, [](int) { std::_Exit(3); });
  const auto signals = list();
  const auto terminate = std::get_terminate();
  const auto out_of_memory = std::get_new_handler();
  std::srand(7);
  const int random = std::rand();
  std::srand(7);
  Captured captured;
  (void)together();
  CHECK(captured.stop() == 0);
  CHECK((list() == signals));
  CHECK((std::get_terminate() == terminate));
  CHECK((std::get_new_handler() == out_of_memory));
  CHECK(std::rand() == random);
  std::signal(SIGUSR1, SIG_DFL);
  std::signal(SIGFPE, SIG_DFL);
}

TEST_CASE("memory is flat from the first batch on") {
  (void)together();
  const std::size_t first = live_bytes();
  constexpr std::size_t batches = 60, smallest = 16;  // of the blocks of malloc [B]
  for (std::size_t i = 0; i < batches; ++i) (void)together();
  const std::size_t last = live_bytes();
  MESSAGE("live after the first batch ", first, " bytes, after ", batches, " more ", last);
  CHECK(last < first + batches * many * smallest);  // no thread of any batch keeps one
}
