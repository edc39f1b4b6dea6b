// The data that contact derives from the rows of a table: made when first asked for, kept with them, shared by copies
// and threads.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "asperity/spectrum.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// The harmonics of all rings of a table: their means by slope variance, and how large each is at most.
struct RingMeans {
  std::vector<double> cosine, sine, most;
};

class TableSurface {
 public:
  /// Of rows that a law was written out in: its roll-off, or where it begins, and where directions of it begin to fall
  /// and all do, at which slopes over its numbers have roots [1/m].
  struct Law {
    double from;
    std::vector<double> bends;
  };
  std::optional<Law> law;
  /// All of them take the table that this is kept with.
  std::span<const Segment> segments(const TabulatedSpectrum& table);
  double rms_slope(const TabulatedSpectrum& table);
  double nayak_parameter(const TabulatedSpectrum& table);
  const RingMeans& means(const TabulatedSpectrum& table);
  /// What a later folder derives from the rows; all of a table's is one T.
  struct Derived {
    Derived() = default;
    Derived(const Derived&) = delete;
    Derived& operator=(const Derived&) = delete;
    virtual ~Derived() = default;
  };
  template <class T>
  T& derived() {
    std::call_once(derived_made_, [&] { derived_ = std::make_unique<T>(); });
    return static_cast<T&>(*derived_);
  }

 private:
  std::once_flag segments_made_, slope_made_, nayak_made_, means_made_, derived_made_;
  std::vector<Segment> segments_;
  double rms_slope_ = 0, nayak_parameter_ = 0;
  RingMeans means_;
  std::unique_ptr<Derived> derived_;
};

/// The segments of a spectrum for as long as it is there: a table's own, or made here.
class SurfaceSegments {
 public:
  explicit SurfaceSegments(const Spectrum& spectrum);
  SurfaceSegments(const SurfaceSegments&) = delete;
  SurfaceSegments& operator=(const SurfaceSegments&) = delete;
  ~SurfaceSegments() = default;
  [[nodiscard]] std::span<const Segment> get() const { return all_; }

 private:
  std::vector<Segment> made_;
  std::span<const Segment> all_;
};

}  // namespace asperity
