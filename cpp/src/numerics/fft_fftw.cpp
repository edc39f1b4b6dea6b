// Fourier transforms by FFTW, its plans under one lock.
// M. Frigo and S. G. Johnson, Proc. IEEE 93, 216 (2005).
#include <fftw3.h>

#include <mutex>
#include <string>

#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"

namespace asperity {

namespace {

/// FFTW's planner is not thread-safe, execution is. The copy of FFTW in here is private (its symbols are
/// hidden), so that this lock covers every use of it and the host's own FFTW is left alone.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

/// FFTW's functions of one precision, whose names differ in how they begin.
template <class T>
struct Fftw;

#define ASPERITY_FUNCTIONS_OF_FFTW(T, fftw)                      \
  template <>                                                    \
  struct Fftw<T> {                                               \
    using Complex = fftw##_complex;                              \
    using Plan = fftw##_plan;                                    \
    static constexpr auto many = fftw##_plan_many_dft;           \
    static constexpr auto real = fftw##_plan_dft_r2c_1d;         \
    static constexpr auto real_inverse = fftw##_plan_dft_c2r_1d; \
    static constexpr auto run = fftw##_execute_dft;              \
    static constexpr auto run_real = fftw##_execute_dft_r2c;     \
    static constexpr auto run_inverse = fftw##_execute_dft_c2r;  \
    static constexpr auto destroy = fftw##_destroy_plan;         \
  };
ASPERITY_FUNCTIONS_OF_FFTW(double, fftw)
ASPERITY_FUNCTIONS_OF_FFTW(float, fftwf)
#undef ASPERITY_FUNCTIONS_OF_FFTW

int side(std::size_t n) {
  if (n > 1U << 30)
    throw InvalidInput(argument("shape") + ": a side of " + std::to_string(n) + " points" + must_be() + "at most 2^30");
  return static_cast<int>(n);
}

template <class T>
auto* raw(std::complex<T>* modes) {
  return reinterpret_cast<typename Fftw<T>::Complex*>(modes);
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
            F::destroy(static_cast<typename F::Plan>(p));
          }};
}

}  // namespace

template <class T>
RealTransform<T>::RealTransform(std::size_t n, Direction direction) : n_(n) {
  const Scratch<T> numbers(n);
  const Scratch<std::complex<T>> modes(n / 2 + 1);
  const auto flags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;
  plan_ = planned<Fftw<T>>([&] {
    return direction == Direction::forward ? Fftw<T>::real(side(n), numbers.data(), raw(modes.data()), flags)
                                           : Fftw<T>::real_inverse(side(n), raw(modes.data()), numbers.data(), flags);
  });
}

template <class T>
void RealTransform<T>::operator()(T* in, std::complex<T>* out) const {
  Fftw<T>::run_real(static_cast<typename Fftw<T>::Plan>(plan_.get()), in, raw(out));
}

template <class T>
void RealTransform<T>::operator()(T* in, std::size_t, std::complex<T>* out, std::size_t) const {
  static_assert(together == 1);
  (*this)(in, out);
}

template <class T>
void RealTransform<T>::operator()(std::complex<T>* in, T* out) const {
  Fftw<T>::run_inverse(static_cast<typename Fftw<T>::Plan>(plan_.get()), raw(in), out);
}

template <class T>
ColumnsTransform<T>::ColumnsTransform(std::size_t n, Direction direction)
    : distance_(Scratch<std::complex<T>>::aligned(n) + 8), direction_(direction) {
  const Scratch<std::complex<T>> in(distance_ * width), out(distance_ * width);
  plan_ = planned<Fftw<T>>([&] {
    const int length = side(n), apart = side(distance_);
    return Fftw<T>::many(1, &length, side(width), raw(in.data()), nullptr, 1, apart, raw(out.data()), nullptr, 1, apart,
                         direction == Direction::forward ? FFTW_FORWARD : FFTW_BACKWARD,
                         FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  });
}

template <class T>
void ColumnsTransform<T>::operator()(std::complex<T>* in, std::complex<T>* out) const {
  Fftw<T>::run(static_cast<typename Fftw<T>::Plan>(plan_.get()), raw(in), raw(out));
}

template class RealTransform<float>;
template class RealTransform<double>;
template class ColumnsTransform<float>;
template class ColumnsTransform<double>;

}  // namespace asperity
