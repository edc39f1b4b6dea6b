// A line of heights, which is a map of one row.
#include <cmath>

#include "asperity/surface.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

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
  double sum = 0, count = 0;
  for (std::size_t i = 1; i + 1 < z.size(); ++i)
    if (const double slope = (z[i + 1] - z[i - 1]) / (2 * spacing()); !std::isnan(slope)) {
      sum += slope * slope;
      ++count;
    }
  if (count == 0)
    throw InvalidInput(argument("heights") + " has " + asperity::count(size()) +
                       " points, none with both neighbours measured: a slope by central differences needs one");
  return std::sqrt(sum / count);
}

LineScan LineScan::fill_dropouts(double max_fraction) const { return LineScan(row_.fill_dropouts(max_fraction)); }
LineScan LineScan::detrend(Detrend order) const { return LineScan(row_.detrend(order)); }
LineScan LineScan::affine_shift(double p) const { return LineScan(row_.affine_shift(p)); }
std::vector<double> LineScan::local_peaks(double min_distance, bool periodic) const {
  return row_.local_peaks(min_distance, periodic);
}

}  // namespace asperity
