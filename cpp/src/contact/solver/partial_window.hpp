// The roughness of a unit of ln q about a wavenumber, which PartialContact compares with the local pressure.
#pragma once

#include <span>
#include <vector>

#include "spectrum/segments.hpp"

namespace asperity {

/// The mean of c = q^4 C over the part of [ln q - 1/2, ln q + 1/2] that lies on the band: it depends on the surface
/// alone, and single rows of a measured spectrum have a small part in it.
class RoughnessWindow {
 public:
  explicit RoughnessWindow(std::span<const Segment> surface);
  [[nodiscard]] double operator()(double wavenumber) const;
  /// The wavenumbers at which it changes its formula because it meets the end of the band [1/m].
  [[nodiscard]] std::vector<double> ends() const;

 private:
  /// int q^3 C dq from one wavenumber to another.
  [[nodiscard]] double between(double lower, double upper) const;
  [[nodiscard]] std::size_t segment_at(double wavenumber) const;

  std::span<const Segment> surface_;
  std::vector<double> before_;  // the integral up to each segment
};

}  // namespace asperity
