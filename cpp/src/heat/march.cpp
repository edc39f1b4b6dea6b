// The curve theta = eps F(theta) is followed from theta = 0 by its length in ln theta: bordered Newton steps solve for
// ln theta and ln eps, and ln kappa with PartialContact, on a plane across the way. Neither eps nor theta(q1) serves as
// its parameter: eps turns about where there are several states, and theta(q1) where a strong line of the roughness
// runs away by itself, which heats the long waves and leaves the short ones colder. H. B. Keller, in: Applications of
// Bifurcation Theory, 359 (1977).
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "heat/fixed_point.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double flat = 0.1;              // of ln eps over a stride, where solutions may be near each other
constexpr double place_tolerance = 1e-3;  // of ln theta

/// The length of a change of x: 1 where all of it grows by a factor e.
double length_of(const VectorXd& change) { return change.norm() / std::sqrt(static_cast<double>(change.size())); }

}  // namespace

March::March(FlashMap& map, double background, const VectorXd& cold_rise)
    : map_(map), background_(background), highest_(std::fmax(highest_rubber_temperature - background, 1)) {
  constexpr double unfelt = 0.02;  // of the cold rise, and of ln a_T
  const double rate = std::numbers::ln10 * std::fabs(held_shift(map.scene().shift, background).slope);
  const double first = unfelt / std::fmax(1, rate * cold_rise.maxCoeff());
  const Index points = cold_rise.size();
  const std::optional<double> log_kappa = map.log_kappa();
  at_ = {0, first, VectorXd(points + (log_kappa ? 1 : 0)), points};
  at_.x.head(points) = (first * cold_rise).array().log();
  direction_ = VectorXd::Zero(at_.x.size());
  direction_.head(points).setOnes();
  direction_ /= length_of(direction_);
  if (log_kappa) at_.x[points] = *log_kappa;
}

/// The next place, over at most half a decade of a_T.
std::optional<Place> March::next() {
  constexpr double bend = 1.2;      // of the way to the next place over its projection
  constexpr double near_end = 0.5;  // of ln tau
  const double tau = at_.tau(), left = std::log(2 * highest_ / tau), last = direction_[at_.points - 1];
  const auto shift_at = [&](double rise) { return held_shift(map_.scene().shift, background_ + rise); };
  const ShiftValue shift = shift_at(tau);
  const double rate = tau * std::numbers::ln10 * std::fabs(shift.slope);
  const double fastest = direction_.cwiseAbs().maxCoeff();
  const double whole = std::fmin(std::log1p(2 * term_step / rate), std::fmax(left, 1)) / fastest;
  double stride = stride_ > 0 ? std::fmin(whole, 2 * stride_) : whole;
  if (last * stride > left) {
    if (left < near_end) return {};
    stride = left / last;
  }
  for (; stride > 1e-4; stride /= 2) {
    heed();
    const auto found =
        solve(at_.x + stride * direction_, direction_, at_.s + stride, 0.01 * stride, stride_ > 0 ? &slopes_ : nullptr);
    if (!found || length_of(found->x - at_.x) > bend * stride) continue;
    // where rows of a table have the slope 0 only the next values tell
    if (std::numbers::ln10 * std::fabs(shift_at(found->tau()).log10_a_T - shift.log10_a_T) > 4 * term_step) continue;
    at_ = *found;
    stride_ = stride;
    turn();
    return found;
  }
  throw NotConverged("the flash temperature is not found beyond a rise of " + show(tau, 6) + " K at q1");
}

/// Takes the direction of the curve at the place that was found last. Past a sharp turn it may lead against that of the
/// place before: along a curve the determinant keeps its sign, by which it is told apart from the way back.
void March::turn() {
  const Index n = direction_.size();
  slopes_ = slopes(at_.x);
  const auto lu = bordered(slopes_, direction_).partialPivLu();
  const VectorXd way = lu.solve(VectorXd::Unit(n + 1, n));
  if (!way.allFinite()) return;
  const bool negative = lu.determinant() < 0;
  if (!negative_) negative_ = negative;
  direction_ = (negative == *negative_ ? 1 : -1) * way.head(n) / length_of(way.head(n));
}

void March::pass(const VectorXd& x) {
  const VectorXd theta = x.head(at_.points).array().exp();
  if (x.size() > at_.points)
    map_(theta, x[at_.points]);
  else
    map_(theta);
}

/// Of the last pass: the slopes of ln F, and of what the rule of kappa is off, over x.
MatrixXd March::slopes(const VectorXd& x) {
  const Index points = at_.points;
  MatrixXd result = x.size() > points ? map_.jacobian_with_kappa() : map_.jacobian();
  result.leftCols(points) = result.leftCols(points) * x.head(points).array().exp().matrix().asDiagonal();
  result.topRows(points) = map_.rise().cwiseInverse().asDiagonal() * result.topRows(points);
  return result;
}

/// What steps of x and ln eps change of ln theta - ln F - ln eps, of the rule of kappa, and along a direction.
MatrixXd March::bordered(const MatrixXd& slopes, const VectorXd& direction) const {
  const Index n = slopes.cols(), points = at_.points;
  MatrixXd result = MatrixXd::Zero(n + 1, n + 1);
  result.topLeftCorner(n, n) = -slopes;
  result.diagonal().head(points).array() += 1;
  result.topRightCorner(points, 1).setConstant(-1);
  result.bottomLeftCorner(1, n) = direction.transpose();
  return result;
}

/// The profile of a place, with the map left there, so that roots of kappa are sought from that of the place.
VectorXd March::settled(const Place& place) {
  pass(place.x);
  return place.theta();
}

