// A rubber and the harmonics of a directional spectrum, seen from the velocity.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"
#include "contact/grid/roughness_pieces.hpp"

namespace asperity {

/// With harmonics a_m and b_m of the ring about the velocity, the sums over its plane are
///   I1 + sum a_m (L_m-1 + L_m) along, sum b_m (L_m-1 - L_m) across, and I2 + 2 sum a_m K_m.
class Directions {
 public:
  /// a_m and b_m, a row of m for each entry.
  struct Rings {
    std::vector<double> along, across;
  };
  Directions(const RingHarmonics& harmonics, double direction);
  [[nodiscard]] std::size_t count() const { return harmonics_.count; }
  [[nodiscard]] Rings at_nodes(const RoughnessPieces& pieces) const;
  /// Of the last tenth of the roughness, which the edges of contacts have.
  [[nodiscard]] Rings at_end(const RoughnessPieces& pieces) const;

  /// How many harmonics matter for an error of `least` in I1, I2 or the force across; what the others may have is added
  /// to `rest`. `of` is of some frequencies, count() rows of each.
  [[nodiscard]] static std::size_t needed(const Rings& rings, std::size_t count, const AngularHarmonics& of,
                                          double least, double& rest);
  /// The sums of as many entries as i1 has. `loss` and `square` have L_m and K_m from m = 1 on, `used` rows of
  /// `stride`.
  static void add(const Rings& rings, std::size_t count, std::size_t used, std::span<const double> loss,
                  std::span<const double> square, std::size_t stride, std::span<double> i1, std::span<double> i2,
                  std::span<double> across);

 private:
  [[nodiscard]] Rings turned(std::span<const double> cosine, std::span<const double> sine) const;
  const RingHarmonics& harmonics_;
  std::vector<double> cosine_, sine_;  // of 2 m times the direction
};

/// One ring and its rubber, at any frequency: what stands in the place of I1 and I2.
class DirectedRubber {
 public:
  DirectedRubber(Directions::Rings ring, std::size_t used) : ring_(std::move(ring)), used_(used) {}
  void add(const Rubber& rubber, std::span<const double> w, std::span<double> i1, std::span<double> i2,
           std::span<double> across) const;

 private:
  Directions::Rings ring_;
  std::size_t used_;
};

}  // namespace asperity
