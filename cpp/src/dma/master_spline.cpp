#include "dma/master_spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

/// The four cubic B-splines that are not zero at t in [0, 1] of an interval, or their slopes in t.
std::array<double, 4> basis(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
}
std::array<double, 4> basis_slope(double t) {
  const double s = 1 - t;
  return {-s * s / 2, (3 * t * t - 4 * t) / 2, -(3 * s * s - 4 * s) / 2, t * t / 2};
}

/// Knots over a range, with room for shifts to move points.
struct Knots {
  double lower, spacing;
  Eigen::Index intervals;

  Knots(double lowest, double highest, double wanted) {
    intervals = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil((highest - lowest) / wanted)));
    spacing = (highest - lowest) / static_cast<double>(intervals);
    lower = lowest;
  }
  [[nodiscard]] Eigen::Index coefficients() const { return intervals + 3; }
  /// Interval that holds x, points beyond the ends going to the last ones.
  [[nodiscard]] Eigen::Index interval(double x) const {
    const auto i = static_cast<Eigen::Index>(std::floor((x - lower) / spacing));
    return std::clamp<Eigen::Index>(i, 0, intervals - 1);
  }
  [[nodiscard]] double within(double x, Eigen::Index i) const { return (x - lower) / spacing - static_cast<double>(i); }
};

struct Solution {
  Eigen::VectorXd storage, loss;            // coefficients
  Eigen::VectorXd storage_left, loss_left;  // what is left of each point
  double trace;                             // of the hat matrix: coefficients that the data determine
};

/// Normal equations of the shifts: of Gauss and Newton, J^T J and J^T r.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

/// The splines for given shifts: linear least squares, with so weak a pull towards small second differences that it
/// matters in intervals without points only. Each point has four coefficients to itself, which all sums here go over.
class Splines {
 public:
  Splines(const SweepPoints& points, const Knots& knots, const Eigen::VectorXd& shift)
      : points_(points), knots_(knots), place_(points.isotherm.size()), weight_(points.isotherm.size()) {
    const Eigen::Index p = knots.coefficients();
    data_ = Eigen::MatrixXd::Zero(p, p);
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const double x = points.x[static_cast<Eigen::Index>(i)] + shift[points.isotherm[i]];
      place_[i] = knots.interval(x);
      within_.push_back(knots.within(x, place_[i]));
      weight_[i] = basis(within_[i]);
      for (Eigen::Index j = 0; j < 4; ++j)
        for (Eigen::Index k = 0; k < 4; ++k)
          data_(place_[i] + j, place_[i] + k) += at(weight_[i], j) * at(weight_[i], k);
    }
    Eigen::MatrixXd normal = data_;
    constexpr double pull = 1e-9;
    const Eigen::Vector3d d(1, -2, 1);
    for (Eigen::Index j = 0; j + 2 < p; ++j) normal.block<3, 3>(j, j) += pull * d * d.transpose();
    factor_.compute(normal);
  }

  [[nodiscard]] Solution solve() const {
    Solution s;
    s.storage = coefficients(points_.storage);
    s.loss = coefficients(points_.loss);
    s.storage_left = left(points_.storage, s.storage);
    s.loss_left = left(points_.loss, s.loss);
    s.trace = factor_.solve(data_).trace();
    return s;
  }

  /// What is left changes with a shift by the spline's slope D at the isotherm's points, less what the spline itself
  /// follows of it (Kaufman's variable projection, BIT 15, 49 (1975)): J = D - B (B^T B)^-1 B^T D, B the basis. Then
  /// J^T J = D^T D - (B^T D)^T (B^T B)^-1 B^T D, and J^T r = D^T r, since B^T r = 0.
  [[nodiscard]] Normal normal(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& left,
                              Eigen::Index fixed) const {
    const Eigen::Index shifts = points_.isotherms - 1;
    Normal result{Eigen::MatrixXd::Zero(shifts, shifts), Eigen::VectorXd::Zero(shifts)};
    Eigen::MatrixXd followed = Eigen::MatrixXd::Zero(knots_.coefficients(), shifts);  // B^T D
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const Eigen::Index curve = points_.isotherm[i];
      if (curve == fixed) continue;
      const Eigen::Index column = curve < fixed ? curve : curve - 1;
      const auto b = basis_slope(within_[i]);
      double slope = 0;
      for (Eigen::Index j = 0; j < 4; ++j) slope -= at(b, j) * coefficients[place_[i] + j] / knots_.spacing;
      result.matrix(column, column) += slope * slope;
      result.right[column] += slope * left[static_cast<Eigen::Index>(i)];
      for (Eigen::Index j = 0; j < 4; ++j) followed(place_[i] + j, column) += at(weight_[i], j) * slope;
    }
    result.matrix -= followed.transpose() * factor_.solve(followed);
    return result;
  }

 private:
  static double at(const std::array<double, 4>& b, Eigen::Index j) { return b[static_cast<std::size_t>(j)]; }

  [[nodiscard]] Eigen::VectorXd coefficients(const Eigen::VectorXd& y) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(knots_.coefficients());
    for (std::size_t i = 0; i < place_.size(); ++i)
      for (Eigen::Index j = 0; j < 4; ++j) right[place_[i] + j] += at(weight_[i], j) * y[static_cast<Eigen::Index>(i)];
    return factor_.solve(right);
  }
  [[nodiscard]] Eigen::VectorXd left(Eigen::VectorXd y, const Eigen::VectorXd& c) const {
    for (std::size_t i = 0; i < place_.size(); ++i)
      for (Eigen::Index j = 0; j < 4; ++j) y[static_cast<Eigen::Index>(i)] -= at(weight_[i], j) * c[place_[i] + j];
    return y;
  }

  const SweepPoints& points_;
  const Knots& knots_;
  std::vector<Eigen::Index> place_;            // first of the four coefficients of each point
  std::vector<std::array<double, 4>> weight_;  // and their basis functions there
  std::vector<double> within_;
  Eigen::MatrixXd data_;  // B^T B
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

