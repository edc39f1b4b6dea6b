#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "asperity/surface.hpp"
#include "checks.hpp"

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
    for (Index y = 0; y < ny_; ++y)
      for (Index x = 0; x < nx_; ++x)
        if (!seen_[at(y, x)] && is_maximum(y, x)) peaks.push_back({z_[at(y, x)], y, x});
    return peaks;
  }

 private:
  [[nodiscard]] std::size_t at(Index y, Index x) const { return static_cast<std::size_t>(y * nx_ + x); }

  [[nodiscard]] bool on_edge(Index y, Index x) const {
    return !periodic_ && (y == 0 || x == 0 || y == ny_ - 1 || x == nx_ - 1);
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

/// Accepted peaks in square cells of the minimum distance, so that only nine cells need a look.
class Neighbourhood {
 public:
  Neighbourhood(HeightMap::Shape shape, HeightMap::PixelSize pixel, double min_distance, bool periodic)
      : ly_(static_cast<double>(shape[0]) * pixel[0]),
        lx_(static_cast<double>(shape[1]) * pixel[1]),
        pixel_(pixel),
        distance_(min_distance),
        periodic_(periodic),
        cells_y_(std::max<Index>(1, static_cast<Index>(ly_ / min_distance))),
        cells_x_(std::max<Index>(1, static_cast<Index>(lx_ / min_distance))) {}

  bool accept(const Peak& peak) {
    const double y = static_cast<double>(peak.y) * pixel_[0], x = static_cast<double>(peak.x) * pixel_[1];
    const Index cy = std::min(cells_y_ - 1, static_cast<Index>(y / ly_ * static_cast<double>(cells_y_)));
    const Index cx = std::min(cells_x_ - 1, static_cast<Index>(x / lx_ * static_cast<double>(cells_x_)));
    for (Index dy = -1; dy <= 1; ++dy)
      for (Index dx = -1; dx <= 1; ++dx) {
        Index ny = cy + dy, nx = cx + dx;
        if (periodic_) {
          ny = (ny + cells_y_) % cells_y_;
          nx = (nx + cells_x_) % cells_x_;
        }
        const auto cell = cells_.find(ny * cells_x_ + nx);
        if (ny < 0 || nx < 0 || ny >= cells_y_ || nx >= cells_x_ || cell == cells_.end()) continue;
        for (const auto& [oy, ox] : cell->second)
          if (std::hypot(apart(y - oy, ly_), apart(x - ox, lx_)) < distance_) return false;
      }
    cells_[cy * cells_x_ + cx].push_back({y, x});
    return true;
  }

 private:
  [[nodiscard]] double apart(double d, double length) const { return periodic_ ? std::remainder(d, length) : d; }

  double ly_, lx_;
  HeightMap::PixelSize pixel_;
  double distance_;
  bool periodic_;
  Index cells_y_, cells_x_;
  std::unordered_map<Index, std::vector<std::array<double, 2>>> cells_;
};

}  // namespace

std::vector<double> HeightMap::local_peaks(double min_distance, bool periodic) const {
  require_positive("min_distance", min_distance);
  if (dropouts_ > 0) throw InvalidInput("heights: has drop-outs, fill_dropouts must come before local_peaks");
  const double mean = statistics().mean;
  std::vector<double> z(shape_[0] * shape_[1]);
  for (std::size_t y = 0; y < shape_[0]; ++y) read_row(y, z.data() + y * shape_[1]);
  std::vector<Peak> peaks = MaximumFinder(std::move(z), shape_, periodic).find();
  std::ranges::stable_sort(peaks, std::greater{}, &Peak::height);
  Neighbourhood taken(shape_, pixel_size_, min_distance, periodic);
  std::vector<double> heights;
  for (const Peak& peak : peaks)
    if (taken.accept(peak)) heights.push_back(peak.height - mean);
  return heights;
}

}  // namespace asperity
