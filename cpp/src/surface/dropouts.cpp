// Drop-outs of a map filled by linear interpolation between the measured points on either side, along rows, columns and
// diagonals; by the nearest point of the hull outside of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <ranges>
#include <string>

#include "asperity/surface.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "surface/rows.hpp"

namespace asperity {

namespace {

using Index = std::ptrdiff_t;
using Point = std::array<Index, 2>;  // y, x

/// Which side of the line a -> b the point c is on: the sign, 0 on it. Exact.
Index side(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The largest integer that p / q reaches; q > 0.
Index floor_ratio(Index p, Index q) { return p / q - (p % q < 0 ? 1 : 0); }

/// The straight lines on which holes are bracketed: row, column and the two diagonals.
constexpr std::array<Point, 4> directions{{{0, 1}, {1, 0}, {1, 1}, {1, -1}}};

/// A point without a height.
struct Hole {
  Index y, x;
  std::array<Index, 4> back;  // steps to the known point before it in each direction, 0 where there is none
  double height;
};

/// Heights with drop-outs, filled in place; a plane comes back as it was inside of the hull of the measured points. The
/// work is on the list of holes, in the order of the rows.
template <class T>
class Filler {
 public:
  Filler(std::vector<T>& z, std::size_t missing, HeightMap::Shape shape, HeightMap::PixelSize pixel)
      : z_(z),
        ny_(static_cast<Index>(shape[0])),
        nx_(static_cast<Index>(shape[1])),
        aspect_(pixel[0] / pixel[1]),
        rows_(measured_rows()),
        hull_(corners(rows_)) {
    widen_rows();
    holes_.reserve(missing);
  }

  void fill() {
    find_holes();
    while (pass_along_lines() || pass_along_hull()) {
    }
    fill_on_triangles();
    fill_outside();
  }

 private:
  [[nodiscard]] std::size_t at(Index y, Index x) const { return static_cast<std::size_t>(y * nx_ + x); }
  [[nodiscard]] double z(const Point& p) const { return z_[at(p[0], p[1])]; }
  [[nodiscard]] bool missing(Index y, Index x) const { return std::isnan(z_[at(y, x)]); }
  [[nodiscard]] bool inside(Index y, Index x) const { return y >= 0 && y < ny_ && x >= 0 && x < nx_; }

  /// First and last measured column of each row; last < first where there is none.
  [[nodiscard]] std::vector<Point> measured_rows() const {
    std::vector<Point> rows(static_cast<std::size_t>(ny_), {0, nx_ - 1});
    for (Index y = 0; y < ny_; ++y) {
      auto& [first, last] = rows[static_cast<std::size_t>(y)];
      while (first < nx_ && missing(y, first)) ++first;
      while (last >= first && missing(y, last)) --last;
    }
    return rows;
  }

  /// Corners of the convex hull of the measured points, in order (Andrew's monotone chain; only the first and the last
  /// of a row can be on it). None for a single point.
  static std::vector<Point> corners(const std::vector<Point>& rows) {
    std::vector<Point> ends;
    for (std::size_t y = 0; y < rows.size(); ++y) {
      const auto [first, last] = rows[y];
      if (last >= first) ends.push_back({static_cast<Index>(y), first});
      if (last > first) ends.push_back({static_cast<Index>(y), last});
    }
    std::vector<Point> hull;
    const auto chain = [&](const auto& points) {
      const std::size_t base = hull.size();
      for (const Point& p : points) {
        while (hull.size() >= base + 2 && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
      }
      hull.pop_back();
    };
    chain(ends);
    chain(std::views::reverse(ends));
    return hull;
  }

  /// From the rows of measured points to those of their hull.
  void widen_rows() {
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Point a = hull_[i], b = hull_[(i + 1) % hull_.size()];
      const Index dy = b[0] - a[0], dx = b[1] - a[1];
      for (Index y = a[0]; y < b[0]; ++y)  // down on the left
        rows_[static_cast<std::size_t>(y)][0] = a[1] - floor_ratio(-(y - a[0]) * dx, dy);
      for (Index y = b[0]; y < a[0]; ++y)  // up on the right
        rows_[static_cast<std::size_t>(y)][1] = b[1] + floor_ratio(-(y - b[0]) * dx, -dy);
    }
  }

  void find_holes() {
    for (Index y = 0; y < ny_; ++y) {
      const auto [first, last] = rows_[static_cast<std::size_t>(y)];
      for (Index x = 0; x < nx_; ++x)
        if (missing(y, x) && x >= first && x <= last)
          holes_.push_back({y, x, {}, 0});
        else if (missing(y, x))
          outside_.push_back({y, x});
    }
  }

  /// Height on the line between two known points, `back` steps before (y, x) and `ahead` steps after it.
  [[nodiscard]] double between(Index y, Index x, const Point& step, Index back, Index ahead) const {
    const double t = static_cast<double>(back) / static_cast<double>(back + ahead);
    return z({y - back * step[0], x - back * step[1]}) * (1 - t) + z({y + ahead * step[0], x + ahead * step[1]}) * t;
  }

  /// Steps from a hole to the next known point one way along direction d, 0 where there is none, from the steps of
  /// the hole met before it on the same line.
  Index count_steps(const Hole& hole, std::size_t d, Index way) {
    const auto [dy, dx] = directions[d];
    Index& steps = steps_[static_cast<std::size_t>(hole.x * dy - hole.y * dx + ny_)][d];
    const Index y = hole.y + way * dy, x = hole.x + way * dx;
    return steps = !inside(y, x) ? 0 : !missing(y, x) ? 1 : steps > 0 ? steps + 1 : 0;
  }

  /// Linear between the two known points that bracket a hole on a line; of several lines the mean, weighted by
  /// (1 / a + 1 / b)^3 with the distances a and b: the nearer points know better. The diagonals have a say where
  /// neither the row nor the column has both neighbours. True where anything was filled.
  bool pass_along_lines() {
    steps_.assign(static_cast<std::size_t>(nx_ + 2 * ny_), {});
    for (Hole& hole : holes_) {
      heed_at(static_cast<std::size_t>(hole.x + hole.y));
      for (std::size_t d = 0; d < directions.size(); ++d) hole.back[d] = count_steps(hole, d, -1);
    }
    steps_.assign(static_cast<std::size_t>(nx_ + 2 * ny_), {});
    const double diagonal = std::hypot(aspect_, 1);
    const std::array<double, 4> spacing{1, aspect_, diagonal, diagonal};  // in units of dx: no unit of length matters
    for (Hole& hole : std::views::reverse(holes_)) {
      heed_at(static_cast<std::size_t>(hole.x + hole.y));
      double sum = 0, weights = 0;
      bool isolated = false;
      for (std::size_t d = 0; d < directions.size(); ++d) {
        const Index back = hole.back[d], ahead = count_steps(hole, d, 1);
        if (back == 0 || ahead == 0 || (d >= 2 && isolated)) continue;
        const double nearness = (1 / static_cast<double>(back) + 1 / static_cast<double>(ahead)) / spacing[d];
        const double weight = nearness * nearness * nearness;
        sum += weight * between(hole.y, hole.x, directions[d], back, ahead);
        weights += weight;
        isolated = isolated || (d < 2 && back + ahead == 2);
      }
      hole.height = sum / weights;  // NaN where there was no bracket
    }
    return put_heights();
  }

  /// Puts what was found into the map and off the list. True where anything was found.
  bool put_heights() {
    for (const Hole& hole : holes_) z_[at(hole.y, hole.x)] = static_cast<T>(hole.height);
    return std::erase_if(holes_, [](const Hole& hole) { return !std::isnan(hole.height); }) > 0;
  }

  /// Holes that no line brackets lie in a pocket behind an edge of the hull. There the two known points of a line
  /// parallel to that edge bracket it. True where anything was filled.
  bool pass_along_hull() {
    std::vector<Point> steps;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Point a = hull_[i], b = hull_[(i + 1) % hull_.size()];
      const Index dy = b[0] - a[0], dx = b[1] - a[1], divisor = std::gcd(dy, dx);
      if (dy != 0 && dx != 0) steps.push_back({dy / divisor, dx / divisor});
    }
    for (Hole& hole : holes_) {
      heed();
      double shortest = std::numeric_limits<double>::infinity();
      hole.height = std::numeric_limits<double>::quiet_NaN();
      for (const Point& step : steps) {
        const Index back = reach(hole, {-step[0], -step[1]}), ahead = reach(hole, step);
        const double length = static_cast<double>(back + ahead) *
                              std::hypot(static_cast<double>(step[0]) * aspect_, static_cast<double>(step[1]));
        if (back == 0 || ahead == 0 || length >= shortest) continue;
        shortest = length;
        hole.height = between(hole.y, hole.x, step, back, ahead);
      }
    }
    return put_heights();
  }

  /// Steps from a hole to the next known point, 0 where there is none.
  [[nodiscard]] Index reach(const Hole& hole, const Point& step) const {
    for (Index n = 1; inside(hole.y + n * step[0], hole.x + n * step[1]); ++n)
      if (!missing(hole.y + n * step[0], hole.x + n * step[1])) return n;
    return 0;
  }

  /// All holes that are left in the hull of few and scattered points: linear on the triangles from its first corner.
  void fill_on_triangles() {
    for (Hole& hole : holes_) {
      heed();
      for (std::size_t i = 1; i + 1 < hull_.size(); ++i) {
        const Point &a = hull_[0], &b = hull_[i], &c = hull_[i + 1], p{hole.y, hole.x};
        const Index in_a = side(b, c, p), in_b = side(c, a, p), in_c = side(a, b, p);
        if (in_a < 0 || in_b < 0 || in_c < 0) continue;
        const auto share = [&](Index part) { return static_cast<double>(part) / static_cast<double>(side(a, b, c)); };
        hole.height = share(in_a) * z(a) + share(in_b) * z(b) + share(in_c) * z(c);
        break;
      }
    }
    put_heights();
  }

  /// Holes outside of the hull take the height of the nearest point in it, by an exact distance transform (P.
  /// Felzenszwalb, D. Huttenlocher, Theory of Computing 8, 415 (2012)): in each column the hull is one run of
  /// points, the nearest of which is in closed form, and in each row the lower envelope of the parabolas that the
  /// columns stand for tells the nearest column.
  void fill_outside() {
    if (outside_.empty()) return;
    std::vector<Point> columns(static_cast<std::size_t>(nx_), {ny_, -1});
    for (Index y = 0; y < ny_; ++y) {
      const auto [first, last] = rows_[static_cast<std::size_t>(y)];
      for (Index x = first; x <= last; ++x) {
        auto& [top, bottom] = columns[static_cast<std::size_t>(x)];
        top = std::min(top, y);
        bottom = y;
      }
    }
    for (auto p = outside_.begin(); p != outside_.end();) {
      heed();
      const Index y = (*p)[0];
      const std::vector<Nearest> lowest = envelope(y, columns);
      for (auto i = lowest.begin(); p != outside_.end() && (*p)[0] == y; ++p) {
        while (i + 1 != lowest.end() && (i + 1)->from <= static_cast<double>((*p)[1])) ++i;
        z_[at(y, (*p)[1])] = z_[at(i->row, i->column)];
      }
    }
  }

  struct Nearest {
    Index row, column;
    double from;  // the nearest point to all of row y from here on
  };

  [[nodiscard]] std::vector<Nearest> envelope(Index y, const std::vector<Point>& columns) const {
    const auto height = [&](Index row) {  // of a parabola: the square of the distance to its column's nearest point
      const double dy = static_cast<double>(row - y) * aspect_;
      return dy * dy;
    };
    std::vector<Nearest> lowest;
    for (Index x = 0; x < nx_; ++x) {
      const auto& [top, bottom] = columns[static_cast<std::size_t>(x)];
      if (bottom < top) continue;
      const Index row = std::clamp(y, top, bottom);
      double from = -std::numeric_limits<double>::infinity();
      for (; !lowest.empty(); lowest.pop_back()) {
        const Nearest& last = lowest.back();
        const double apart = static_cast<double>(x - last.column), middle = static_cast<double>(x + last.column) / 2;
        from = middle + (height(row) - height(last.row)) / (2 * apart);
        if (from > last.from) break;
      }
      lowest.push_back({row, x, from});
    }
    return lowest;
  }

  std::vector<T>& z_;
  Index ny_, nx_;
  double aspect_;
  std::vector<Point> rows_, hull_, outside_;
  std::vector<Hole> holes_;
  std::vector<std::array<Index, 4>> steps_;  // of the last hole on each line of each direction
};

}  // namespace

HeightMap HeightMap::fill_dropouts(double max_fraction) const {
  if (!(max_fraction >= 0 && max_fraction < 1)) refuse("max_fraction", max_fraction, "in [0, 1)");
  const double missing = dropout_fraction();
  if (missing > max_fraction)
    throw InvalidInput(argument("heights") + ": " + show(100 * missing, 4) + " % of the points are drop-outs" +
                       must_be() + "at most " + show(100 * max_fraction, 4) + " %, " + argument("max_fraction") +
                       " = " + value(max_fraction));
  if (dropouts_ == 0) return *this;
  return std::visit(
      [&](const auto* data) {
        using T = std::remove_cvref_t<decltype(*data)>;
        std::vector<T> z(shape_[0] * shape_[1]);
        RowReader<T> read(*this);
        for (std::size_t y = 0; y < shape_[0]; ++y) std::copy_n(read(y), shape_[1], z.data() + y * shape_[1]);
        Filler<T>(z, dropouts_, shape_, pixel_size_).fill();
        return HeightMap(std::move(z), shape_, pixel_size_);
      },
      data_);
}

}  // namespace asperity