/// Lowest and highest x once shifted.
std::array<double, 2> ends(const SweepPoints& p, const Eigen::VectorXd& shift) {
  const Eigen::VectorXd x = p.x + shift(p.isotherm);
  return {x.minCoeff(), x.maxCoeff()};
}

double rms(const Eigen::VectorXd& v, double freedom) { return std::sqrt(v.squaredNorm() / std::max(1.0, freedom)); }

/// Gauss-Newton in the shifts (all but `fixed`, none where it is -1) with knots some `wanted` apart, E' and E''
/// weighted by what is left of each.
MasterSpline fit_with_knots(const SweepPoints& points, Eigen::VectorXd shift, Eigen::Index fixed, double wanted) {
  const auto n = static_cast<double>(points.x.size());
  MasterSpline result;
  double weight = 1;  // of E'' against E': the ratio of their variances
  constexpr int last_round = 29;
  for (int round = 0; round <= last_round; ++round) {
    const auto [lowest, highest] = ends(points, shift);
    const Knots knots(lowest, highest, wanted);
    const Splines splines(points, knots, shift);
    const Solution s = splines.solve();
    const double freedom = n - s.trace - static_cast<double>(points.isotherms - 1) / 2;
    const double storage = rms(s.storage_left, freedom), loss = rms(s.loss_left, freedom);
    constexpr double most = 16;  // neither is left out, however smooth the other
    if (round > 0) weight = std::clamp(storage * storage / std::max(loss * loss, 1e-300), 1 / most, most);
    result.lower = knots.lower;
    result.spacing = knots.spacing;
    result.storage = s.storage;
    result.loss = s.loss;
    result.shift = shift;
    result.storage_residual = storage;
    result.loss_residual = loss;
    result.validation = (s.storage_left.squaredNorm() + s.loss_left.squaredNorm()) / n / std::pow(freedom / n, 2);
    if (fixed < 0) break;
    const Normal of_storage = splines.normal(s.storage, s.storage_left, fixed);
    const Normal of_loss = splines.normal(s.loss, s.loss_left, fixed);
    Eigen::MatrixXd normal = of_storage.matrix + weight * of_loss.matrix;
    const Eigen::VectorXd right = of_storage.right + weight * of_loss.right;
    // a plateau leaves a shift without a slope to hold on to: a small multiple of the identity makes its variance
    // large, not infinite, and its step small
    normal.diagonal().array() += 1e-12 * std::max(1e-30, normal.diagonal().maxCoeff());
    const Eigen::LDLT<Eigen::MatrixXd> factor(normal);
    Eigen::VectorXd step = -factor.solve(right);
    const double longest = step.size() ? step.cwiseAbs().maxCoeff() : 0;
    constexpr double stride = 0.5;  // of a step, in ln w: the slopes hold near by only
    if (longest > stride) step *= stride / longest;

    if (longest < 1e-9 || round == last_round) {
      result.covariance = storage * storage * factor.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
      break;
    }
    for (Eigen::Index i = 0, k = 0; i < shift.size(); ++i)
      if (i != fixed) shift[i] += step[k++];
  }
  return result;
}

}  // namespace

Eigen::Vector2d MasterSpline::at(double x) const {
  const auto intervals = storage.size() - 3;
  const auto k =
      std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor((x - lower) / spacing)), 0, intervals - 1);
  const auto b = basis((x - lower) / spacing - static_cast<double>(k));
  Eigen::Vector2d value(0, 0);
  for (Eigen::Index j = 0; j < 4; ++j)
    value += b[static_cast<std::size_t>(j)] * Eigen::Vector2d(storage[k + j], loss[k + j]);
  return value;
}

namespace {

// The distance of knots by generalised cross-validation: fine where the data are clean, coarse where they scatter.
MasterSpline best_spline(const SweepPoints& points, Eigen::VectorXd shift, Eigen::Index fixed) {
  constexpr double decade = 2.302585092994046;
  MasterSpline best = fit_with_knots(points, shift, fixed, 2 * decade);
  for (const double wanted : {1.4, 1.0, 0.7, 0.5, 0.35, 0.25, 0.18}) {
    const MasterSpline found = fit_with_knots(points, best.shift, fixed, wanted * decade);
    if (2 * (found.storage.size() + points.isotherms) > points.x.size()) break;  // too few points for these
    if (found.validation < best.validation) best = found;
  }
  return best;
}

}  // namespace

MasterSpline fit_master_spline(const SweepPoints& points, const Eigen::VectorXd& start, Eigen::Index fixed) {
  return best_spline(points, start, fixed);
}

MasterSpline refit_master_spline(const SweepPoints& points, const MasterSpline& first, Eigen::Index fixed) {
  return fit_with_knots(points, first.shift, fixed, first.spacing);
}

MasterSpline master_spline_at(const SweepPoints& points, const Eigen::VectorXd& shift) {
  return best_spline(points, shift, -1);
}

}  // namespace asperity
