// What a friction result says about the limits of the theory it comes from.
#pragma once

#include <string>
#include <vector>

#include "asperity/correction.hpp"

namespace asperity {

class Notes {
 public:
  Notes(double rms_slope, std::size_t points) : rms_slope_(rms_slope), points_(points) {}
  void add(const Shift& shift, double velocity);
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  double rms_slope_;
  std::size_t points_, fast_ = 0, full_ = 0, no_contact_ = 0, far_ = 0;
};

}  // namespace asperity
