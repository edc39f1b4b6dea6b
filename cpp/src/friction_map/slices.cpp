// Polynomials over the background's temperature, the direction of sliding, or along slanted lines, through patches of
// pressure and velocity at Chebyshev's points of it.
#include "friction_map/slices.hpp"

#include <algorithm>
#include <cmath>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

constexpr int deepest = 6;  // of 64 intervals between two rows of a table of shift factors
constexpr std::size_t most_steps = 256;
constexpr std::size_t tested = 100;  // random points of an interval, and places at which nodes are chosen

}  // namespace

MapSlices::MapSlices(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress)
    : frame_(frame), rtol_(rtol), threads_(threads), progress_(progress), range_(frame.heights()) {
  if (range_[0] == range_[1]) {
    intervals_.push_back({range_[0], range_[1]});
    intervals_[0].patches.emplace_back(frame, rtol, threads, progress);
    nodes_ = checked_ = {range_[0]};
    return;
  }
  std::vector<double> ends = frame.height_cuts();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) add(ends[i], ends[i + 1], 0);
  choose_nodes();
}

MapPlace MapSlices::random_place() {
  const auto [x_lo, x_hi] = frame_.x();
  const double x = x_lo + random_() * (x_hi - x_lo);
  const auto [bottom, top] = frame_.z(x);
  return {x, bottom + random_() * (top - bottom)};
}

/// Before patches are made at 12 heights, 25 places tell whether as many will do.
bool MapSlices::is_smooth(double lower, double upper) const {
  const ChebyshevPoints<n>& points = chebyshev_points<n>();
  constexpr std::size_t a_side = 5;
  std::vector<MapPlace> at;
  std::vector<double> height;
  for (const double t : points.point)
    for (std::size_t i = 0; i < a_side; ++i)
      for (std::size_t j = 0; j < a_side; ++j) {
        const double share_x = static_cast<double>(i) / (a_side - 1), share_z = static_cast<double>(j) / (a_side - 1);
        const auto [x_lo, x_hi] = frame_.x();
        const double x = x_lo + share_x * (x_hi - x_lo);
        const auto [bottom, top] = frame_.z(x);
        at.push_back({x, bottom + share_z * (top - bottom)});
        height.push_back(std::clamp((lower + upper) / 2 + (upper - lower) / 2 * t, lower, upper));
      }
  const std::vector<MapSample> found = frame_.sample_at(at, height, threads_);
  for (std::size_t k = 0; k < a_side * a_side; ++k)
    for (std::size_t f = 0; f < 2; ++f)
      for (const std::size_t m : {n - 2, n - 1}) {
        double coefficient = 0;
        for (std::size_t i = 0; i < n; ++i) coefficient += points.transform[m][i] * found[i * a_side * a_side + k].f[f];
        if (std::fabs(coefficient) > step_share * rtol_) return false;
      }
  return true;
}

void MapSlices::add(double lower, double upper, int depth) {
  const auto halve = [&] {
    add(lower, (lower + upper) / 2, depth + 1);
    add((lower + upper) / 2, upper, depth + 1);
  };
  if (depth < deepest && !is_smooth(lower, upper)) return halve();
  Interval& interval = intervals_.emplace_back(Interval{lower, upper});
  make(interval);
  const double error = 2 * test(interval);
  if (error > 2 * step_share * rtol_ && depth < deepest) {
    intervals_.pop_back();
    return halve();
  }
  interval.error = error;
  tell(upper);
}

/// Progress up to a height; it stays where an interval that was halved is made anew.
void MapSlices::tell(double height) {
  told_ = std::fmax(told_, (height - range_[0]) / (range_[1] - range_[0]));
  if (progress_) progress_(told_);
}

void MapSlices::make(Interval& interval) {
  interval.patches.reserve(n);
  for (const double t : chebyshev_points<n>().point) {
    const double middle = (interval.lower + interval.upper) / 2, half = (interval.upper - interval.lower) / 2;
    const double height = std::clamp(middle + half * t, interval.lower, interval.upper);
    interval.patches.emplace_back(frame_.at_height(height), rtol_, threads_, std::function<void(double)>{});
    const double made = static_cast<double>(interval.patches.size()) / n;
    tell(interval.lower + made * (interval.upper - interval.lower));
  }
}

/// The largest error at random points of the interval, the last one.
double MapSlices::test(const Interval& interval) {
  std::vector<MapPlace> at;
  std::vector<double> height;
  for (std::size_t i = 0; i < tested; ++i) {
    at.push_back(random_place());
    height.push_back(interval.lower + random_() * (interval.upper - interval.lower));
  }
  const std::vector<MapSample> truth = frame_.sample_at(at, height, threads_);
  double largest = 0;
  for (std::size_t i = 0; i < tested; ++i) {
    const MapSample found = this->at(at[i], height[i]);
    for (std::size_t f = 0; f < 2; ++f) largest = std::fmax(largest, std::fabs(found.f[f] - truth[i].f[f]));
  }
  return largest;
}

