// L_k and K_k of a modulus known piece by piece, from I1 and I2.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "rubber/angular_interpolant.hpp"

namespace asperity {

/// For how many rows of as many entries as `w` both have room; refuses other sizes.
std::size_t harmonics_in(std::span<const double> w, std::span<const double> loss, std::span<const double> square);

/// F_n = int cos(n phi) f(w cos phi) dphi follows from F_n-2 as
///   F_n+1 = F_n-1 - 2 n A,   dA/dln w = F_n-1 - (n + 1) A,
/// whose answer to exp(i k ln w) has the factor (i k + 1 - n) / (i k + 1 + n), never above 1: no error grows with n.
/// The equations are solved by collocation at Chebyshev's zeros on cells of the panels of I1 and I2, from the tail on.
class HarmonicTable {
 public:
  HarmonicTable(const AngularTable& table, const ModulusPiece& tail, std::size_t count);
  [[nodiscard]] std::size_t count() const { return count_; }
  /// I1 and I2 at each of `w`, and into rows of w.size() those for k from 1 to `count`; whether more than 1e-7 of an I1
  /// comes from outside of the measured range. `i1_outside` may be null.
  bool operator()(std::span<const double> w, std::size_t count, double* i1, double* i2, double* i1_outside,
                  double* loss, double* square) const;

 private:
  struct Cell {
    // a polynomial's variable is linear in the share of the panel or in its root
    double panel_low, inverse_length, by_root, by_share, shift;
    bool has_outside;
  };

  static constexpr std::size_t order = AngularPolynomials::order;
  std::size_t count_, width_;  // of harmonics, and of a row of coefficients
  double lowest_;              // [rad/s]
  std::vector<Cell> cells_;
  std::vector<double> high_;          // of the cells
  std::vector<std::uint32_t> first_;  // cell that reaches into each bucket of frequencies
  std::vector<double> coefficient_;   // of each cell `order` rows with those of I1, I2, L_1, K_1 and so on
  std::vector<double> outside_;       // and as many with that of the part outside, which few cells have
};

/// Tables made when first asked for, each of twice as many harmonics as the one before.
class HarmonicTables {
 public:
  const HarmonicTable& of(const AngularTable& table, const ModulusPiece& tail, std::size_t count) const;

 private:
  mutable std::mutex making_;
  mutable std::atomic<const HarmonicTable*> last_{nullptr};
  mutable std::vector<std::unique_ptr<const HarmonicTable>> made_;
};

}  // namespace asperity
