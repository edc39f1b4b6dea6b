// The likelihood of shifts, and its gradient in closed form: the spline's coefficients minimise RSS, so that RSS moves
// with a shift by -2 sum r B'c alone, and ln|A| by 2 sum b^T A^-1 b'.
#include "dma/shift_likelihood.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr double reach = 0.5;  // decades from an isotherm's middle to where its own smoothness counts a quarter

}  // namespace

Sentence kelvin(const Isotherm& isotherm) { return in_kelvin(isotherm.temperature()) + unit("K"); }

SweepPoints gather(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T) {
  SweepPoints points;
  points.first.push_back(0);
  for (std::size_t i = 0; i < isotherms.size(); ++i) {
    for (const double w : isotherms[i].angular_frequency()) points.x.push_back(std::log10(w));
    for (const double e : isotherms[i].storage_modulus()) points.y[0].push_back(std::log(e / b_T[i]));
    for (const double e : isotherms[i].loss_modulus()) points.y[1].push_back(std::log(e / b_T[i]));
    points.first.push_back(points.x.size());
    points.temperature.push_back(isotherms[i].temperature());
  }
  return points;
}

std::vector<double> ShiftLikelihood::shifts(const Eigen::VectorXd& unknowns) const {
  std::vector<double> shift(points_.isotherms(), 0.0);
  for (std::size_t i = 0; i + 1 < shift.size(); ++i)
    shift[i + 1] = shift[i] - std::exp(unknowns[static_cast<Eigen::Index>(i)]) *
                                  (points_.temperature[i + 1] - points_.temperature[i]);
  return shift;
}

std::array<double, moduli> ShiftLikelihood::log_factors(const Eigen::VectorXd& unknowns) {
  return {unknowns[unknowns.size() - 2], unknowns[unknowns.size() - 1]};
}

void ShiftLikelihood::place(std::span<const double> shift) {
  const std::size_t n = points_.isotherms();
  centre_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    centre_[k] = points_.middle(k) + shift[k];
    for (std::size_t i = points_.first[k]; i < points_.first[k + 1]; ++i) moved_[i] = points_.x[i] + shift[k];
  }
  basis_.place(moved_);

  // ln lambda of a third difference: the mean over the isotherms, near ones counting most
  const std::size_t m = basis_.differences();
  share_.resize(m * n);
  nearness_.resize(m * n);
  for (auto& l : local_) l.resize(m);
  for (std::size_t j = 0; j < m; ++j) {
    const double at = basis_.middle(j);
    double *share = &share_[j * n], *near = &nearness_[j * n];
    for (std::size_t k = 0; k < n; ++k) {
      near[k] = 1 / (reach * reach + (at - centre_[k]) * (at - centre_[k]));
      share[k] = near[k] * near[k];
    }
    double sum = 0, storage = 0, loss = 0;
    for (std::size_t k = 0; k < n; ++k) {
      sum += share[k];
      storage += share[k] * smoothness_.log_penalty[0][k];
      loss += share[k] * smoothness_.log_penalty[1][k];
    }
    const double whole = 1 / sum;
    for (std::size_t k = 0; k < n; ++k) share[k] *= whole;
    local_[0][j] = storage * whole;
    local_[1][j] = loss * whole;
  }
}

double ShiftLikelihood::fit(std::size_t modulus, double log_factor) {
  log_penalty_ = local_[modulus];
  for (double& l : log_penalty_) l += log_factor;
  spline_[modulus].factor(basis_, log_penalty_);
  spline_[modulus].solve(basis_, points_.y[modulus]);
  const double freedom = static_cast<double>(points_.x.size()) - 3;
  variance_[modulus] = spline_[modulus].residual() / freedom + floor * floor;
  return freedom / 2 * std::log(variance_[modulus]);
}

std::array<double, 2> ShiftLikelihood::ends() const {
  const auto [lowest, highest] = std::ranges::minmax(moved_);
  return {lowest, highest};
}

