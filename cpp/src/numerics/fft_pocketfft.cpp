// Fourier transforms by pocketfft (M. Reinecke, Max Planck Society), for builds without FFTW. It transforms one row in
// plain loops, and as many at once as a register has lanes: rows and columns are brought into lanes and back.
#define POCKETFFT_NO_MULTITHREADING
#include "numerics/fft.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "numerics/simd.hpp"

namespace asperity {

namespace {

/// Transforms of one length, compiled for one vector unit.
template <class T>
struct Plan {
  Plan() = default;
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  virtual ~Plan() = default;
  /// A row of n numbers and its modes in pocketfft's order: r_0, r_1, i_1, r_2 ...
  virtual void row(T*, Direction) const {}
  /// RealTransform::together rows.
  virtual void rows(const T*, std::size_t, T*, std::size_t) const {}
  /// As many columns of complex numbers as a register has lanes, `apart` T's from one to the next.
  virtual void apart(const T*, T*, std::size_t, Direction) const {}
};

#define ASPERITY_LOOPS "numerics/pocketfft_loops.inc"
#include "numerics/vector_units.inc"

/// The plan of `Of` for this machine's vector unit.
#define ASPERITY_PLAN(Of, n)                                                                              \
  (vector_unit() == VectorUnit::baseline ? std::shared_ptr<Plan<T>>(std::make_shared<baseline::Of<T>>(n)) \
                                         : std::shared_ptr<Plan<T>>(std::make_shared<avx2::Of<T>>(n)))

template <class T>
const Plan<T>& plan_of(const std::shared_ptr<void>& plan) {
  return *static_cast<const Plan<T>*>(plan.get());
}

template <class T>
T* numbers(std::complex<T>* modes) {
  return reinterpret_cast<T*>(modes);
}

}  // namespace

template <class T>
RealTransform<T>::RealTransform(std::size_t n, Direction) : n_(n), plan_(ASPERITY_PLAN(Real, n)) {}

template <class T>
void RealTransform<T>::operator()(T* in, std::complex<T>* out) const {
  plan_of<T>(plan_).row(in, Direction::forward);
  T* const to = numbers(out);
  to[0] = in[0];
  std::copy_n(in + 1, n_ - 1, to + 2);
  to[1] = 0;
  if (n_ % 2 == 0) to[n_ + 1] = 0;
}

template <class T>
void RealTransform<T>::operator()(T* in, std::size_t row, std::complex<T>* out, std::size_t modes) const {
  plan_of<T>(plan_).rows(in, row, numbers(out), 2 * modes);
}

template <class T>
void RealTransform<T>::operator()(std::complex<T>* in, T* out) const {
  const T* const from = numbers(in);
  out[0] = from[0];
  std::copy_n(from + 2, n_ - 1, out + 1);
  plan_of<T>(plan_).row(out, Direction::backward);
}

template <class T>
ColumnsTransform<T>::ColumnsTransform(std::size_t n, Direction direction)
    : distance_(Scratch<std::complex<T>>::aligned(n) + 8), direction_(direction), plan_(ASPERITY_PLAN(Complex, n)) {}

template <class T>
void ColumnsTransform<T>::operator()(std::complex<T>* in, std::complex<T>* out) const {
  plan_of<T>(plan_).apart(numbers(in), numbers(out), 2 * distance_, direction_);
}

template class RealTransform<float>;
template class RealTransform<double>;
template class ColumnsTransform<float>;
template class ColumnsTransform<double>;

}  // namespace asperity
