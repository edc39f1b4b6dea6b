// theta = eps F(theta) with theta(q1) = tau given is solved for the profile and eps by bordered Newton steps, from tau
// to tau: the shape hardly depends on tau, so that this does not fail where Newton's steps in theta do.
#include "heat/march.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double flat = 0.1;       // of ln eps over a stride, where solutions may be near each other
constexpr double exactly = 1e-12;  // of tau

}  // namespace

MatrixXd identity_less(const MatrixXd& jacobian, double factor) {
  MatrixXd matrix = -factor * jacobian;
  matrix.diagonal().array() += 1;
  return matrix;
}

March::March(FlashMap& map, double background, const VectorXd& cold_rise)
    : map_(map), background_(background), highest_(std::fmax(highest_rubber_temperature - background, 1)) {
  const Index last = cold_rise.size() - 1;
  constexpr double first = 0.02;
  at_ = {first * cold_rise[last], first, first * cold_rise};
}

/// The next place, at up to twice the tau and half a decade of a_T.
std::optional<Place> March::next() {
  constexpr double longest = 1.2;  // of ln a_T, over which no term of a rubber comes and goes
  const ShiftValue shift = held_shift(map_.scene().shift, background_ + at_.tau);
  const double rate = at_.tau * std::numbers::ln10 * std::fabs(shift.slope);
  for (double stride = std::fmin(std::numbers::ln2, std::log1p(longest / rate)); stride > 1e-4; stride /= 2) {
    heed();
    const double tau = at_.tau * std::exp(stride);
    if (tau > 2 * highest_) return {};
    if (auto found = solve(tau)) {
      at_ = *found;
      return found;
    }
  }
  throw NotConverged("the flash temperature is not found beyond a rise of " + show(at_.tau, 6) + " K at q1");
}

/// Where eps turns about before it is 1 at three places, one at which it is past 1, if there is one: by parabolas.
std::optional<Place> March::beyond_turn(Place low, Place middle, Place high) {
  const auto x = [](const Place& place) { return std::log(place.tau); };
  const auto y = [](const Place& place) { return std::log(place.eps); };
  const auto nearer = [&](const Place& a, const Place& b) { return std::fabs(y(a)) < std::fabs(y(b)); };
  for (int i = 0; i < 8 && nearer(middle, low) && nearer(middle, high); ++i) {
    const double before = x(middle) - x(low), after = x(high) - x(middle);
    const double rise = (y(middle) - y(low)) / before, next = (y(high) - y(middle)) / after;
    const double turn = x(middle) + (rise * after + next * before) / (rise - next) / 2;
    const double least = 0.05 * (before + after), off = turn - x(middle);
    const bool into_longer = std::fabs(off) < least;
    const double at = into_longer ? x(middle) + (after > before ? least : -least) : turn;
    const double expected = y(middle) - (rise - next) / (before + after) * off * off;
    if (i > 1 && std::fabs(expected) > 0.9 * std::fabs(y(middle)) && !std::signbit(expected * y(middle))) return {};
    at_ = middle;
    const std::optional<Place> found = solve(std::exp(at));
    if (!found) return {};
    if (std::signbit(y(*found)) != std::signbit(y(middle))) return found;
    const bool lower = at < x(middle);
    if (nearer(*found, middle)) {
      (lower ? high : low) = middle;
      middle = *found;
    } else {
      (lower ? low : high) = *found;
    }
  }
  return {};
}

/// More places where eps hardly differs from 1 over a stride: there it may pass through 1 to and fro.
void March::divide_flat(std::vector<Place>& places) {
  constexpr int parts = 8;
  std::vector<Place> result{places.front()};
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Place &low = places[i - 1], &high = places[i];
    if (std::fabs(std::log(low.eps)) + std::fabs(std::log(high.eps)) < flat)
      for (int k = 1; k < parts; ++k) {
        at_ = result.back();
        if (const auto found = solve(low.tau * std::pow(high.tau / low.tau, static_cast<double>(k) / parts)))
          result.push_back(*found);
      }
    result.push_back(high);
  }
  places = std::move(result);
}

