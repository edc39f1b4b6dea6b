// The loops over measured peaks, compiled for several vector units.
#pragma once

#include <cstddef>

namespace asperity {

/// The lowest, the highest and the mean of the heights; the mean is not finite where one of them is not.
struct PeakRange {
  double lowest, highest, mean;
};
PeakRange range_of_peaks(const double* height, std::size_t n);

/// Sums of s^(3/2) and of s^(1/2), s = max(0, 1 - (highest - z) / depth) the share of the depth that a peak reaches
/// into.
struct PeakSums {
  double moment, roots;
};
PeakSums sums_over_peaks(const double* height, std::size_t n, double highest, double depth);

}  // namespace asperity
