// Notes of a friction result on the limits of the theory and of its input.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "asperity/correction.hpp"
#include "contact/s_factor.hpp"

namespace asperity {

class Notes {
 public:
  Notes(const Spectrum& spectrum, const Rubber& rubber, const Correction& correction);
  void add(const Shift& shift, double velocity, double extrapolated_share, const MeasuredWorth& worth);
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  double rms_slope_;
  bool corrected_;
  std::optional<double> unmeasured_nayak_;  // of a spectrum beyond the measured ones, where a correction is asked for
  std::array<double, 2> flagged_ends_;      // [1/m]: unreliable up to the first and from the second on
  std::optional<FrequencyRange> fitted_;    // [m/s]: v q stays where a Prony series was fitted
  bool beyond_fit_ = false;
  bool lowest_bin_ = false, fast_ = false, full_ = false, no_contact_ = false, far_ = false, extrapolated_ = false,
       worse_ = false, light_ = false;
};

}  // namespace asperity
