// Fourier transforms by FFTW, its plans under one lock.
// M. Frigo and S. G. Johnson, Proc. IEEE 93, 216 (2005).
#include <fftw3.h>

#include <cstring>
#include <mutex>
#include <numbers>
#include <string>
#include <type_traits>

#include "numerics/arguments.hpp"
#include "numerics/fft.hpp"
#include "numerics/simd.hpp"

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
    static constexpr auto complex = fftw##_plan_dft_1d;          \
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

// FFTW's real transforms of floats take three times as long as complex ones of half the length. So even rows z of
// floats go as x_j = z_2j + i z_2j+1, X being the transform of h = n / 2 numbers, and
//   Z_k = (X_k + conj X_h-k) / 2 + t_k (X_k - conj X_h-k),  t_k = -i / 2 exp(-2 pi i k / n),
// where k and h - k share their terms: Z_h-k = conj((X_k + conj X_h-k) / 2 - t_k (X_k - conj X_h-k)).
template <class T>
RealTransform<T>::RealTransform(std::size_t n, Direction direction) : n_(n) {
  const Scratch<T> numbers(n);
  const Scratch<std::complex<T>> modes(n / 2 + 1);
  const auto flags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;
  const bool forward = direction == Direction::forward;
  if (std::is_same_v<T, float> && n % 2 == 0) {
    for (std::size_t k = 0; k <= n / 4; ++k)
      twiddles_.emplace_back(
          std::polar(forward ? 0.5 : 1, (forward ? -std::numbers::pi : std::numbers::pi) *
                                            (0.5 + 2 * static_cast<double>(k) / static_cast<double>(n))));
    auto* const pairs = reinterpret_cast<std::complex<T>*>(numbers.data());
    plan_ = planned<Fftw<T>>([&] {
      return forward ? Fftw<T>::complex(side(n / 2), raw(pairs), raw(modes.data()), FFTW_FORWARD, flags)
                     : Fftw<T>::complex(side(n / 2), raw(modes.data()), raw(pairs), FFTW_BACKWARD, flags);
    });
  } else {
    plan_ = planned<Fftw<T>>([&] {
      return forward ? Fftw<T>::real(side(n), numbers.data(), raw(modes.data()), flags)
                     : Fftw<T>::real_inverse(side(n), raw(modes.data()), numbers.data(), flags);
    });
  }
}

namespace {

Quad load(const std::complex<float>* from) {
  Quad v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
void store(Quad v, std::complex<float>* to) { std::memcpy(static_cast<void*>(to), &v, sizeof v); }

/// half (Z_k + conj Z_h-k) + t_k (Z_k - conj Z_h-k) for k from 1 to h - 1, in place.
void exchange(std::complex<float>* z, std::size_t h, const std::complex<float>* twiddle, float half) {
  const Quad conjugate = {1, -1, 1, -1};
  std::size_t k = 1;
  for (; 2 * k + 2 < h; k += 2) {
    const Quad a = load(z + k), mirror = load(z + h - k - 1), t = load(twiddle + k);
    const Quad b = __builtin_shufflevector(mirror, mirror, 2, 3, 0, 1) * conjugate;
    const Quad mean = half * (a + b), d = a - b;
    const Quad turned = __builtin_shufflevector(t, t, 0, 0, 2, 2) * d - conjugate *
                                                                            __builtin_shufflevector(t, t, 1, 1, 3, 3) *
                                                                            __builtin_shufflevector(d, d, 1, 0, 3, 2);
    const Quad low = mean + turned, high = (mean - turned) * conjugate;
    store(low, z + k);
    store(__builtin_shufflevector(high, high, 2, 3, 0, 1), z + h - k - 1);
  }
  for (; 2 * k <= h; ++k) {
    const std::complex<float> a = z[k], b = std::conj(z[h - k]), turned = twiddle[k] * (a - b);
    z[h - k] = std::conj(half * (a + b) - turned);
    z[k] = half * (a + b) + turned;
  }
}

/// From the transform of h pairs to the h + 1 modes of the 2 h numbers, in place.
void untangle(std::complex<float>* z, std::size_t h, const std::complex<float>* twiddle) {
  z[h] = z[0].real() - z[0].imag();
  z[0] = z[0].real() + z[0].imag();
  exchange(z, h, twiddle, 0.5F);
}

/// The way back, times 2: X_k = (Z_k + conj Z_h-k) + 2 conj t_k (Z_k - conj Z_h-k).
void tangle(std::complex<float>* z, std::size_t h, const std::complex<float>* twiddle) {
  z[0] = {z[0].real() + z[h].real(), z[0].real() - z[h].real()};
  exchange(z, h, twiddle, 1);
}

}  // namespace

template <class T>
void RealTransform<T>::operator()(T* in, std::complex<T>* out) const {
  const auto plan = static_cast<typename Fftw<T>::Plan>(plan_.get());
  if constexpr (std::is_same_v<T, float>)
    if (!twiddles_.empty()) {
      Fftw<T>::run(plan, raw(reinterpret_cast<std::complex<T>*>(in)), raw(out));
      return untangle(out, n_ / 2, twiddles_.data());
    }
  Fftw<T>::run_real(plan, in, raw(out));
}

template <class T>
void RealTransform<T>::operator()(T* in, std::size_t, std::complex<T>* out, std::size_t) const {
  static_assert(together == 1);
  (*this)(in, out);
}

template <class T>
void RealTransform<T>::operator()(std::complex<T>* in, T* out) const {
  const auto plan = static_cast<typename Fftw<T>::Plan>(plan_.get());
  if constexpr (std::is_same_v<T, float>)
    if (!twiddles_.empty()) {
      tangle(in, n_ / 2, twiddles_.data());
      return Fftw<T>::run(plan, raw(in), raw(reinterpret_cast<std::complex<T>*>(out)));
    }
  Fftw<T>::run_inverse(plan, raw(in), out);
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