/// Where eps turns about before it is 1 at three places, one at which it is past 1, if there is one: by parabolas.
std::optional<Place> March::beyond_turn(Place low, Place middle, Place high) {
  const auto x = [](const Place& place) { return place.s; };
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
    const bool lower = at < x(middle);
    const std::optional<Place> found = lower ? solve_between(low, middle, (at - x(low)) / before)
                                             : solve_between(middle, high, (at - x(middle)) / after);
    if (!found) return {};
    if (std::signbit(y(*found)) != std::signbit(y(middle))) return found;
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
      for (int k = 1; k < parts; ++k)
        if (const auto found = solve_between(low, high, static_cast<double>(k) / parts)) result.push_back(*found);
    result.push_back(high);
  }
  places = std::move(result);
}

std::vector<std::pair<Place, Place>> March::crossings() {
  constexpr std::size_t most = 2000;
  if (at_.eps >= 1) throw NotConverged("the flash temperature: no start of the search");
  std::vector<Place> places{at_};
  while (const std::optional<Place> here = next()) {
    places.push_back(*here);
    if (places.size() > most) throw NotConverged("the flash temperature: the search for all states does not end");
  }
  divide_flat(places);
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const bool below = places[i].eps < 1;
    if ((places[i - 1].eps < 1) != below || (places[i + 1].eps < 1) != below) continue;
    if (const auto found = beyond_turn(places[i - 1], places[i], places[i + 1])) {
      const bool after = found->s > places[i].s;
      places.insert(places.begin() + static_cast<std::ptrdiff_t>(i + (after ? 1 : 0)), *found);
      ++i;
    }
  }
  std::vector<std::pair<Place, Place>> result;
  for (std::size_t i = 1; i < places.size(); ++i)
    if ((places[i].eps < 1) != (places[i - 1].eps < 1)) result.emplace_back(places[i - 1], places[i]);
  return result;
}

/// By Ridders' steps, as eps may be nearly flat.
VectorXd March::between(Place low, Place high, double near) {
  const auto y = [](const Place& place) { return std::log(place.eps); };
  const auto nearer = [&] { return std::fabs(y(low)) < std::fabs(y(high)) ? low : high; };
  constexpr int most = 60;
  for (int i = 0; i < most && std::fabs(y(nearer())) >= near && high.s - low.s >= exactly; ++i) {
    const std::optional<Place> middle = solve_between(low, high, 0.5);
    if (!middle) break;
    const double at = y(*middle), size = std::sqrt(at * at - y(low) * y(high));
    std::optional<Place> found = middle;
    if (size > 0)
      if (auto next = solve_between(low, high, 0.5 + 0.5 * (y(low) < y(high) ? -1 : 1) * at / size))
        found = std::move(next);
    std::vector<Place> places{low, *middle, *found, high};
    std::ranges::sort(places, {}, &Place::s);
    for (std::size_t k = 1; k < places.size(); ++k)
      if ((places[k].eps < 1) != (places[k - 1].eps < 1)) {
        low = places[k - 1];
        high = places[k];
        break;
      }
  }
  return settled(nearer());
}

bool March::is_between(const Place& low, const Place& high, const VectorXd& theta) {
  const VectorXd x = theta.array().log(), low_x = low.x.head(low.points), high_x = high.x.head(high.points);
  const double apart = length_of(high_x - low_x) + place_tolerance;
  return length_of(x - low_x) < apart && length_of(high_x - x) < apart;
}

/// The place on the plane across the straight line from one to the other.
std::optional<Place> March::solve_between(const Place& low, const Place& high, double share) {
  const VectorXd way = high.x - low.x;
  return solve(low.x + share * way, way / length_of(way), low.s + share * (high.s - low.s), place_tolerance, nullptr);
}

/// The place on the plane through `start` across `direction`. With the slopes of a place nearby as long as these serve.
std::optional<Place> March::solve(const VectorXd& start, const VectorXd& direction, double s, double tolerance,
                                  const MatrixXd* nearby) {
  constexpr double farthest = 1;  // of a step in ln theta
  VectorXd x = start;
  const Index n = start.size(), points = at_.points;
  double log_eps = 0, before = HUGE_VAL, way_before = HUGE_VAL;
  for (int i = 0; i < most_passes; ++i) {
    pass(x);
    if (!(map_.rise().minCoeff() > 0)) return {};
    const VectorXd log_rise = map_.rise().array().log(), theta = x.head(points).array().exp();
    if (i == 0) log_eps = x[points - 1] - log_rise[points - 1];
    VectorXd residual(n + 1);
    residual.head(points) = (log_rise - x.head(points)).array() + log_eps;
    if (n > points) residual[points] = map_.off_rule();
    residual[n] = direction.dot(start - x);
    const double of_rise = residual.head(points).cwiseProduct(theta).lpNorm<Eigen::Infinity>() / theta.maxCoeff();
    const double size = std::fmax(of_rise, n > points ? std::fabs(residual[points]) : 0);
    // near 1 it matters on which side eps is
    const bool near_1 = std::fabs(log_eps) < flat;
    if (size < (near_1 ? exactly : std::fmin(tolerance, place_tolerance)) || (size < 1e-9 && !(size < 0.5 * before)))
      return Place{s, std::exp(log_eps), x, points};
    if (nearby && !(size < before)) return solve(start, direction, s, tolerance, nullptr);
    if (!(size < slopes_serve * before) && i > 0) nearby = nullptr;
    before = size;
    VectorXd step = bordered(nearby ? *nearby : slopes(x), direction).partialPivLu().solve(residual);
    // by their own length, as a residual may rise where the curve bends
    const double way = length_of(step.head(n));
    if (!(way < way_before)) return {};
    way_before = way;
    step *= std::fmin(1, farthest / step.head(n).lpNorm<Eigen::Infinity>());
    x += step.head(n);
    log_eps += step[n];
  }
  return {};
}

}  // namespace asperity
