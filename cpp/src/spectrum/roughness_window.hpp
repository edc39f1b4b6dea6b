// The roughness about a wavenumber, which PartialContact compares with the local pressure.
#pragma once

#include <span>
#include <vector>

#include "spectrum/segments.hpp"

namespace asperity {

/// int c dt and int c (t - from) dt, c = q^4 C, from one place of a segment on, in ln q, to another.
struct RoughnessMoments {
  double zeroth, first;
};
RoughnessMoments roughness_moments(const Segment& segment, double from, double to);

/// The mean of c = q^4 C over a window of ln q about the wavenumber, c being 0 off the band: it depends on the surface
/// alone, and single rows of a measured spectrum have a small part in it.
class RoughnessWindow {
 public:
  /// Of the window, in ln q.
  static constexpr double half_length = 1;

  explicit RoughnessWindow(std::span<const Segment> surface);
  [[nodiscard]] double operator()(double wavenumber) const;
  /// int c d ln q from the start of the band up to a wavenumber in it, and over the band.
  [[nodiscard]] double below(double wavenumber) const { return between(surface_.front().a, wavenumber); }
  [[nodiscard]] double total() const { return total_; }
  /// Where the roughness ends [1/m]: the mean of ln q over the last tenth of the integral. Rows with hardly any
  /// roughness beyond it do not count.
  [[nodiscard]] double end() const { return end_; }
  /// Where that tenth begins [1/m].
  [[nodiscard]] double last_from() const { return last_from_; }
  /// The wavenumbers at which it changes its formula because it meets the end of the band [1/m].
  [[nodiscard]] std::vector<double> ends() const;

 private:
  /// int q^3 C dq from one wavenumber to another.
  [[nodiscard]] double between(double lower, double upper) const;
  [[nodiscard]] std::size_t segment_at(double wavenumber) const;
  [[nodiscard]] double mean_of_last();

  std::span<const Segment> surface_;
  std::vector<double> before_;  // the integral up to each segment
  double total_ = 0, end_, last_from_;
};

}  // namespace asperity
