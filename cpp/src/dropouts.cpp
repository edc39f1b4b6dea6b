#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "asperity/surface.hpp"
#include "checks.hpp"

namespace asperity {

namespace {

using Index = std::ptrdiff_t;

/// Row and column interpolation of whatever is bracketed by measured points; true where anything was filled.
/// A plane comes back as it was. Weights fall with the square of the gap: the nearer pair knows better.
class Filler {
 public:
  Filler(std::vector<double>& z, HeightMap::Shape shape, HeightMap::PixelSize pixel)
      : z_(z), ny_(static_cast<Index>(shape[0])), nx_(static_cast<Index>(shape[1])), pixel_(pixel) {}

  bool pass() {
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

  /// What no row and no column brackets takes the height of the nearest point that is known.
  void nearest() {
    const std::vector<double> known = z_;
    for (Index y = 0; y < ny_; ++y)
      for (Index x = 0; x < nx_; ++x)
        if (std::isnan(known[at(y, x)])) z_[at(y, x)] = nearest_to(known, y, x);
  }

 private:
  [[nodiscard]] std::size_t at(Index y, Index x) const { return static_cast<std::size_t>(y * nx_ + x); }

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

  /// Rings of growing size about (y, x), until none further out can be nearer.
  [[nodiscard]] double nearest_to(const std::vector<double>& known, Index y, Index x) const {
    double best = std::numeric_limits<double>::infinity(), height = 0;
    const double finest = std::fmin(pixel_[0], pixel_[1]);
    for (Index r = 1; r < std::max(nx_, ny_) && static_cast<double>(r) * finest <= best; ++r)
      for (Index dy = -r; dy <= r; ++dy) {
        const Index step = std::abs(dy) == r ? 1 : 2 * r;
        for (Index dx = -r; dx <= r; dx += step) {
          const Index yy = y + dy, xx = x + dx;
          if (yy < 0 || yy >= ny_ || xx < 0 || xx >= nx_ || std::isnan(known[at(yy, xx)])) continue;
          const double distance = std::hypot(static_cast<double>(dy) * pixel_[0], static_cast<double>(dx) * pixel_[1]);
          if (distance < best) {
            best = distance;
            height = known[at(yy, xx)];
          }
        }
      }
    return height;
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
  Filler filler(z, shape_, pixel_size_);
  while (filler.pass()) {
  }
  filler.nearest();
  if (std::holds_alternative<const float*>(data_))
    return HeightMap(std::vector<float>(z.begin(), z.end()), shape_, pixel_size_);
  return HeightMap(std::move(z), shape_, pixel_size_);
}

}  // namespace asperity