MapSlices::Combination MapSlices::combination(double height) const {
  const auto above = std::ranges::upper_bound(intervals_, height, {}, &Interval::lower);
  const std::size_t k = above == intervals_.begin() ? 0 : static_cast<std::size_t>(above - intervals_.begin()) - 1;
  const double half = (intervals_[k].upper - intervals_[k].lower) / 2;
  const double t = (height - intervals_[k].lower) / half - 1;
  const Weights value = chebyshev<n>(t), slope = chebyshev_slopes<n>(t)[0];
  Combination sum{k, {}, {}};
  const ChebyshevPoints<n>& points = chebyshev_points<n>();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t m = 0; m < n; ++m) {
      sum.value[i] += points.transform[m][i] * value[m];
      sum.slope[i] += points.transform[m][i] * slope[m] / half;
    }
  return sum;
}

MapSample MapSlices::combined(const Combination& sum, std::span<const MapSample> samples) const {
  MapSample result{{0, 0}, intervals_[sum.interval].error};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t f = 0; f < 2; ++f) result.f[f] += sum.value[i] * samples[i].f[f];
    result.error += std::fabs(sum.value[i]) * samples[i].error;
  }
  return result;
}

MapSample MapSlices::at(const MapPlace& place, double height) {
  if (planes() == 1) return intervals_[0].patches[0].at(place);
  const Combination sum = combination(height);
  std::array<MapSample, n> samples;
  for (std::size_t i = 0; i < n; ++i) samples[i] = intervals_[sum.interval].patches[i].at(place);
  return combined(sum, samples);
}

std::vector<MapSample> MapSlices::column(const MapPlace& place) {
  if (planes() == 1) return {at(place, range_[0])};
  std::vector<MapSample> samples, result;
  for (Interval& interval : intervals_)
    for (MapPatches& patches : interval.patches) samples.push_back(patches.at(place));
  result.reserve(at_checked_.size());
  for (const Combination& sum : at_checked_)
    result.push_back(combined(sum, std::span(samples).subspan(sum.interval * n, n)));
  return result;
}

std::vector<MapSlopes> MapSlices::slopes(std::uint32_t band, const MapPlace& place) {
  if (planes() == 1) return {intervals_[0].patches[0].slopes(band, place)};
  std::vector<MapSlopes> samples, result;
  for (Interval& interval : intervals_)
    for (MapPatches& patches : interval.patches) samples.push_back(patches.slopes(band, place));
  for (const Combination& sum : at_nodes_)
    for (const Weights* const weights : {&sum.value, &sum.slope}) {
      MapSlopes& to = result.emplace_back(MapSlopes{});
      for (std::size_t i = 0; i < n; ++i) {
        const MapSlopes& from = samples[sum.interval * n + i];
        for (std::size_t f = 0; f < 2; ++f) {
          to.f[f] += (*weights)[i] * from.f[f];
          to.x[f] += (*weights)[i] * from.x[f];
          to.z[f] += (*weights)[i] * from.z[f];
          to.xz[f] += (*weights)[i] * from.xz[f];
        }
      }
    }
  return result;
}

void MapSlices::set_nodes(std::size_t steps) {
  nodes_.clear();
  checked_.clear();
  at_nodes_.clear();
  at_checked_.clear();
  const auto at = [&](double step) {
    return step == static_cast<double>(steps)
               ? range_[1]
               : range_[0] + step * ((range_[1] - range_[0]) / static_cast<double>(steps));
  };
  for (std::size_t i = 0; i <= steps; ++i) {
    nodes_.push_back(at(static_cast<double>(i)));
    checked_.push_back(nodes_.back());
    if (i < steps) checked_.push_back(at(static_cast<double>(i) + 0.5));
  }
  for (const double t : nodes_) at_nodes_.push_back(combination(t));
  for (const double t : checked_) at_checked_.push_back(combination(t));
}

/// The largest error of the cubics in the middles between nodes, at random places.
double MapSlices::error_between_nodes() {
  double largest = 0;
  for (std::size_t k = 0; k < tested; ++k) {
    heed();
    const MapPlace place = random_place();
    const std::vector<MapSlopes> planes = slopes(frame_.band(place.z), place);
    const std::vector<MapSample> truth = column(place);
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
      for (std::size_t f = 0; f < 2; ++f) {
        const MapSlopes* const p = &planes[2 * i];
        const double cubic = hermite(p[0].f[f], p[1].f[f], p[2].f[f], p[3].f[f], nodes_[i + 1] - nodes_[i], 0.5).value;
        largest = std::fmax(largest, std::fabs(cubic - truth[2 * i + 1].f[f]));
      }
  }
  return largest;
}

/// Errors fall as the fourth power of the step.
void MapSlices::choose_nodes() {
  for (std::size_t steps = 2 * intervals_.size();;) {
    set_nodes(steps);
    const double error = std::fmax(error_between_nodes(), frame_.error_of_shift(nodes_)),
                 allowed = 2 * step_share * rtol_;
    if (error <= allowed) return;
    const double factor = std::clamp(1.05 * std::pow(error / allowed, 0.25), 1.05, 4.0);
    const auto more = static_cast<std::size_t>(std::ceil(static_cast<double>(steps) * factor));
    if (more > most_steps)
      throw NotConverged(argument("rtol") + " = " + value(rtol_) + ": " + show(error, 3) + " was reached between " +
                         std::to_string(steps + 1) + (frame_.turns() ? " directions" : " temperatures") + " from " +
                         show(range_[0], 6) + " to " + show(range_[1], 6) + (frame_.turns() ? " rad" : " K"));
    steps = more;
  }
}

}  // namespace asperity
