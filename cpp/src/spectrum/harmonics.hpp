// The directions of a spectrum: harmonics of rings, and self-affine ones whose circles are ellipses.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "asperity/spectrum.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

inline constexpr std::size_t most_harmonics = 64;

/// Harmonics of a table at a wavenumber in its band.
class HarmonicsAt {
 public:
  HarmonicsAt(const TabulatedSpectrum& table, double wavenumber);
  [[nodiscard]] double cosine(std::size_t m) const { return between(all_->cosine, m); }
  [[nodiscard]] double sine(std::size_t m) const { return between(all_->sine, m); }

 private:
  [[nodiscard]] double between(const std::vector<double>& rows, std::size_t m) const {
    const double *const lower = rows.data() + row_ * all_->count + m, *const upper = lower + all_->count;
    return *lower + share_ * (*upper - *lower);
  }
  const RingHarmonics* all_;
  std::size_t row_;
  double share_;
};

/// What was made of the last self-affine law: curves of a point each, maps and sweeps ask for the same one again and
/// again.
template <class T>
class OfLastLaw {
 public:
  /// That of the law; `make` returns a pointer to it where the last law was another one.
  template <class Make>
  std::shared_ptr<T> operator()(const SelfAffineSpectrum& law, Make make) {
    {
      const std::scoped_lock lock(mutex_);
      if (made_ && law_ == law) return made_;
    }
    std::shared_ptr<T> made = make();
    const std::scoped_lock lock(mutex_);
    law_ = law;
    return made_ = std::move(made);
  }

 private:
  std::mutex mutex_;
  SelfAffineSpectrum law_;
  std::shared_ptr<T> made_;
};

/// Whether the mean over directions is no power law: beside the roll-off of an ellipse.
bool bends_by_direction(const SelfAffineSpectrum& s);
/// The rows of a law that knows directions. Those of the last one are kept: a map and a sweep ask for them at each
/// point.
std::shared_ptr<const Spectrum> rows_of_law(const SelfAffineSpectrum& law);
/// Means over directions of C of a law, over its C at the roll-off or at k = q0, times cos 2 m (phi - lay), m = 0 to
/// count - 1: a row a wavenumber.
std::vector<double> shape_harmonics(const SelfAffineSpectrum& law, std::span<const double> wavenumber,
                                    std::size_t count);
/// Mean over directions of (k / |q|)^(-2 - 2 H).
double mean_of_shape(const SelfAffineSpectrum& s);
/// h_rms^2 / (2 pi C_r) of one that bends.
double plane_height(const SelfAffineSpectrum& s);

/// C of vectors q in the band.
class PlaneDensity {
 public:
  /// The spectrum must outlive it.
  explicit PlaneDensity(const Spectrum& spectrum);
  /// At |q| [1/m] and the direction of q [rad]; harmonics of a scan may leave it below 0.
  [[nodiscard]] double operator()(double wavenumber, double direction) const;

 private:
  const Spectrum& spectrum_;
  std::vector<Segment> pieces_;
  double top_ = 0;  // C_r, or that of the law without roll-off at k = q0
};

}  // namespace asperity
