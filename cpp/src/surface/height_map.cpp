// A map of heights: its checks, statistics about the mean plane, histogram, rms slope and affine shift (Eq. 9).
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/surface.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "surface/detrend.hpp"
#include "surface/rows.hpp"

namespace asperity {

namespace {

void require_size(std::size_t size, HeightMap::Shape shape) {
  if (size != shape[0] * shape[1])
    throw InvalidInput(argument("heights") + " has " + count(size) + " entries" + must_be() +
                       "shape = " + std::to_string(shape[0]) + " x " + std::to_string(shape[1]));
}

/// Of numbers that were measured.
struct MeanSquare {
  double sum = 0, count = 0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value * value;
    ++count;
  }
  /// By central differences.
  void add_slopes(const std::vector<double>& row, double step) {
    for (std::size_t x = 1; x + 1 < row.size(); ++x) add((row[x + 1] - row[x - 1]) / (2 * step));
  }
};

/// Owns a vector and points at its numbers. A vector's buffer stays where it is when the vector is moved.
template <class T>
HeightMap owning(std::vector<T> heights, HeightMap::Shape shape, HeightMap::PixelSize pixel_size) {
  require_size(heights.size(), shape);
  auto owner = std::make_shared<const std::vector<T>>(std::move(heights));
  const T* const data = owner->data();
  return {data, {static_cast<std::ptrdiff_t>(shape[1]), 1}, std::move(owner), shape, pixel_size};
}

}  // namespace

HeightMap::HeightMap(std::vector<double> heights, Shape shape, PixelSize pixel_size)
    : HeightMap(owning(std::move(heights), shape, pixel_size)) {}

HeightMap::HeightMap(std::vector<float> heights, Shape shape, PixelSize pixel_size)
    : HeightMap(owning(std::move(heights), shape, pixel_size)) {}

HeightMap::HeightMap(Data data, Strides strides, std::shared_ptr<const void> owner, Shape shape, PixelSize pixel_size)
    : data_(data), strides_(strides), owner_(std::move(owner)), shape_(shape), pixel_size_(pixel_size) {
  const bool line = strides_[0] == 0 && shape_[0] == 1;
  if (shape_[0] == 0 || shape_[1] == 0)
    throw InvalidInput(argument("heights") + " has shape (" + (line ? "" : std::to_string(shape_[0]) + ", ") +
                       std::to_string(shape_[1]) + (line ? ",)" : ")") + must(": must not be ") + "empty");
  require_positive("pixel_size", pixel_size_[0]);
  require_positive("pixel_size", pixel_size_[1]);
  for_each_row(*this, [&](std::size_t y, std::span<const double> row) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (std::isnan(row[x])) ++dropouts_;
      if (std::isinf(row[x]))
        refuse(argument("heights") + ("[" + (line ? "" : std::to_string(y) + ", ") + std::to_string(x) + "]"), row[x],
               "finite, or NaN for a drop-out");
    }
  });
  if (dropouts_ == shape_[0] * shape_[1]) throw InvalidInput(argument("heights") + ": every point is a drop-out (NaN)");
}

void HeightMap::read_row(std::size_t y, double* row) const {
  std::visit(
      [&](const auto* data) {
        const auto* at = data + static_cast<std::ptrdiff_t>(y) * strides_[0];
        for (std::size_t x = 0; x < shape_[1]; ++x) row[x] = at[static_cast<std::ptrdiff_t>(x) * strides_[1]];
      },
      data_);
}

double HeightMap::dropout_fraction() const {
  return static_cast<double>(dropouts_) / (static_cast<double>(shape_[0]) * static_cast<double>(shape_[1]));
}

