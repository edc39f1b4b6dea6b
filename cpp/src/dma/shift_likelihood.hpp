// How likely the shifts of isotherms are: each modulus one cubic spline with a penalty on its third differences,
// whatever its shape, in bands of four.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asperity/dma.hpp"

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
  /// The third differences of the coefficients, and where each of them lies: in the middle of its interval.
  [[nodiscard]] std::size_t differences() const { return coefficients - 3; }
  [[nodiscard]] double middle(std::size_t difference) const {
    return lower + spacing * (static_cast<double>(difference) + 0.5);
  }
};

/// The four cubic B-splines that are not zero at t in [0, 1] of an interval.
inline std::array<double, 4> cubic_basis(double t) {
  const double s = 1 - t;
  return {1.0 / 6 * s * s * s, t * t * (0.5 * t - 1) + 2.0 / 3, s * s * (0.5 * s - 1) + 2.0 / 3, 1.0 / 6 * t * t * t};
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

inline constexpr std::size_t moduli = 2;  // storage, loss

/// Points of all isotherms in logarithms, before any shift, isotherm after isotherm.
struct SweepPoints {
  std::vector<double> x;                      // log10 w
  std::array<std::vector<double>, moduli> y;  // ln E', ln E'', vertical shift taken out
  std::vector<std::size_t> first;             // point of each isotherm, and the end
  std::vector<double> temperature;            // [K], rising

  [[nodiscard]] std::size_t isotherms() const { return temperature.size(); }
  [[nodiscard]] std::size_t size(std::size_t isotherm) const { return first[isotherm + 1] - first[isotherm]; }
  [[nodiscard]] double lower(std::size_t isotherm) const { return x[first[isotherm]]; }
  [[nodiscard]] double upper(std::size_t isotherm) const { return x[first[isotherm + 1] - 1]; }
  [[nodiscard]] double length(std::size_t isotherm) const { return upper(isotherm) - lower(isotherm); }
  [[nodiscard]] double middle(std::size_t isotherm) const { return (lower(isotherm) + upper(isotherm)) / 2; }
};
SweepPoints gather(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T);

/// ln of penalties that differ in effect: above, a spline is smooth over 2 decades.
inline constexpr double lowest_log_penalty = -16, highest_log_penalty = 12;

/// What the isotherms show of themselves, before they are shifted: how smooth the curve is where each of them lies.
struct Smoothness {
  std::array<std::vector<double>, moduli> log_penalty;  // ln(noise^2 / variance of third differences), of each
  std::array<std::vector<double>, moduli> spread;       // standard deviations of these
  std::array<double, moduli> noise;                     // standard deviation of ln E', ln E''
};
Smoothness local_smoothness(const SweepPoints& points);

/// Noise no lower than this: a clean curve too is no spline of knots 0.2 decades apart.
constexpr double least_noise = 2e-4;
/// A search begins with noise of so much more, which is then taken away in turn.
inline constexpr std::array noise_floors{0.03, 0.01, 0.003, least_noise};

/// ln(-d log10 a_T / dT) changes little from step to step. The prior steadies plateaus, where the data say nothing.
struct RatePrior {
  static constexpr double change = 0.5;                // one standard deviation
  static constexpr double first = -2.3, spread = 2.3;  // ln of 0.1 decades per kelvin, a decade up or down

  static double start(double log_rate) { return (log_rate - first) * (log_rate - first) / (2 * spread * spread); }
  static double step(double from, double to) { return (to - from) * (to - from) / (2 * change * change); }
};

/// Minus the logarithm of the likelihood of shifts, restricted (REML: D. A. Harville, J. Am. Stat. Assoc. 72, 320
/// (1977)) to what no parabola follows, for each modulus
///     (N - 3) / 2 ln RSS + 1/2 ln|B^T B + P| - 1/2 sum_j ln lambda_j,
/// RSS the minimum of the penalised spline. The determinant makes an overlap that is given up no gain: pieces apart pay
/// for the coefficients of each.
class ShiftLikelihood {
 public:
  /// `used`: whether E', E'' count.
  ShiftLikelihood(const SweepPoints& points, const Smoothness& smoothness, std::array<bool, moduli> used = {true, true})
      : points_(points), smoothness_(smoothness), used_(used), moved_(points.x.size()) {}

  double floor = least_noise;  // noise that is there at least: shifts far off are found where it is large
  double weight = 1;           // of the data against the prior: below 1 where residuals are correlated

  /// Unknowns: ln(-d log10 a_T / dT) of each step, then ln of the factor on the penalties of each modulus. Value with
  /// the prior, and its gradient.
  double operator()(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient);

  /// The data alone at given shifts [decades] and factors, or of them the sum over the moduli of (N - 3) / 2 ln RSS.
  /// Gradient: in the shifts, then in the factors.
  double data(std::span<const double> shift, const std::array<double, moduli>& log_factor,
              Eigen::VectorXd* gradient = nullptr, bool misfit_alone = false);
  /// The same of one modulus.
  double alone(std::size_t modulus, std::span<const double> shift, double log_factor);

  /// Shifts of the unknowns, the first isotherm at 0, and back.
  [[nodiscard]] std::vector<double> shifts(const Eigen::VectorXd& unknowns) const;
  [[nodiscard]] static std::array<double, moduli> log_factors(const Eigen::VectorXd& unknowns);

  // Of the last evaluation.
  [[nodiscard]] const SplineBasis& basis() const { return basis_; }
  [[nodiscard]] PenalizedSpline& spline(std::size_t modulus) { return spline_[modulus]; }
  [[nodiscard]] std::array<double, 2> ends() const;  // lowest and highest log10 w, shifted
  [[nodiscard]] const SweepPoints& points() const { return points_; }
  [[nodiscard]] const std::array<bool, moduli>& used() const { return used_; }

 private:
  void place(std::span<const double> shift);
  /// Returns (N - 3) / 2 ln RSS.
  double fit(std::size_t modulus, double log_factor);
  void add_gradient(std::size_t modulus, Eigen::VectorXd& gradient);

  const SweepPoints& points_;
  const Smoothness& smoothness_;
  std::array<bool, moduli> used_;
  std::vector<double> moved_, centre_, log_penalty_, share_, nearness_;
  SplineBasis basis_;
  std::array<PenalizedSpline, moduli> spline_;
  std::array<std::vector<double>, moduli> local_;  // ln lambda of each third difference, before the factor
  std::array<double, moduli> variance_{};
};

Sentence kelvin(const Isotherm& isotherm);

}  // namespace asperity