double ShiftLikelihood::alone(std::size_t modulus, std::span<const double> shift, double log_factor) {
  place(shift);
  return fit(modulus, log_factor) + spline_[modulus].log_determinant() / 2;
}

double ShiftLikelihood::data(std::span<const double> shift, const std::array<double, moduli>& log_factor,
                             Eigen::VectorXd* gradient, bool misfit_alone) {
  place(shift);
  if (gradient) gradient->setZero(static_cast<Eigen::Index>(shift.size() + moduli));
  double sum = 0;
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    if (!used_[modulus]) continue;
    sum += fit(modulus, log_factor[modulus]);
    if (!misfit_alone) sum += spline_[modulus].log_determinant() / 2;
    if (gradient) add_gradient(modulus, *gradient);
  }
  return sum;
}

void ShiftLikelihood::add_gradient(std::size_t modulus, Eigen::VectorXd& gradient) {
  PenalizedSpline& spline = spline_[modulus];
  spline.invert();
  const std::size_t n = points_.isotherms();
  const std::vector<double>& c = spline.coefficients();
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0;
    for (std::size_t i = points_.first[k]; i < points_.first[k + 1]; ++i) {
      const auto& slope = basis_.slope[i];
      double steep = 0;
      for (std::size_t j = 0; j < 4; ++j) steep += slope[j] * c[basis_.first[i] + j];
      sum += spline.variance(basis_.value[i], slope, basis_.first[i]) - spline.left()[i] * steep / variance_[modulus];
    }
    gradient[static_cast<Eigen::Index>(k)] += sum;
  }
  const auto factor = static_cast<Eigen::Index>(n + modulus);
  for (std::size_t j = 0; j < basis_.differences(); ++j) {
    const double slope =
        (spline.penalized_difference(j) / variance_[modulus] + spline.penalized_variance(j) - 1) / 2;  // in ln lambda_j
    gradient[factor] += slope;
    const double *share = &share_[j * n], *near = &nearness_[j * n];
    for (std::size_t k = 0; k < n; ++k)
      gradient[static_cast<Eigen::Index>(k)] += slope * share[k] *
                                                (smoothness_.log_penalty[modulus][k] - local_[modulus][j]) * 4 *
                                                (basis_.middle(j) - centre_[k]) * near[k];
  }
}

double ShiftLikelihood::operator()(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient) {
  const std::vector<double> shift = shifts(unknowns);
  const auto steps = static_cast<Eigen::Index>(shift.size()) - 1;
  Eigen::VectorXd of_data;
  double value = weight * data(shift, log_factors(unknowns), &of_data);
  gradient.resize(unknowns.size());
  double beyond = 0;  // a step moves all isotherms beyond it
  for (Eigen::Index i = steps; i-- > 0;) {
    beyond += of_data[i + 1];
    const auto at = static_cast<std::size_t>(i);
    gradient[i] = weight * beyond * (shift[at + 1] - shift[at]);
  }
  value += RatePrior::start(unknowns[0]);
  gradient[0] += (unknowns[0] - RatePrior::first) / (RatePrior::spread * RatePrior::spread);
  for (Eigen::Index i = 0; i + 1 < steps; ++i) {
    value += RatePrior::step(unknowns[i], unknowns[i + 1]);
    const double slope = (unknowns[i + 1] - unknowns[i]) / (RatePrior::change * RatePrior::change);
    gradient[i] -= slope;
    gradient[i + 1] += slope;
  }
  for (Eigen::Index m = 0; m < 2; ++m) {  // where the data do not tell the smoothness, that of single isotherms
    constexpr double spread = 2;
    const double f = unknowns[steps + m];
    value += f * f / (2 * spread * spread);
    gradient[steps + m] = weight * of_data[steps + 1 + m] + f / (spread * spread);
  }
  return value;
}

}  // namespace asperity
