// L_k and K_k of a modulus known piece by piece, from I1 and I2.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "rubber/angular_interpolant.hpp"

namespace asperity {

/// Refuses rows that have not `count` times the room of `w`.
void require_harmonics(std::span<const double> w, std::size_t count, std::span<const double> loss,
                       std::span<const double> square);

/// F_n = int cos(n phi) f(w cos phi) dphi follows from F_n-2 as
///   F_n+1 = F_n-1 - 2 n A,   dA/dln w = F_n-1 - (n + 1) A,
/// whose answer to exp(i k ln w) has the factor (i k + 1 - n) / (i k + 1 + n), never above 1: no error grows with n.
/// The equations are solved by collocation at Chebyshev's zeros on cells of the panels of I1 and I2, from the tail on.
class HarmonicTable {
 public:
  HarmonicTable(const AngularTable& table, const ModulusPiece& tail, std::size_t count);
  [[nodiscard]] std::size_t count() const { return count_; }
  /// At each of `w`, into rows of w.size() for k from 1 to `count`.
  void operator()(std::span<const double> w, std::size_t count, double* loss, double* square) const;

 private:
  struct Cell {
    double low, high;  // [rad/s]
    // a polynomial's variable is (t - from) / step - 1 with t the share of the panel or its root
    double from, inverse_step, panel_low, inverse_length;
    bool root;
  };
  [[nodiscard]] std::size_t cell_of(double w, std::size_t c) const;

  std::size_t count_;
  std::vector<Cell> cells_;
  std::vector<AngularPolynomials> of_;  // count_ a cell
};

/// Tables made when first asked for, each of twice as many harmonics as the one before.
class HarmonicTables {
 public:
  const HarmonicTable& of(const AngularTable& table, const ModulusPiece& tail, std::size_t count) const;

 private:
  mutable std::mutex making_;
  mutable std::vector<std::unique_ptr<const HarmonicTable>> made_;
};

}  // namespace asperity
