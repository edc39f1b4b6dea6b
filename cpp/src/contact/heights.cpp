// Exact over stated mu of PartialContact on 75 periodic maps by skewness and kurtosis, 12 sliding contacts each: worn,
// flattened, peaked and heavy-tailed heights and phases that make them skewed, q1 / q0 of 8 and 32
// (tests/benchmarks/skewed_heights.py).
#include "contact/heights.hpp"

#include <cmath>

#include "asperity/contact.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

/// Of mu: geometric mean, lowest and highest.
struct Ratio {
  double mean, lowest, highest;
};
constexpr Ratio skewed_down{0.72, 0.47, 1.01}, far_down{0.52, 0.11, 0.97}, flat_tops{0.65, 0.13, 1.1},
    skewed_up{1.36, 1.03, 1.88}, far_up{1.67, 1.03, 2.87}, heavy_tails{1.56, 0.7, 4.88};
// Gaussian maps with four of the longest waves along a side have skewness within 0.25 and kurtosis from 2.7 to 3.4 by
// chance, and at these limits the mean error is 20 %.
constexpr double skewness_limit = 0.4, far = 0.8, lowest_kurtosis = 2.3, highest_kurtosis = 4;

std::optional<Ratio> ratio(const HeightShape& heights) {
  const auto [skewness, kurtosis] = heights;
  if (std::fabs(skewness) <= skewness_limit) {
    if (kurtosis < lowest_kurtosis) return flat_tops;
    if (kurtosis > highest_kurtosis) return heavy_tails;
    return {};
  }
  if (kurtosis > 3 * (1 + skewness * skewness)) return heavy_tails;
  if (skewness < 0) return skewness < -far ? far_down : skewed_down;
  return skewness > far ? far_up : skewed_up;
}

}  // namespace

std::optional<Diagnostic> note_on_heights(const HeightShape& heights) {
  const std::optional<Ratio> seen = ratio(heights);
  if (!seen) return {};
  return warning("heights-not-gaussian",
                 "the heights have skewness " + value(heights.skewness, 2) + " and kurtosis " +
                     value(heights.kurtosis, 2) +
                     " (Gaussian: 0 and 3), which a spectrum does not know: exact contacts of such maps had " +
                     show(seen->mean, 3) + " times the mu of PartialContact (" + show(seen->lowest, 3) + " to " +
                     show(seen->highest, 3) + "), other corrections were off by 30 % rms or more",
                 {"take ScanContact, the contact of the scan itself"});
}

std::optional<Diagnostic> note_on_heights(const Spectrum& spectrum) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && table->quality().heights ? note_on_heights(*table->quality().heights) : std::nullopt;
}

}  // namespace asperity
