// I1 and I2 of a modulus known piece by piece, from their definition, at a cost that hardly grows with the pieces.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/simd.hpp"

namespace asperity {

/// A value at the origin times the exponential of a cubic without constant term, in x = ln(w / origin).
struct LogCubic {
  double value, slope, square = 0, cubic = 0;
  [[nodiscard]] double operator()(double x) const { return value * std::exp(x * (slope + x * (square + x * cubic))); }
  /// The same in x - x0.
  [[nodiscard]] LogCubic about(double x0) const {
    return {(*this)(x0), slope + x0 * (2 * square + 3 * x0 * cubic), square + 3 * x0 * cubic, cubic};
  }
};

/// E' and E'' on [low, high] [rad/s].
struct ModulusPiece {
  double low, high, origin;
  LogCubic storage, loss;
  bool measured;
  [[nodiscard]] std::complex<double> operator()(double w) const {
    const double x = std::log(w / origin);
    return {storage(x), loss(x)};
  }
};

/// A stretch of w', on which E' and E'' change by less than e.
struct AngularPanel {
  static constexpr std::size_t terms = 48;  // far^(2 terms) b_terms = 1e-16
  static constexpr std::size_t nodes = 12;  // of a Gauss rule
  const ModulusPiece* piece;
  double unit;             // a power of 2 near its frequencies: |E|^2 times one could over- or underflow
  double middle;           // of w'
  LogCubic storage, loss;  // in ln(w' / middle)
  double node[nodes];      // w'
  Pair weight[nodes];      // of the kernel in I1 and in I2, over unit
  Pair moment[terms];      // of all below: 4 b_m / low int {u^(2m + 1) E'', u^2m |E|^2} dw' with u = w' / low
};

/// With w' = w cos(phi) and u = w' / w
///   I1 = 4 int u E''(w') dw' / sqrt(w^2 - w'^2),   I2 = 4 int |E(w')|^2 dw' / sqrt(w^2 - w'^2),   0 < w' < w.
/// The pieces are cut into panels short enough for one Gauss rule: in sin(phi / 2), where the kernel is smooth, for a
/// panel nearer to w than it is long; in w', of nodes that serve every w, for one further off. All below u = `far`
/// enters at once by 1 / sqrt(1 - u^2) = sum_m b_m u^2m, whose moments are carried from panel to panel.
class AngularSums {
 public:
  static constexpr double far = 0.7;
  static constexpr std::size_t together = 12;  // frequencies

  /// `pieces` adjoin each other and outlive the sums. The first is the end of the tail, in which E' is constant and E''
  /// proportional to w: it begins at `far` times the lowest frequency that can be asked for.
  explicit AngularSums(std::span<const ModulusPiece> pieces);

  /// Where the panels begin, and the last one ends.
  [[nodiscard]] std::span<const double> edges() const { return edges_; }
  /// Whether a panel begins where a piece does, which is a branch point of the kind (w - low)^(n/2) for all above it.
  [[nodiscard]] bool at_branch(std::size_t panel) const { return edges_[panel] == panels_[panel].piece->low; }

  struct Values {
    double i1[together] = {}, i2[together] = {};
  };
  struct WithOutside {
    Values all, outside;  // the latter of all: from frequencies outside of the measured range
  };
  /// At frequencies in one panel.
  [[nodiscard]] WithOutside at(const double (&w)[together], std::size_t panel) const;

 private:
  void add_up();
  void add_below(const double (&w)[together], std::size_t panel, Values& sum) const;
  void add_near(const double (&w)[together], std::size_t panel, Values& sum) const;

  std::vector<double> edges_;
  std::vector<AngularPanel> panels_;
  std::size_t first_measured_ = 0, end_measured_ = 0;  // panels
};

}  // namespace asperity
