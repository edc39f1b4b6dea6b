#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "asperity/surface.hpp"
#include "checks.hpp"

namespace asperity {

namespace {

using Index = std::ptrdiff_t;
using Point = std::array<Index, 2>;  // y, x

/// Which side of the line a -> b the point c is on: the sign, 0 on it. Exact.
Index side(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Heights with drop-outs, filled in place; a plane comes back as it was.
class Filler {
 public:
  Filler(std::vector<double>& z, HeightMap::Shape shape, HeightMap::PixelSize pixel)
      : z_(z), ny_(static_cast<Index>(shape[0])), nx_(static_cast<Index>(shape[1])), pixel_(pixel) {}

  void fill() {
    const std::vector<Point> hull = measured_hull();
    do {
      while (pass_along_axes()) {
      }
    } while (pass_along_hull(hull));
    nearest();
  }

 private:
  [[nodiscard]] std::size_t at(Index y, Index x) const { return static_cast<std::size_t>(y * nx_ + x); }
  [[nodiscard]] bool missing(Index y, Index x) const { return std::isnan(z_[at(y, x)]); }
  [[nodiscard]] bool inside(Index y, Index x) const { return y >= 0 && y < ny_ && x >= 0 && x < nx_; }

  /// Linear between the two known points that bracket a gap of a row or a column; where both do, weighted by the
  /// inverse square of the gap: the nearer pair knows better. True where anything was filled.
  bool pass_along_axes() {
    value_.assign(z_.size(), 0);
    weight_.assign(z_.size(), 0);
    for (Index y = 0; y < ny_; ++y) line(y * nx_, 1, nx_, pixel_[1]);
    for (Index x = 0; x < nx_; ++x) line(x, nx_, ny_, pixel_[0]);
    bool filled = false;
    for (std::size_t i = 0; i < z_.size(); ++i)
      if (weight_[i] > 0) {
        z_[i] = value_[i] / weight_[i];
        filled = true;
      }
    return filled;
  }

  void line(Index start, Index stride, Index length, double spacing) {
    const auto point = [&](Index i) { return static_cast<std::size_t>(start + i * stride); };
    Index last = -1;  // the last known point
    for (Index i = 0; i < length; ++i) {
      if (std::isnan(z_[point(i)])) continue;
      if (last >= 0 && i > last + 1) {
        const double gap = static_cast<double>(i - last) * spacing, weight = 1 / (gap * gap);
        for (Index j = last + 1; j < i; ++j) {
          const double t = static_cast<double>(j - last) / static_cast<double>(i - last);
          value_[point(j)] += weight * (z_[point(last)] * (1 - t) + z_[point(i)] * t);
          weight_[point(j)] += weight;
        }
      }
      last = i;
    }
  }

  /// Corners of the convex hull of the measured points, in order (Andrew's monotone chain; only the first and the
  /// last measured point of a row can be on it).
  [[nodiscard]] std::vector<Point> measured_hull() const {
    std::vector<Point> ends;
    for (Index y = 0; y < ny_; ++y) {
      Index first = 0, last = nx_ - 1;
      while (first < nx_ && missing(y, first)) ++first;
      if (first == nx_) continue;
      while (missing(y, last)) --last;
      ends.push_back({y, first});
      if (last != first) ends.push_back({y, last});
    }
    std::vector<Point> hull;
    const auto chain = [&](const auto& begin, const auto& end) {
      const std::size_t base = hull.size();
      for (auto p = begin; p != end; ++p) {
        while (hull.size() >= base + 2 && side(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
        hull.push_back(*p);
      }
      hull.pop_back();
    };
    chain(ends.begin(), ends.end());
    chain(ends.rbegin(), ends.rend());
    return hull;
  }

  /// What no row and no column brackets lies in a pocket behind an edge of the hull, or outside of it. In a pocket
  /// the two known points of a line parallel to that edge bracket it. True where anything was filled.
  bool pass_along_hull(const std::vector<Point>& hull) {
    std::vector<Point> steps;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point a = hull[i], b = hull[(i + 1) % hull.size()];
      const Index dy = b[0] - a[0], dx = b[1] - a[1], divisor = std::gcd(dy, dx);
      if (dy != 0 && dx != 0) steps.push_back({dy / divisor, dx / divisor});
    }
    const auto in_hull = [&](const Point& p) {
      for (std::size_t i = 0; i < hull.size(); ++i)
        if (side(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
      return true;
    };
    std::vector<std::pair<std::size_t, double>> found;
    for (Index y = 0; y < ny_; ++y)
      for (Index x = 0; x < nx_; ++x) {
        if (!missing(y, x) || steps.empty() || !in_hull({y, x})) continue;
        double shortest = std::numeric_limits<double>::infinity(), height = 0;
        for (const Point& step : steps) {
          const Index back = reach(y, x, -step[0], -step[1]), ahead = reach(y, x, step[0], step[1]);
          if (back == 0 || ahead == 0) continue;
          const double length =
              static_cast<double>(back + ahead) *
              std::hypot(static_cast<double>(step[0]) * pixel_[0], static_cast<double>(step[1]) * pixel_[1]);
          if (length >= shortest) continue;
          shortest = length;
          const double t = static_cast<double>(back) / static_cast<double>(back + ahead);
          height = z_[at(y - back * step[0], x - back * step[1])] * (1 - t) +
                   z_[at(y + ahead * step[0], x + ahead * step[1])] * t;
        }
        if (std::isfinite(shortest)) found.emplace_back(at(y, x), height);
      }
    for (const auto& [i, height] : found) z_[i] = height;
    return !found.empty();
  }

  /// Steps from (y, x) to the next known point, 0 where there is none.
  [[nodiscard]] Index reach(Index y, Index x, Index dy, Index dx) const {
    for (Index n = 1; inside(y + n * dy, x + n * dx); ++n)
      if (!missing(y + n * dy, x + n * dx)) return n;
    return 0;
  }

  /// The rest, outside of the hull, takes the height of the nearest point that is known, by an exact distance
  /// transform (P. Felzenszwalb, D. Huttenlocher, Theory of Computing 8, 415 (2012)): the nearest known point of
  /// each column first, then in each row the lower envelope of the parabolas that the columns stand for.
  void nearest() {
    if (std::ranges::none_of(z_, [](double z) { return std::isnan(z); })) return;
    std::vector<Index> row_of(z_.size(), -1);  // of the nearest known point in the same column
    for (Index x = 0; x < nx_; ++x) {
      Index last = -1;
      for (Index y = 0; y < ny_; ++y) {
        if (!missing(y, x)) last = y;
        row_of[at(y, x)] = last;
      }
      last = -1;
      for (Index y = ny_; y-- > 0;) {
        if (!missing(y, x)) last = y;
        Index& best = row_of[at(y, x)];
        if (last >= 0 && (best < 0 || last - y < y - best)) best = last;
      }
    }
    const std::vector<double> known = z_;
    for (Index y = 0; y < ny_; ++y) nearest_in_row(y, row_of, known);
  }

  void nearest_in_row(Index y, const std::vector<Index>& row_of, const std::vector<double>& known) {
    const double aspect = pixel_[0] / pixel_[1];
    const auto height = [&](Index x) {  // squared distance to the column's point, in units of dx
      const double d = static_cast<double>(row_of[at(y, x)] - y) * aspect;
      return d * d;
    };
    std::vector<Index> column;  // whose parabola is lowest from `start` on
    std::vector<double> start;
    for (Index x = 0; x < nx_; ++x) {
      if (row_of[at(y, x)] < 0) continue;
      double from = -std::numeric_limits<double>::infinity();
      while (!column.empty()) {
        const Index other = column.back();
        const double a = static_cast<double>(x), b = static_cast<double>(other);
        from = ((height(x) + a * a) - (height(other) + b * b)) / (2 * (a - b));
        if (from > start.back()) break;
        column.pop_back();
        start.pop_back();
        from = -std::numeric_limits<double>::infinity();
      }
      column.push_back(x);
      start.push_back(from);
    }
    std::size_t i = 0;
    for (Index x = 0; x < nx_; ++x) {
      while (i + 1 < column.size() && start[i + 1] <= static_cast<double>(x)) ++i;
      if (missing(y, x)) z_[at(y, x)] = known[at(row_of[at(y, column[i])], column[i])];
    }
  }

  std::vector<double>& z_;
  Index ny_, nx_;
  HeightMap::PixelSize pixel_;
  std::vector<double> value_, weight_;
};

}  // namespace

HeightMap HeightMap::fill_dropouts(double max_fraction) const {
  if (!(max_fraction >= 0 && max_fraction < 1)) refuse("max_fraction", max_fraction, "in [0, 1)");
  const double missing = dropout_fraction();
  if (missing > max_fraction)
    throw InvalidInput("heights: " + show(100 * missing, 4) + " % of the points are drop-outs: must be at most " +
                       show(100 * max_fraction, 4) + " % (max_fraction)");
  if (dropouts_ == 0) return *this;
  std::vector<double> z(shape_[0] * shape_[1]);
  for (std::size_t y = 0; y < shape_[0]; ++y) read_row(y, z.data() + y * shape_[1]);
  Filler(z, shape_, pixel_size_).fill();
  if (std::holds_alternative<const float*>(data_)) return {std::vector<float>(z.begin(), z.end()), shape_, pixel_size_};
  return {std::move(z), shape_, pixel_size_};
}

}  // namespace asperity
