// The banded likelihood of shifts against dense matrices that are written down from the definition.
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/dma.hpp"
#include "dma/shift_likelihood.hpp"
#include "numerics/random.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

constexpr double h = SplineBasis::spacing;

/// The cubic B-spline on the knots 0 to 4 as truncated powers.
double b_spline(double u) {
  double sum = 0;
  const double binomial[5] = {1, -4, 6, -4, 1};
  for (int k = 0; k < 5; ++k) sum += binomial[k] * std::pow(std::fmax(u - k, 0.0), 3);
  return u >= 4 ? 0 : sum / 6;
}

struct Dense {
  Eigen::MatrixXd basis, penalised;  // B, B^T B + P
  double logarithms;                 // sum of ln lambda
};

/// With `more` knots than are needed at either end.
Dense dense(const std::vector<double>& x, double log_penalty, double slope, int more) {
  double low = x[0], high = x[0];
  for (const double at : x) {
    low = std::fmin(low, at);
    high = std::fmax(high, at);
  }
  const double lower = std::floor(low / h) - more;
  const auto p = static_cast<Eigen::Index>(std::floor(high / h) - lower) + 4 + more;
  Dense d{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(x.size()), p), {}, 0};
  for (std::size_t i = 0; i < x.size(); ++i)
    for (Eigen::Index j = 0; j < p; ++j)
      d.basis(static_cast<Eigen::Index>(i), j) = b_spline(x[i] / h - lower - static_cast<double>(j) + 3);
  d.penalised = d.basis.transpose() * d.basis;
  for (Eigen::Index j = 0; j + 3 < p; ++j) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(p);
    difference.segment(j, 4) << -1, 3, -3, 1;
    const double l = log_penalty + slope * h * (lower + static_cast<double>(j) + 0.5);
    d.penalised += std::exp(l) * difference * difference.transpose();
    d.logarithms += l;
  }
  return d;
}

double log_determinant(const Dense& d) { return std::log(d.penalised.partialPivLu().determinant()) - d.logarithms; }

std::vector<double> scattered(std::size_t count, double from, double to, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x(count);
  for (double& at : x) at = from + (to - from) * random();
  return x;
}

std::vector<Isotherm> sweeps(double noise) {
  Random random(7);
  std::vector<Isotherm> result;
  for (int k = 0; k < 5; ++k) {
    std::vector<double> w, storage, loss;
    for (int i = 0; i < 9; ++i) {
      w.push_back(std::pow(10, 0.25 * i + 0.01 * k));
      const double x = std::log10(w.back()) - 0.7 * k;
      storage.push_back(1e6 * std::exp(x + 0.4 * std::sin(1.7 * x) + noise * random.normal()));
      loss.push_back(3e5 * std::exp(0.5 * x + 0.3 * std::cos(2 * x) + noise * random.normal()));
    }
    result.emplace_back(280 + 6.5 * k, w, storage, loss);
  }
  return result;
}

}  // namespace

TEST_CASE("coefficients, residual, determinant and inverse of a penalised spline") {
  const std::vector<double> x = scattered(40, -1.3, 2.9, 1);
  std::vector<double> y;
  for (const double at : x) y.push_back(std::sin(3 * at) + at);
  SplineBasis basis;
  basis.place(x);
  for (const double log_penalty : {-6.0, 0.0, 8.0}) {
    CAPTURE(log_penalty);
    constexpr double slope = 0.8;  // the penalty changes along the curve
    std::vector<double> penalties;
    for (std::size_t j = 0; j < basis.differences(); ++j) penalties.push_back(log_penalty + slope * basis.middle(j));
    PenalizedSpline spline;
    spline.factor(basis, penalties);
    spline.solve(basis, y);
    spline.invert();

    const Dense d = dense(x, log_penalty, slope, 0);
    const Eigen::MatrixXd inverse = d.penalised.inverse();
    const auto all = Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
    const Eigen::VectorXd c = inverse * d.basis.transpose() * all;
    REQUIRE(spline.coefficients().size() == static_cast<std::size_t>(c.size()));
    for (Eigen::Index j = 0; j < c.size(); ++j)
      CHECK_NEAR(spline.coefficients()[static_cast<std::size_t>(j)], c[j], 1e-8, 1e-8);
    CHECK_NEAR(spline.residual(), all.dot(all - d.basis * c), 1e-8, 0);
    CHECK_NEAR(spline.log_determinant(), log_determinant(d), 1e-10, 1e-9);
    CHECK_NEAR(spline.degrees_of_freedom(basis), (inverse * d.basis.transpose() * d.basis).trace(), 1e-8, 0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      CHECK_NEAR(spline.variance(basis.value[i], basis.value[i], basis.first[i]),
                 d.basis.row(at) * inverse * d.basis.row(at).transpose(), 1e-8, 0);
    }
    for (const int more : {1, 4}) {  // knots beyond the data change nothing
      const Dense wider = dense(x, log_penalty, slope, more);
      const Eigen::VectorXd wide = wider.penalised.inverse() * wider.basis.transpose() * all;
      CHECK_NEAR(log_determinant(wider), spline.log_determinant(), 1e-7, 1e-7);
      CHECK_NEAR(all.dot(all - wider.basis * wide), spline.residual(), 1e-6, 0);
    }
  }
}

