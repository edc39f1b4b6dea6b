// The sums of angular_quadrature.hpp as polynomials, a panel's when first asked for.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "numerics/chebyshev.hpp"
#include "rubber/angular_quadrature.hpp"

namespace asperity {

/// Frequencies of the same exponent and first six binary digits.
inline std::uint64_t frequency_bucket(double w) { return std::bit_cast<std::uint64_t>(w) >> 46; }

/// Two polynomials side by side, on [-1, 1].
struct AngularPolynomials {
  static constexpr std::size_t order = AngularSums::together;
  static const ChebyshevZeros<order>& zeros();
  Pair coefficient[order] = {};
  /// One of them through values at the zeros; gives the sum of the sizes of its last two Chebyshev coefficients.
  double fit(const std::array<double, order>& value, std::size_t which);
  Pair operator()(double u) const {
    Pair sum = coefficient[order - 1];
    for (std::size_t k = order - 1; k-- > 0;) sum = sum * u + coefficient[k];
    return sum;
  }
  /// Several at once, as each term waits for the one before.
  static constexpr std::size_t together = 8;
  static void at(const AngularPolynomials* const (&of)[together], const double (&u)[together], Pair (&sum)[together]) {
    for (std::size_t i = 0; i < together; ++i) sum[i] = of[i]->coefficient[order - 1];
    for (std::size_t k = order - 1; k-- > 0;)
      for (std::size_t i = 0; i < together; ++i) sum[i] = sum[i] * u[i] + of[i]->coefficient[k];
  }
};

/// I1 and I2 to 1e-12, the parts that come from outside to 1e-10 of them. Where rows stand so near to each other that
/// the rounding of w shows, to 1e-10; NotConverged beyond.
class AngularTable {
 public:
  explicit AngularTable(std::span<const ModulusPiece> pieces);
  ~AngularTable();
  AngularTable(const AngularTable&) = delete;
  AngularTable& operator=(const AngularTable&) = delete;

  /// At `w`, which may miss the ends of the pieces by its rounding.
  [[nodiscard]] AngularIntegrals operator()(double w) const;
  /// At each of `w`; of any of them, whether more than 1e-7 of I1 comes from outside of the measured range, and whether
  /// it is beyond the pieces, where the values at their ends are taken. `i1_outside` may be null.
  static constexpr double least_outside = 1e-7;
  static constexpr std::size_t near = 4;  // panels or cells, which are looked at one after the other before a search
  struct Any {
    bool outside = false, beyond = false;
  };
  Any operator()(std::span<const double> w, double* i1, double* i2, double* i1_outside) const;
  [[nodiscard]] const AngularSums& sums() const { return sums_; }

 private:
  struct Part;
  using Parts = std::vector<Part>;
  [[nodiscard]] const Part& next(double at, std::size_t& panel) const;
  [[nodiscard]] const Parts& parts(std::size_t panel) const;
  void append(std::size_t panel, double t0, double t1, Parts& parts) const;

  AngularSums sums_;
  double lowest_, highest_;                            // [rad/s]
  std::vector<std::uint32_t> first_;                   // panel at the lower end of each bucket of frequencies
  std::unique_ptr<std::atomic<const Parts*>[]> made_;  // of each panel; null before its first use
};

}  // namespace asperity
