// ln p_T of a Greenwood-Williamson correction over ln(p / E*), on which alone it depends.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "numerics/interpolation.hpp"

namespace asperity {

/// Polynomials of one variable on intervals, halved until each keeps a tolerance; the intervals never cross a cut,
/// where the function has a kink.
class LoadShift {
 public:
  struct Sample {
    double value, error;
  };
  /// 0 everywhere.
  LoadShift() = default;
  /// `exact` between the first and the last of the cuts.
  LoadShift(const std::function<Sample(double z)>& exact, std::span<const double> cuts, double tolerance);

  [[nodiscard]] bool any() const { return !pieces_.empty(); }
  /// The last interval that begins below z, or the one that ends there.
  [[nodiscard]] ValueAndSlope operator()(double z) const { return on(pieces_, z); }
  /// On the side of a cut that a band (from 0) is on.
  [[nodiscard]] ValueAndSlope operator()(double z, std::size_t band) const {
    return any() ? on(std::span(pieces_).subspan(bands_[band], bands_[band + 1] - bands_[band]), z) : on(pieces_, z);
  }
  /// The largest error that was found.
  [[nodiscard]] double error() const { return error_; }
  /// Of z + ln p_T.
  [[nodiscard]] std::array<double, 2> range() const { return range_; }

 private:
  static constexpr std::size_t n = 16;
  struct Piece {
    double lower, upper;
    std::array<double, n> power;  // of -1 to 1 over the interval
    [[nodiscard]] ValueAndSlope operator()(double z) const;
  };
  static ValueAndSlope on(std::span<const Piece> pieces, double z);
  void add(const std::function<Sample(double z)>& exact, double lower, double upper, double tolerance, int depth);

  std::vector<Piece> pieces_;       // in order
  std::vector<std::size_t> bands_;  // the first piece of each, and their number
  double error_ = 0;
  std::array<double, 2> range_{};
};

}  // namespace asperity