TEST_CASE("white noise is correlated as the coefficients are") {
  const std::vector<double> x = scattered(25, 0, 1.1, 2);
  SplineBasis basis;
  basis.place(x);
  PenalizedSpline spline;
  spline.factor(basis, std::vector<double>(basis.differences(), 1.0));
  const Dense d = dense(x, 1, 0, 0);
  const auto p = static_cast<Eigen::Index>(basis.coefficients);
  Eigen::MatrixXd columns(p, p);
  for (Eigen::Index j = 0; j < p; ++j) {
    std::vector<double> unit(basis.coefficients, 0.0);
    unit[static_cast<std::size_t>(j)] = 1;
    columns.col(j) = Eigen::Map<const Eigen::VectorXd>(spline.correlate(unit).data(), p);
  }
  const Eigen::MatrixXd found = columns * columns.transpose(), truth = d.penalised.inverse();
  CHECK((found - truth).cwiseAbs().maxCoeff() < 1e-9 * truth.cwiseAbs().maxCoeff());
}

TEST_CASE("the likelihood of one smoothness is that of dense matrices") {
  const std::vector<Isotherm> isotherms = sweeps(0.02);
  const SweepPoints points = gather(isotherms, std::vector<double>(5, 1.0));
  const Smoothness smoothness{{std::vector<double>(5, 2.0), std::vector<double>(5, -1.0)}, {}, {0.02, 0.02}};
  ShiftLikelihood likelihood(points, smoothness);
  likelihood.floor = 0.01;
  const std::vector<double> shift{0, -0.6, -1.4, -2.0, -2.9};
  double truth = 0;
  std::vector<double> x;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t i = points.first[k]; i < points.first[k + 1]; ++i) x.push_back(points.x[i] + shift[k]);
  for (std::size_t m = 0; m < moduli; ++m) {
    const Dense d = dense(x, (m == 0 ? 2.0 : -1.0) + 0.3, 0, 0);
    const auto y = Eigen::Map<const Eigen::VectorXd>(points.y[m].data(), 45);
    const double residual = y.dot(y - d.basis * d.penalised.ldlt().solve(d.basis.transpose() * y));
    truth += 42 / 2.0 * std::log(residual / 42 + 1e-4) + log_determinant(d) / 2;
  }
  CHECK_NEAR(likelihood.data(shift, {0.3, 0.3}, nullptr), truth, 1e-9, 0);
}

TEST_CASE("the gradient is that of differences") {
  const std::vector<Isotherm> isotherms = sweeps(0.02);
  const SweepPoints points = gather(isotherms, std::vector<double>(5, 1.0));
  const Smoothness smoothness = local_smoothness(points);
  for (const auto used : {std::array{true, true}, std::array{true, false}, std::array{false, true}})
    for (const double floor : {0.03, least_noise}) {
      ShiftLikelihood likelihood(points, smoothness, used);
      likelihood.floor = floor;
      likelihood.weight = 0.7;
      Eigen::VectorXd at(6), gradient, ignored;
      at << -2.2, -2.4, -1.9, -2.6, 0.5, -0.7;
      likelihood(at, gradient);
      for (Eigen::Index i = 0; i < 6; ++i) {
        CAPTURE(i);
        constexpr double width = 1e-5;
        Eigen::VectorXd moved = at;
        moved[i] += width;
        const double above = likelihood(moved, ignored);
        moved[i] -= 2 * width;
        CHECK_NEAR(gradient[i], (above - likelihood(moved, ignored)) / (2 * width), 1e-5, 1e-5);
      }
    }
}
