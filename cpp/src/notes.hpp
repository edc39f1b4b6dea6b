// What a friction result says about the limits of the theory it comes from.
#pragma once

#include <string>
#include <vector>

#include "asperity/correction.hpp"

namespace asperity {

class Notes {
 public:
  explicit Notes(double rms_slope) : rms_slope_(rms_slope) {}
  void add(const Shift& shift, double velocity);
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  double rms_slope_;
  bool fast_ = false, full_ = false, no_contact_ = false, far_ = false;
};

}  // namespace asperity
