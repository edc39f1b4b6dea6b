// Measured heights on a regular grid: drop-outs, detrending, statistics, local peaks, affine shift.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "asperity/errors.hpp"
#include "asperity/export.hpp"

namespace asperity {

enum class Detrend { offset, plane, quadratic };

/// Heights about their mean plane (drop-outs left out), all from one reading of the map.
struct HeightStatistics {
  double mean;        // height of the mean plane in the map's own zero [m]
  double rms_height;  // [m]
  double skewness;    // <z^3> / rms^3 [-], 0 for Gaussian heights
  double kurtosis;    // <z^4> / rms^4 [-], 3 for Gaussian heights
  double z_max;       // highest point above the mean plane [m]
  double z_min;       // lowest point above the mean plane [m], negative
};

/// How often heights occur, as a density over equal bins.
struct HeightHistogram {
  std::vector<double> edges;    // heights about the mean [m], one more than bins
  std::vector<double> density;  // [1/m]: its integral is 1
};

/// A map of heights [m], row by row; NaN marks a drop-out. Constant after construction.
/// float and double maps keep their type. The heights are shared, never copied with the map.
class ASPERITY_EXPORT HeightMap {
 public:
  using Shape = std::array<std::size_t, 2>;       // ny, nx
  using PixelSize = std::array<double, 2>;        // dy, dx [m]
  using Strides = std::array<std::ptrdiff_t, 2>;  // in elements, may be negative or 0
  using Data = std::variant<const double*, const float*>;

  HeightMap(std::vector<double> heights, Shape shape, PixelSize pixel_size);
  HeightMap(std::vector<float> heights, Shape shape, PixelSize pixel_size);
  /// Heights that somebody else owns: `owner` keeps them alive, nobody may change them.
  HeightMap(Data data, Strides strides, std::shared_ptr<const void> owner, Shape shape, PixelSize pixel_size);

  [[nodiscard]] Shape shape() const { return shape_; }
  [[nodiscard]] PixelSize pixel_size() const { return pixel_size_; }
  [[nodiscard]] Data data() const { return data_; }
  [[nodiscard]] Strides strides() const { return strides_; }
  [[nodiscard]] const std::shared_ptr<const void>& owner() const { return owner_; }

  /// Copies row `y` into `row` (nx numbers).
  void read_row(std::size_t y, double* row) const;

  [[nodiscard]] double dropout_fraction() const;
  [[nodiscard]] HeightStatistics statistics() const;
  [[nodiscard]] HeightHistogram height_histogram(std::size_t bins) const;
  /// sqrt(<(dh/dx)^2> + <(dh/dy)^2>) by central differences where both neighbours are measured.
  [[nodiscard]] double rms_slope() const;

  /// Linear interpolation across drop-outs, along rows and columns (diagonals where neither has both neighbours), the
  /// nearer pair weighing more; nearest measured point of the hull outside of it. Throws where more than `max_fraction`
  /// is missing.
  [[nodiscard]] HeightMap fill_dropouts(double max_fraction = 0.10) const;
  /// Least-squares offset, plane or quadratic surface of the measured points removed.
  [[nodiscard]] HeightMap detrend(Detrend order) const;
  /// h_T = (h - z_max) / p + z_max, the article's Eq. 9, in heights above the mean plane.
  [[nodiscard]] HeightMap affine_shift(double p) const;
  /// Heights [m] above the mean plane of the maxima no closer to each other than `min_distance` [m], highest
  /// first. On a map that is not periodic a maximum on the edge does not count: one side of it is unseen.
  [[nodiscard]] std::vector<double> local_peaks(double min_distance, bool periodic = false) const;

 private:
  Data data_;
  Strides strides_;
  std::shared_ptr<const void> owner_;
  Shape shape_;
  PixelSize pixel_size_;
  std::size_t dropouts_ = 0;
};

/// Heights [m] along a line at equal distances; NaN marks a drop-out. Constant after construction.
class ASPERITY_EXPORT LineScan {
 public:
  LineScan(std::vector<double> heights, double spacing);
  LineScan(std::vector<float> heights, double spacing);
  /// Heights that somebody else owns, `stride` elements apart.
  LineScan(HeightMap::Data data, std::ptrdiff_t stride, std::shared_ptr<const void> owner, std::size_t size,
           double spacing);

  [[nodiscard]] std::size_t size() const { return row_.shape()[1]; }
  [[nodiscard]] double spacing() const { return row_.pixel_size()[1]; }
  /// The scan as a map of one row.
  [[nodiscard]] const HeightMap& row() const { return row_; }

  [[nodiscard]] double dropout_fraction() const { return row_.dropout_fraction(); }
  [[nodiscard]] HeightStatistics statistics() const { return row_.statistics(); }
  [[nodiscard]] HeightHistogram height_histogram(std::size_t bins) const { return row_.height_histogram(bins); }
  /// sqrt(<(dh/dx)^2>) by central differences where both neighbours are measured.
  [[nodiscard]] double rms_slope() const;
  /// Linear between the neighbours, nearest beyond the first and the last measured point.
  [[nodiscard]] LineScan fill_dropouts(double max_fraction = 0.10) const;
  /// Least-squares offset, straight line ("plane") or parabola of the measured points removed.
  [[nodiscard]] LineScan detrend(Detrend order) const;
  [[nodiscard]] LineScan affine_shift(double p) const;
  [[nodiscard]] std::vector<double> local_peaks(double min_distance, bool periodic = false) const;

 private:
  explicit LineScan(HeightMap row);
  HeightMap row_;
};

}  // namespace asperity
