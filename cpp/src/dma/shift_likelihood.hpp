// How likely the shifts of isotherms are: each modulus one penalised spline, whatever its shape.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "asperity/dma.hpp"
#include "dma/penalized_spline.hpp"

namespace asperity {

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

  /// The data alone at given shifts [decades] and factors. Gradient: in the shifts, then in the factors.
  double data(std::span<const double> shift, const std::array<double, moduli>& log_factor, Eigen::VectorXd* gradient);
  /// The same of one modulus.
  double alone(std::size_t modulus, std::span<const double> shift, double log_factor);
  /// The sum over the moduli of (N - 3) / 2 ln RSS.
  double misfit(std::span<const double> shift, const std::array<double, moduli>& log_factor);

  /// Shifts of the unknowns, the first isotherm at 0, and back.
  [[nodiscard]] std::vector<double> shifts(const Eigen::VectorXd& unknowns) const;
  [[nodiscard]] static std::array<double, moduli> log_factors(const Eigen::VectorXd& unknowns);

  // Of the last evaluation.
  [[nodiscard]] const SplineBasis& basis() const { return basis_; }
  [[nodiscard]] PenalizedSpline& spline(std::size_t modulus) { return spline_[modulus]; }
  [[nodiscard]] double variance(std::size_t modulus) const { return variance_[modulus]; }  // of the noise
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
