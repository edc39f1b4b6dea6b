// Local maxima of a map no closer to each other than a given distance (Eq. 13).
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "asperity/surface.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

namespace {

using Index = std::ptrdiff_t;

struct Peak {
  double height;
  Index y, x;
};

/// Maxima among the eight neighbours; a plateau higher than all around it counts once, at its first point.
class MaximumFinder {
 public:
  MaximumFinder(std::vector<double> z, HeightMap::Shape shape, bool periodic)
      : z_(std::move(z)),
        ny_(static_cast<Index>(shape[0])),
        nx_(static_cast<Index>(shape[1])),
        periodic_(periodic),
        seen_(z_.size(), false) {}

  std::vector<Peak> find() {
    std::vector<Peak> peaks;
    for (Index y = 0; y < ny_; ++y) {
      for (Index x = 0; x < nx_; ++x) {
        heed_at(static_cast<std::size_t>(x));
        if (!seen_[at(y, x)] && is_maximum(y, x)) peaks.push_back({z_[at(y, x)], y, x});
      }
    }
    return peaks;
  }

 private:
  [[nodiscard]] std::size_t at(Index y, Index x) const { return static_cast<std::size_t>(y * nx_ + x); }

  [[nodiscard]] bool on_edge(Index y, Index x) const {
    // the one row of a line scan has no edge across
    return !periodic_ && ((ny_ > 1 && (y == 0 || y == ny_ - 1)) || (nx_ > 1 && (x == 0 || x == nx_ - 1)));
  }

  /// False where a neighbour is higher or one side is unseen; equal neighbours go to `equal` in any case.
  bool dominates(Index y, Index x, std::vector<std::array<Index, 2>>& equal) const {
    const double height = z_[at(y, x)];
    bool highest = !on_edge(y, x);
    for (Index dy = -1; dy <= 1; ++dy)
      for (Index dx = -1; dx <= 1; ++dx) {
        Index yy = y + dy, xx = x + dx;
        if (periodic_) {
          yy = (yy + ny_) % ny_;
          xx = (xx + nx_) % nx_;
        }
        if (yy < 0 || yy >= ny_ || xx < 0 || xx >= nx_ || (yy == y && xx == x)) continue;
        const double other = z_[at(yy, xx)];
        if (other > height) highest = false;
        if (other == height) equal.push_back({yy, xx});
      }
    return highest;
  }

  bool is_maximum(Index y, Index x) {
    std::vector<std::array<Index, 2>> plateau;
    bool highest = dominates(y, x, plateau);
    if (!highest) return false;  // not seen yet for its plateau's sake: another point of it may find it again
    seen_[at(y, x)] = true;
    std::size_t size = 1;
    while (!plateau.empty()) {
      const auto [yy, xx] = plateau.back();
      plateau.pop_back();
      heed_at(size);
      if (seen_[at(yy, xx)]) continue;
      seen_[at(yy, xx)] = true;
      ++size;
      highest = dominates(yy, xx, plateau) && highest;
    }
    return highest && size < z_.size();  // a constant map has no peak
  }

  std::vector<double> z_;
  Index ny_, nx_;
  bool periodic_;
  std::vector<bool> seen_;
};

/// Accepted peaks in cells no smaller than the minimum distance, so that only nine of them need a look. Distances
/// are taken between indices, so that they do not depend on where two peaks lie.
class Neighbourhood {
 public:
  Neighbourhood(HeightMap::Shape shape, HeightMap::PixelSize pixel, double min_distance, bool periodic)
      : ny_(static_cast<Index>(shape[0])),
        nx_(static_cast<Index>(shape[1])),
        pixel_(pixel),
        distance_(min_distance),
        periodic_(periodic),
        cells_y_(cells(ny_, pixel[0])),
        cells_x_(cells(nx_, pixel[1])) {}

  bool accept(const Peak& peak) {
    const Index cy = peak.y * cells_y_ / ny_, cx = peak.x * cells_x_ / nx_;
    for (Index dy = -1; dy <= 1; ++dy)
      for (Index dx = -1; dx <= 1; ++dx) {
        Index y = cy + dy, x = cx + dx;
        if (periodic_) {
          y = (y + cells_y_) % cells_y_;
          x = (x + cells_x_) % cells_x_;
        }
        if (y < 0 || x < 0 || y >= cells_y_ || x >= cells_x_) continue;
        const auto cell = cells_.find(y * cells_x_ + x);
        if (cell == cells_.end()) continue;
        for (const auto& [oy, ox] : cell->second)
          if (too_near(peak.y - oy, peak.x - ox)) return false;
      }
    cells_[cy * cells_x_ + cx].push_back({peak.y, peak.x});
    return true;
  }

 private:
  /// How many cells of at least the minimum distance fit into n points.
  [[nodiscard]] Index cells(Index n, double pixel) const {
    const double fit = static_cast<double>(n) * pixel / distance_;
    return std::max<Index>(1, static_cast<Index>(std::fmin(fit, static_cast<double>(n))));
  }
  [[nodiscard]] bool too_near(Index dy, Index dx) const {
    if (periodic_) {
      dy = std::min(std::abs(dy), ny_ - std::abs(dy));
      dx = std::min(std::abs(dx), nx_ - std::abs(dx));
    }
    // peaks n pixels apart are not nearer than n times the pixel size
    return is_below(std::hypot(static_cast<double>(dy) * pixel_[0], static_cast<double>(dx) * pixel_[1]), distance_);
  }

  Index ny_, nx_;
  HeightMap::PixelSize pixel_;
  double distance_;
  bool periodic_;
  Index cells_y_, cells_x_;
  std::unordered_map<Index, std::vector<std::array<Index, 2>>> cells_;
};

}  // namespace

std::vector<double> HeightMap::local_peaks(double min_distance, bool periodic) const {
  require_positive("min_distance", min_distance);
  if (dropouts_ > 0) throw InvalidInput(argument("heights") + ": has drop-outs; call fill_dropouts() first");
  const double mean = statistics().mean;
  std::vector<double> z(shape_[0] * shape_[1]);
  for (std::size_t y = 0; y < shape_[0]; ++y) read_row(y, z.data() + y * shape_[1]);
  std::vector<Peak> peaks = MaximumFinder(std::move(z), shape_, periodic).find();
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::height);
  Neighbourhood taken(shape_, pixel_size_, min_distance, periodic);
  std::vector<double> heights;
  for (const Peak& peak : peaks) {
    heed();
    if (taken.accept(peak)) heights.push_back(peak.height - mean);
  }
  return heights;
}

}  // namespace asperity
