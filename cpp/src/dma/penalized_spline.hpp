// A cubic spline with a penalty on its third differences, its likelihood and its gradient, in bands of four.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// Points on the cubic B-splines of equal knots: knots are multiples of `spacing`, wherever the points lie.
struct SplineBasis {
  static constexpr double spacing = 0.2;  // decades: a relaxation spectrum shows nothing finer

  double lower = 0;                          // first knot that the points need
  std::size_t coefficients = 0;              // intervals + 3
  std::vector<std::size_t> first;            // of the four coefficients of each point
  std::vector<std::array<double, 4>> value;  // their B-splines there
  std::vector<std::array<double, 4>> slope;  // and the slopes of these
  std::vector<std::array<double, 4>> gram;   // (j, j - k) of B^T B

  void place(std::span<const double> x);
  [[nodiscard]] double upper() const { return lower + spacing * static_cast<double>(coefficients - 3); }
  /// The third differences of the coefficients, and where each of them lies: in the middle of its interval.
  [[nodiscard]] std::size_t differences() const { return coefficients - 3; }
  [[nodiscard]] double middle(std::size_t difference) const {
    return lower + spacing * (static_cast<double>(difference) + 0.5);
  }
};

/// The four cubic B-splines that are not zero at t in [0, 1] of an interval.
inline std::array<double, 4> cubic_basis(double t) {
  constexpr double sixth = 1.0 / 6, two_thirds = 2.0 / 3;
  const double s = 1 - t;
  return {sixth * s * s * s, t * t * (0.5 * t - 1) + two_thirds, s * s * (0.5 * s - 1) + two_thirds, sixth * t * t * t};
}

/// The coefficients c that minimise |y - B c|^2 + sum_j lambda_j (third difference j of c)^2.
class PenalizedSpline {
  using Row = std::array<double, 4>;

 public:
  /// With penalties lambda_j = exp(log_penalty[j]), one a third difference.
  void factor(const SplineBasis& basis, std::span<const double> log_penalty);
  void solve(const SplineBasis& basis, std::span<const double> y);

  /// The minimum.
  [[nodiscard]] double residual() const { return residual_; }
  /// ln|B^T B + P| - sum_j ln lambda_j: the same for any number of knots beyond the points.
  [[nodiscard]] double log_determinant() const { return log_determinant_; }
  [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }
  [[nodiscard]] std::span<const double> left() const { return left_; }  // y - B c at each point
  /// lambda_j (third difference j of c)^2.
  [[nodiscard]] double penalized_difference(std::size_t j) const {
    const double* c = &coefficients_[j];
    const double difference = c[3] - c[0] + 3 * (c[1] - c[2]);
    return penalty_[j] * difference * difference;
  }

  /// The band of Z = (B^T B + P)^-1 (K. Takahashi, J. Fagan, M.-S. Chin, 8th PICA Conf. Proc., 63 (1973)); the next
  /// three need it.
  void invert();
  /// a^T Z b for four neighbours from `first` on.
  [[nodiscard]] double variance(const std::array<double, 4>& a, const std::array<double, 4>& b,
                                std::size_t first) const {
    const Row* z = &inverse_[first];
    return a[0] * (z[0][0] * b[0] + z[0][1] * b[1] + z[0][2] * b[2] + z[0][3] * b[3]) +
           a[1] * (z[0][1] * b[0] + z[1][0] * b[1] + z[1][1] * b[2] + z[1][2] * b[3]) +
           a[2] * (z[0][2] * b[0] + z[1][1] * b[1] + z[2][0] * b[2] + z[2][1] * b[3]) +
           a[3] * (z[0][3] * b[0] + z[1][2] * b[1] + z[2][1] * b[2] + z[3][0] * b[3]);
  }
  [[nodiscard]] double penalized_variance(std::size_t j) const;             // lambda_j times that of third difference j
  [[nodiscard]] double degrees_of_freedom(const SplineBasis& basis) const;  // trace of the hat matrix

  /// x with L^T x = D^-1/2 w, of which B^T B + P = L D L^T: for white noise w of unit variance, x has the covariance
  /// (B^T B + P)^-1.
  [[nodiscard]] std::vector<double> correlate(std::vector<double> white) const;

 private:
  std::vector<Row> band_;     // (j, j - k) of B^T B + P
  std::vector<Row> lower_;    // (j, j - k) of L, k = 1, 2, 3
  std::vector<Row> inverse_;  // (j, j + k) of the inverse
  std::vector<double> inverse_pivot_, penalty_, coefficients_, left_;
  double residual_ = 0, log_determinant_ = 0;
};

}  // namespace asperity
