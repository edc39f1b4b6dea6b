// Exact over stated mu of PartialContact on 102 periodic maps by skewness and kurtosis, 12 sliding contacts each: worn,
// flattened, peaked and heavy-tailed heights, phases that make them skewed, short waves that are gathered in places,
// q1 / q0 of 8 and 32 (tests/benchmarks/skewed_heights.py of commit 4a986d8c).
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
constexpr Ratio skewed_down{0.72, 0.47, 1.01}, far_down{0.54, 0.11, 3.08}, flat_tops{0.65, 0.13, 1.1},
    skewed_up{1.36, 0.89, 2.36}, far_up{1.67, 1.03, 2.87}, heavy_tails{1.42, 0.64, 4.88}, gathered{1.06, 0.57, 2.26};
// Gaussian maps with four of the longest waves along a side have skewness within 0.25 and kurtosis from 2.7 to 3.4 by
// chance, and at these limits the mean error is 20 %. Their curvature has kurtosis 2.8 to 3.2 (27 maps).
constexpr double skewness_limit = 0.4, far = 0.8, lowest_kurtosis = 2.3, highest_kurtosis = 4,
                 highest_curvature_kurtosis = 3.5;

std::optional<Ratio> ratio(const HeightShape& heights) {
  const double skewness = heights.skewness, kurtosis = heights.kurtosis;
  if (std::fabs(skewness) <= skewness_limit) {
    if (kurtosis < lowest_kurtosis) return flat_tops;
    if (kurtosis > highest_kurtosis) return heavy_tails;
    return {};
  }
  if (kurtosis > 3 * (1 + skewness * skewness)) return heavy_tails;
  if (skewness < 0) return skewness < -far ? far_down : skewed_down;
  return skewness > far ? far_up : skewed_up;
}

std::string exact_contacts_had(const Ratio& seen) {
  return ", which a spectrum does not know: exact contacts of such maps had " + show(seen.mean, 3) +
         " times the mu of PartialContact (" + show(seen.lowest, 3) + " to " + show(seen.highest, 3) +
         "), other corrections were off by 30 % rms or more";
}

}  // namespace

std::optional<Diagnostic> note_on_heights(const HeightShape& heights) {
  if (const std::optional<Ratio> seen = ratio(heights))
    return warning("heights-not-gaussian",
                   "the heights have skewness " + value(heights.skewness, 2) + " and kurtosis " +
                       value(heights.kurtosis, 2) + " (Gaussian: 0 and 3)" + exact_contacts_had(*seen),
                   {"take ScanContact, the contact of the scan itself"});
  const std::optional<double> kurtosis = heights.curvature_kurtosis;
  if (!kurtosis || *kurtosis <= highest_curvature_kurtosis) return {};
  return warning("gathered-waves",
                 "short waves are gathered in places, where their curvature has kurtosis " + value(*kurtosis, 2) +
                     " (spread evenly: 3)" + exact_contacts_had(gathered),
                 {"take ScanContact, the contact of the scan itself"});
}

std::optional<Diagnostic> note_on_heights(const Spectrum& spectrum) {
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && table->quality().heights ? note_on_heights(*table->quality().heights) : std::nullopt;
}

std::optional<Diagnostic> note_on_lay(const Spectrum& spectrum) {
  constexpr double least = 1.5;  // |C| differs by its square
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  if (!table || table->harmonics().count > 0 || !table->quality().heights) return {};
  const std::optional<double> ratio = table->quality().heights->slope_ratio;
  if (!ratio || !(*ratio > least)) return {};
  return warning("lay",
                 "the slope across the lay is " + value(*ratio, 3) +
                     " times that along it: the spectrum is an average over directions, and stands for none",
                 {"take power_spectrum(map, directional=True), and the direction of sliding"});
}

}  // namespace asperity
