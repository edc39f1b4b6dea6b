// Two isotherms at all distances, by the likelihood of the joint fit with 3 % of noise more and with an offset between
// the two that is not known: clean data have a minimum a thousandth of a decade wide, which no grid would see. The way
// through all pairs is A. J. Viterbi's (IEEE Trans. Inf. Theory 13, 260 (1967)), its steps the prior on the rate.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dma/time_temperature_shift.hpp"

namespace asperity {

namespace {

constexpr std::array<double, moduli> offset{0.02, 0.03};      // of ln E', ln E'', standard deviation
constexpr double nearest = 0.02, beyond = 1, steepest = 0.6;  // decades, decades, decades per kelvin

struct Place {
  double step, log_rate, cost;
};

class Pair {
 public:
  Pair(const SweepPoints& points, const Smoothness& smoothness, std::size_t colder)
      : points_(points), colder_(colder), count_(points.size(colder) + points.size(colder + 1)) {
    const std::size_t start = points.first[colder];
    for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
      const double noise = smoothness.noise[modulus];
      variance_[modulus] = noise * noise + noise_floors[0] * noise_floors[0];
      log_penalty_[modulus] =
          (smoothness.log_penalty[modulus][colder] + smoothness.log_penalty[modulus][colder + 1]) / 2 +
          std::log(variance_[modulus] / (noise * noise));
      y_[modulus] = std::span(points.y[modulus]).subspan(start, count_);
    }
    for (std::size_t i = 0; i < count_; ++i) apart_.push_back(i < points.size(colder) ? 0.5 : -0.5);
    moved_.assign(points.x.begin() + static_cast<std::ptrdiff_t>(start),
                  points.x.begin() + static_cast<std::ptrdiff_t>(start + count_));
  }

  /// Minus the logarithm of the likelihood with the hotter isotherm `step` below where it was measured.
  double cost(double step) {
    const std::size_t start = points_.first[colder_];
    for (std::size_t i = points_.size(colder_); i < count_; ++i) moved_[i] = points_.x[start + i] - step;
    basis_.place(moved_);
    double sum = 0;
    for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
      same_.assign(basis_.differences(), log_penalty_[modulus]);
      spline_.factor(basis_, same_);
      // the offset is one more unknown: y = B c + z d, d of known variance
      spline_.solve(basis_, apart_);
      const double zz = spline_.residual();
      spline_.solve(basis_, y_[modulus]);
      double zy = 0;
      for (std::size_t i = 0; i < count_; ++i) zy += apart_[i] * spline_.left()[i];
      const double ratio = offset[modulus] * offset[modulus] / variance_[modulus];
      const double residual = spline_.residual() - zy * zy / (zz + 1 / ratio);
      sum += residual / variance_[modulus] + spline_.log_determinant() + std::log1p(ratio * zz);
    }
    return sum / 2;
  }

 private:
  const SweepPoints& points_;
  std::size_t colder_, count_;
  std::array<double, moduli> variance_{}, log_penalty_{};
  std::array<std::span<const double>, moduli> y_;
  std::vector<double> apart_, moved_, same_;
  SplineBasis basis_;
  PenalizedSpline spline_;
};

std::vector<Place> places(const SweepPoints& points, const Smoothness& smoothness, std::size_t colder, double weight) {
  const double kelvins = points.temperature[colder + 1] - points.temperature[colder];
  // moduli side by side lie where the one ends and the other begins, wherever they were measured
  const double touch = points.upper(colder + 1) - points.lower(colder);
  const double farthest = std::max(2 * nearest, std::min(touch + beyond, steepest * kelvins));
  const double stride = std::max(0.05, farthest / 200);
  Pair pair(points, smoothness, colder);
  std::vector<Place> result;
  for (double step = nearest; step <= farthest; step += std::min(stride, step / 4))
    result.push_back({step, std::log(step / kelvins), weight * pair.cost(step)});
  return result;
}

}  // namespace

std::vector<double> search_steps(const SweepPoints& points, const Smoothness& smoothness, double weight) {
  const std::size_t pairs = points.isotherms() - 1;
  std::vector<std::vector<Place>> place(pairs);
  std::vector<std::vector<std::size_t>> from(pairs);
  for (std::size_t k = 0; k < pairs; ++k) {
    place[k] = places(points, smoothness, k, weight);
    from[k].assign(place[k].size(), 0);
    for (std::size_t i = 0; i < place[k].size(); ++i) {
      Place& here = place[k][i];
      if (k == 0) {
        here.cost += RatePrior::start(here.log_rate);
        continue;
      }
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < place[k - 1].size(); ++j) {
        const double cost = place[k - 1][j].cost + RatePrior::step(place[k - 1][j].log_rate, here.log_rate);
        if (cost < least) {
          least = cost;
          from[k][i] = j;
        }
      }
      here.cost += least;
    }
  }
  std::vector<double> steps(pairs);
  std::size_t i =
      static_cast<std::size_t>(std::ranges::min_element(place.back(), {}, &Place::cost) - place.back().begin());
  for (std::size_t k = pairs; k-- > 0; i = from[k][i]) steps[k] = place[k][i].step;
  return steps;
}

}  // namespace asperity