std::vector<std::pair<Place, Place>> March::crossings() {
  if (at_.eps >= 1) throw NotConverged("the flash temperature: no start of the search");
  std::vector<Place> places{at_};
  while (const std::optional<Place> here = next()) places.push_back(*here);
  divide_flat(places);
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const bool below = places[i].eps < 1;
    if ((places[i - 1].eps < 1) != below || (places[i + 1].eps < 1) != below) continue;
    if (const auto found = beyond_turn(places[i - 1], places[i], places[i + 1])) {
      const bool after = found->tau > places[i].tau;
      places.insert(places.begin() + static_cast<std::ptrdiff_t>(i + (after ? 1 : 0)), *found);
      ++i;
    }
  }
  std::vector<std::pair<Place, Place>> result;
  for (std::size_t i = 1; i < places.size(); ++i)
    if ((places[i].eps < 1) != (places[i - 1].eps < 1)) result.emplace_back(places[i - 1], places[i]);
  return result;
}

VectorXd March::between(Place low, Place high, double near) {
  double from = std::log(low.eps), to = std::log(high.eps);
  for (int i = 0; i < 40; ++i) {
    const Place& nearer = std::fabs(from) < std::fabs(to) ? low : high;
    if (std::fabs(std::log(nearer.eps)) < near) return nearer.theta;
    const double share = i % 3 == 2 ? 0.5 : std::clamp(from / (from - to), 0.05, 0.95);
    const double tau = low.tau * std::pow(high.tau / low.tau, share);
    at_ = nearer;
    const std::optional<Place> found = solve(tau);
    if (!found) break;
    if ((std::log(found->eps) < 0) == (from < 0)) {
      low = *found;
      from = std::log(low.eps);
    } else {
      high = *found;
      to = std::log(high.eps);
    }
  }
  return std::fabs(from) < std::fabs(to) ? low.theta : high.theta;
}

/// By Ridders' steps, as eps may be nearly flat.
std::optional<VectorXd> March::root(Place low, Place high) {
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    const double x_low = std::log(low.tau), x_high = std::log(high.tau);
    const double y_low = std::log(low.eps), y_high = std::log(high.eps);
    at_ = std::fabs(y_low) < std::fabs(y_high) ? low : high;
    if (std::fabs(std::log(at_.eps)) < 10 * exactly || x_high - x_low < exactly) return at_.theta;
    const std::optional<Place> middle = solve(std::exp((x_low + x_high) / 2));
    if (!middle) return {};
    const double y = std::log(middle->eps), size = std::sqrt(y * y - y_low * y_high);
    std::optional<Place> found = middle;
    if (size > 0) {
      const double x = (x_low + x_high) / 2 + (x_high - x_low) / 2 * (y_low < y_high ? -1 : 1) * y / size;
      at_ = *middle;
      if (auto next = solve(std::exp(x))) found = std::move(next);
    }
    std::vector<Place> places{low, *middle, *found, high};
    std::ranges::sort(places, {}, &Place::tau);
    for (std::size_t k = 1; k < places.size(); ++k)
      if ((places[k].eps < 1) != (places[k - 1].eps < 1)) {
        low = places[k - 1];
        high = places[k];
        break;
      }
  }
  return {};
}

std::optional<Place> March::solve(double tau) {
  const double grown = tau / at_.tau;
  VectorXd theta = at_.theta * grown;
  const Index n = theta.size();
  double eps = at_.eps;
  double before = HUGE_VAL;
  for (int pass = 0; pass < 12; ++pass) {
    map_(theta);
    if (pass == 0) eps = theta[n - 1] / map_.rise()[n - 1];
    const VectorXd residual = eps * map_.rise() - theta;
    const double size = residual.lpNorm<Eigen::Infinity>() / tau;
    // near 1 it matters on which side eps is
    const bool near_1 = std::fabs(eps - 1) < flat;
    if (size < (near_1 ? exactly : 1e-3) || (size < 1e-9 && !(size < 0.5 * before))) return Place{tau, eps, theta};
    if (!(size < 2 * before)) return {};
    before = size;
    MatrixXd bordered(n + 1, n + 1);
    bordered.topLeftCorner(n, n) = identity_less(map_.jacobian(), eps);
    bordered.topRightCorner(n, 1) = -map_.rise();
    bordered.bottomRows(1).setZero();
    bordered(n, n - 1) = 1;
    VectorXd right(n + 1);
    right.head(n) = residual;
    right[n] = tau - theta[n - 1];
    const VectorXd step = bordered.partialPivLu().solve(right);
    if (!step.allFinite()) return {};
    theta = (theta + step.head(n)).cwiseMax(0.0);
    eps += step[n];
    if (!(eps > 0)) return {};
  }
  return {};
}

}  // namespace asperity