// Two readings: the mean first, so that a map far from zero keeps the digits of its roughness.
HeightStatistics HeightMap::statistics() const {
  const double count = static_cast<double>(shape_[0]) * static_cast<double>(shape_[1]) - static_cast<double>(dropouts_);
  const double anchor = first_height(*this);
  double sum = 0;
  for_each_row(*this, [&](std::size_t, std::span<const double> row) {
    double part = 0;
    for (const double z : row) part += std::isnan(z) ? 0 : z - anchor;
    sum += part;
  });
  HeightStatistics s{
      anchor + sum / count, 0, 0, 0, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double m2 = 0, m3 = 0, m4 = 0;
  for_each_row(*this, [&](std::size_t, std::span<const double> row) {
    double part2 = 0, part3 = 0, part4 = 0;
    for (const double height : row) {
      if (std::isnan(height)) continue;
      const double z = height - s.mean, z2 = z * z;
      part2 += z2;
      part3 += z2 * z;
      part4 += z2 * z2;
      s.z_max = std::max(s.z_max, z);
      s.z_min = std::min(s.z_min, z);
    }
    m2 += part2 / count;
    m3 += part3 / count;
    m4 += part4 / count;
  });
  s.rms_height = std::sqrt(m2);
  s.skewness = m2 > 0 ? m3 / (m2 * s.rms_height) : 0;  // a flat map has none
  s.kurtosis = m2 > 0 ? m4 / (m2 * m2) : 0;
  return s;
}

HeightHistogram HeightMap::height_histogram(std::size_t bins) const {
  if (bins < 1 || bins > 1'000'000) refuse("bins", static_cast<double>(bins), "from 1 to 10^6");
  const HeightStatistics s = statistics();
  const double lower = s.z_min, upper = s.z_max, width = (upper - lower) / static_cast<double>(bins);
  if (!(width > 0))
    throw InvalidInput(argument("heights") + must(": must differ ") + "for a histogram, but are all the same");
  HeightHistogram histogram{std::vector<double>(bins + 1), std::vector<double>(bins, 0.0)};
  for (std::size_t i = 0; i <= bins; ++i) histogram.edges[i] = lower + width * static_cast<double>(i);
  histogram.edges.back() = upper;
  double points = 0;
  for_each_row(*this, [&](std::size_t, std::span<const double> row) {
    for (const double height : row) {
      if (std::isnan(height)) continue;
      const auto bin = static_cast<std::size_t>(std::fmax(0, (height - s.mean - lower) / width));
      ++histogram.density[std::min(bin, bins - 1)];
      ++points;
    }
  });
  for (double& density : histogram.density) density /= points * width;
  return histogram;
}

double HeightMap::rms_slope() const {
  const auto [ny, nx] = shape_;
  if (ny < 3 || nx < 3)
    throw InvalidInput(argument("heights") + " has shape (" + std::to_string(ny) + ", " + std::to_string(nx) + ")" +
                       must_be() + "3 x 3 or more for central differences");
  const auto [dy, dx] = pixel_size_;
  std::vector<double> before(nx), here(nx), after(nx);
  read_row(0, here.data());
  read_row(1, after.data());
  MeanSquare in_x, in_y;
  in_x.add_slopes(here, dx);
  for (std::size_t y = 1; y + 1 < ny; ++y) {
    heed();
    std::swap(before, here);
    std::swap(here, after);
    read_row(y + 1, after.data());
    in_x.add_slopes(here, dx);
    for (std::size_t x = 0; x < nx; ++x) in_y.add((after[x] - before[x]) / (2 * dy));
  }
  in_x.add_slopes(after, dx);
  if (in_x.count == 0 || in_y.count == 0)
    throw InvalidInput(argument("heights") +
                       ": no point has both neighbours measured; call fill_dropouts() before a slope");
  return std::sqrt(in_x.sum / in_x.count + in_y.sum / in_y.count);
}

HeightMap HeightMap::detrend(Detrend order) const {
  const Trend trend(*this, order);
  return map_rows(*this, [&](std::size_t y, std::span<double> row) { trend.subtract(y, row.data(), row.data()); });
}

HeightMap HeightMap::affine_shift(double p) const {
  if (!(p >= 1) || !std::isfinite(p)) refuse("p", p, "1 or more, and finite");
  const HeightStatistics s = statistics();
  return map_rows(*this, [&](std::size_t, std::span<double> row) {
    for (double& z : row) z = (z - s.mean - s.z_max) / p + s.z_max;
  });
}

double first_height(const HeightMap& map) {
  std::vector<double> row(map.shape()[1]);
  for (std::size_t y = 0; y < map.shape()[0]; ++y) {
    map.read_row(y, row.data());
    for (const double z : row)
      if (!std::isnan(z)) return z;
  }
  return 0;  // not reached: a map has at least one measured point
}

// A line of heights, which is a map of one row.

namespace {

template <class T>
HeightMap one_row(std::vector<T> heights, double spacing) {
  const std::size_t size = heights.size();
  return {std::move(heights), {1, size}, {spacing, spacing}};
}

}  // namespace

LineScan::LineScan(HeightMap row) : row_(std::move(row)) {}
LineScan::LineScan(std::vector<double> heights, double spacing) : row_(one_row(std::move(heights), spacing)) {}
LineScan::LineScan(std::vector<float> heights, double spacing) : row_(one_row(std::move(heights), spacing)) {}
LineScan::LineScan(HeightMap::Data data, std::ptrdiff_t stride, std::shared_ptr<const void> owner, std::size_t size,
                   double spacing)
    : row_(data, {0, stride}, std::move(owner), {1, size}, {spacing, spacing}) {}

double LineScan::rms_slope() const {
  std::vector<double> z(size());
  row_.read_row(0, z.data());
  MeanSquare slopes;
  slopes.add_slopes(z, spacing());
  if (slopes.count == 0)
    throw InvalidInput(argument("heights") + " has " + count(size()) +
                       " points, none with both neighbours measured: a slope by central differences needs one");
  return std::sqrt(slopes.sum / slopes.count);
}

LineScan LineScan::fill_dropouts(double max_fraction) const { return LineScan(row_.fill_dropouts(max_fraction)); }
LineScan LineScan::detrend(Detrend order) const { return LineScan(row_.detrend(order)); }
LineScan LineScan::affine_shift(double p) const { return LineScan(row_.affine_shift(p)); }
std::vector<double> LineScan::local_peaks(double min_distance, bool periodic) const {
  return row_.local_peaks(min_distance, periodic);
}

}  // namespace asperity
