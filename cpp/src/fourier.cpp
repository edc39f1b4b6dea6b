#include "fourier.hpp"

#include <fftw3.h>

#include <cstdlib>
#include <mutex>
#include <new>
#include <string>
#ifdef __linux__
#include <sys/mman.h>
#endif

#include "checks.hpp"

namespace asperity {

namespace {

/// FFTW's planner is not thread-safe, execution is. The copy of FFTW in here is private (its symbols are
/// hidden), so that this lock covers every use of it and the host's own FFTW is left alone.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

/// The two precisions of FFTW under one name.
template <class T>
struct Fftw;

template <>
struct Fftw<double> {
  using Complex = fftw_complex;
  using Plan = fftw_plan;
  static Plan real(int n, double* in, Complex* out, unsigned flags) { return fftw_plan_dft_r2c_1d(n, in, out, flags); }
  static Plan many(int n, int count, Complex* in, Complex* out, unsigned flags) {
    return fftw_plan_many_dft(1, &n, count, in, nullptr, 1, n, out, nullptr, 1, n, FFTW_FORWARD, flags);
  }
  static void run(Plan p, double* in, Complex* out) { fftw_execute_dft_r2c(p, in, out); }
  static void run(Plan p, Complex* in, Complex* out) { fftw_execute_dft(p, in, out); }
  static void destroy(Plan p) { fftw_destroy_plan(p); }
};

template <>
struct Fftw<float> {
  using Complex = fftwf_complex;
  using Plan = fftwf_plan;
  static Plan real(int n, float* in, Complex* out, unsigned flags) { return fftwf_plan_dft_r2c_1d(n, in, out, flags); }
  static Plan many(int n, int count, Complex* in, Complex* out, unsigned flags) {
    return fftwf_plan_many_dft(1, &n, count, in, nullptr, 1, n, out, nullptr, 1, n, FFTW_FORWARD, flags);
  }
  static void run(Plan p, float* in, Complex* out) { fftwf_execute_dft_r2c(p, in, out); }
  static void run(Plan p, Complex* in, Complex* out) { fftwf_execute_dft(p, in, out); }
  static void destroy(Plan p) { fftwf_destroy_plan(p); }
};

int side(std::size_t n) {
  if (n > 1U << 30) throw InvalidInput("shape: a side of " + std::to_string(n) + " points: must be at most 2^30");
  return static_cast<int>(n);
}

template <class T>
auto* raw(std::complex<T>* modes) {
  return reinterpret_cast<Fftw<T>::Complex*>(modes);
}

/// Plans under the lock, and gives the plan back under the lock.
template <class F, class Make>
std::shared_ptr<void> planned(Make make) {
  typename F::Plan plan;
  {
    const std::scoped_lock lock(planner());
    plan = make();
  }
  if (!plan) throw Error("FFTW could not plan this transform");
  return {plan, [](void* p) {
            const std::scoped_lock lock(planner());
            F::destroy(static_cast<F::Plan>(p));
          }};
}

constexpr std::size_t large_page = std::size_t{2} << 20;

}  // namespace

template <class T>
Scratch<T>::Scratch(std::size_t size) {
  const std::size_t wanted = size * sizeof(T), unit = wanted < large_page ? 64 : large_page;
  const std::size_t bytes = (wanted + unit - 1) / unit * unit;
  data_ = static_cast<T*>(std::aligned_alloc(unit, bytes));
  if (!data_) throw std::bad_alloc();
#ifdef __linux__
  if (unit == large_page) madvise(data_, bytes, MADV_HUGEPAGE);  // advice: nothing is lost where it is not taken
#endif
}

template <class T>
Scratch<T>::~Scratch() {
  std::free(data_);
}

template <class T>
RealTransform<T>::RealTransform(std::size_t n) {
  const Scratch<T> in(n);
  const Scratch<std::complex<T>> out(n / 2 + 1);
  plan_ = planned<Fftw<T>>(
      [&] { return Fftw<T>::real(side(n), in.data(), raw(out.data()), FFTW_ESTIMATE | FFTW_DESTROY_INPUT); });
}

template <class T>
void RealTransform<T>::operator()(T* in, std::complex<T>* out) const {
  Fftw<T>::run(static_cast<Fftw<T>::Plan>(plan_.get()), in, raw(out));
}

template <class T>
ComplexTransform<T>::ComplexTransform(std::size_t n, std::size_t count) {
  const Scratch<std::complex<T>> in(n * count), out(n * count);
  plan_ = planned<Fftw<T>>([&] {
    return Fftw<T>::many(side(n), side(count), raw(in.data()), raw(out.data()), FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  });
}

template <class T>
void ComplexTransform<T>::operator()(std::complex<T>* in, std::complex<T>* out) const {
  Fftw<T>::run(static_cast<Fftw<T>::Plan>(plan_.get()), raw(in), raw(out));
}

template class Scratch<float>;
template class Scratch<double>;
template class Scratch<std::complex<float>>;
template class Scratch<std::complex<double>>;
template class RealTransform<float>;
template class RealTransform<double>;
template class ComplexTransform<float>;
template class ComplexTransform<double>;

std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape) {
  std::vector<double> heights(shape[0] * shape[1]);
  const auto plan = planned<Fftw<double>>([&] {
    return fftw_plan_dft_c2r_2d(side(shape[0]), side(shape[1]), raw(modes.data()), heights.data(), FFTW_ESTIMATE);
  });
  fftw_execute(static_cast<fftw_plan>(plan.get()));
  return heights;
}

}  // namespace asperity
