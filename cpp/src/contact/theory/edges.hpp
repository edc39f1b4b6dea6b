// What the edges of contacts carry beyond the end of the roughness, as PartialContact has it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "contact/grid/excitation.hpp"

namespace asperity {

/// int I (I2 / I2(v q_e))^(1/4) x^-3 d ln x for I1 and I2, x = q / q_e, and the errors of them.
struct EdgeIntegrals {
  double i1 = 0, i2 = 0;
  double across = 0;      // the same of the force across, where the waves have directions
  double i1_outside = 0;  // part of i1 from frequencies outside of the measured range, to a hundredth
  double i1_error = 0, i2_error = 0;
  double i2_at_end = 0;  // I2(v q_e)
};

/// Of one rubber. Beyond the frequencies that are known, the modulus keeps the value that it has at the last of them.
class Edges {
 public:
  Edges(const Excitation& waves, double rtol);
  /// At a velocity, with the end q_e of the roughness [1/m], from x = `lower` to `upper`, by so many harmonics of it.
  [[nodiscard]] EdgeIntegrals operator()(double velocity, double q_e, double lower, double upper,
                                         std::size_t harmonics = 0) const;

 private:
  struct Piece {
    double lower, upper;  // in ln x
    EdgeIntegrals value;
  };
  struct Place {
    double velocity, q_e, i2_at_end;
    std::size_t harmonics;
  };
  [[nodiscard]] double outside(const Place& place, double lower, double upper) const;
  [[nodiscard]] Piece piece(const Place& place, double lower, double upper) const;
  [[nodiscard]] std::vector<double> stops(const Place& place, double lower, double upper) const;
  [[nodiscard]] const Excitation& waves() const { return unlimited_waves_ ? *unlimited_waves_ : waves_; }

  const Excitation& waves_;
  std::optional<Rubber> unlimited_;  // for all but the parts from outside
  std::optional<Excitation> unlimited_waves_;
  bool limited_;
  double highest_, rtol_;
};

}  // namespace asperity
