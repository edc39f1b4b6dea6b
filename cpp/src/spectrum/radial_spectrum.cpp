// The radially averaged spectrum of a map, C(q) = A / ((2 pi)^2 n^2) |sum w h exp(-i q x)|^2 (Eqs 24-27): means over
// rings of modes with their standard errors.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "numerics/simd.hpp"
#include "spectrum/fft2d.hpp"
#include "spectrum/height_moments.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/window.hpp"
#include "surface/rows.hpp"

namespace asperity {

using std::numbers::pi;

void require_filled(const HeightMap& map) {
  if (map.dropout_fraction() > 0)
    throw InvalidInput(argument("surface") + ": has drop-outs (" + show(100 * map.dropout_fraction(), 4) +
                       " %); call fill_dropouts() first");
}

void require_plane(const HeightMap& map) {
  require_filled(map);
  const auto [ny, nx] = map.shape();
  if (ny < 2 || nx < 2)
    throw InvalidInput(argument("surface") + " has shape (" + std::to_string(ny) + ", " + std::to_string(nx) + ")" +
                       must_be() + "2 x 2 or more for a two-dimensional spectrum; one line is a LineScan");
}

Preparation prepare(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads) {
  require_plane(map);
  const auto [ny, nx] = map.shape();
  Preparation result{window_weights(window, ny), window_weights(window, nx), {}, 0, {}};
  if (detrend) result.trend.emplace(map, *detrend, threads);
  const WindowMoments y(result.wy), x(result.wx);
  const auto [dy, dx] = map.pixel_size();
  const double n = static_cast<double>(ny) * static_cast<double>(nx);
  result.scale = dy * dx / (4 * pi * pi * n) / (y.mean_square * x.mean_square);
  const double ly = static_cast<double>(ny) * dy, lx = static_cast<double>(nx) * dx, longest = std::max(ly, lx);
  result.ring_covariances = ring_covariances(result.wy, result.wx, {longest / ly, longest / lx});
  return result;
}

namespace {

/// Sums over the modes of a ring.
struct Ring {
  Pair power{};  // of |h|^2 and of its square
  Pair modes{};  // of |q| / dq, and their number
};

/// Rings round(|q| / dq) of the mode plane, dq = 2 pi / longest side, out to the corner.
class Rings {
 public:
  Rings(HeightMap::Shape shape, HeightMap::PixelSize pixel)
      : shape_(shape),
        ly_(static_cast<double>(shape[0]) * pixel[0]),
        lx_(static_cast<double>(shape[1]) * pixel[1]),
        coarser_(std::max(pixel[0], pixel[1])) {
    // sides in units of dx, so that the rings do not depend on the unit of length: exact for square pixels
    side_y_ = static_cast<double>(shape[0]) * (pixel[0] / pixel[1]);
    side_x_ = static_cast<double>(shape[1]);
    longest_ = std::max(side_y_, side_x_);
    for (std::size_t k = 0; k <= shape[0] / 2; ++k) squared_radius_.push_back(std::pow(radius(k, side_y_), 2));
    const double corner = std::sqrt(std::pow(radius(shape[1] / 2, side_x_), 2) + squared_radius_.back());
    const std::size_t columns = shape[1] / 2 + 1;
    const double modes = static_cast<double>(shape[0]) * static_cast<double>(columns);
    if (!(corner <= most_rings || corner <= modes))  // of more rings than modes most are empty
      throw InvalidInput(argument("pixel_size") + " = " + pair(pixel[0], pixel[1]) + ": its aspect of " +
                         show(std::fmax(pixel[0] / pixel[1], pixel[1] / pixel[0]), 3) + " makes " + show(corner, 3) +
                         " rings of wavenumbers for the " + show(modes) + " modes of this map" + must_be() +
                         "at most " + show(most_rings));
    count_ = static_cast<std::size_t>(std::lround(corner)) + 1;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] double dq() const { return 2 * pi / std::max(ly_, lx_); }
  [[nodiscard]] double area_of_mode() const { return 4 * pi * pi / (lx_ * ly_); }  // [1/m^2]
  [[nodiscard]] Reliability reliable(Window window, const Preparation& prepared) const {
    return {window, std::min(ly_, lx_), coarser_, prepared.ring_covariances[0]};
  }

  /// Of each ring and m = 1 to `most`: sums of |h|^2 cos 2 m phi, |h|^2 sin 2 m phi and cos 2 m phi.
  struct Directions {
    double cosine = 0, sine = 0, modes = 0;
  };
  template <class T>
  void add_directions(std::size_t kx, const std::complex<T>* column, std::size_t most,
                      std::vector<Directions>& sums) const {
    const std::size_t ny = shape_[0];
    const double x = radius(kx, side_x_), mirrored = kx == 0 || 2 * kx == shape_[1] ? 1 : 2;
    for (std::size_t ky = 0; ky <= ny / 2; ++ky) {
      if (kx == 0 && ky == 0) continue;
      const bool single = ky == 0 || 2 * ky == ny;
      const double y2 = squared_radius_[ky], q2 = x * x + y2;
      const std::complex<double> turn((x * x - y2) / q2, 2 * x * std::sqrt(y2) / q2);
      const double above = mirrored * norm(column[ky]), below = single ? 0 : mirrored * norm(column[ny - ky]);
      const double modes = mirrored * (single ? 1 : 2);
      Directions* const ring = &sums[static_cast<std::size_t>(std::sqrt(q2) + 0.5) * most];
      std::complex<double> at = turn;
      for (std::size_t m = 0; m < most; ++m, at *= turn) {
        ring[m].cosine += (above + below) * at.real();
        if (!single) ring[m].sine += (above - below) * at.imag();
        ring[m].modes += modes * at.real();
      }
    }
  }

  /// Sums of |h|^2 k_i k_j.
  struct Slopes {
    double xx = 0, xy = 0, yy = 0, modes = 0;
    void add(const Slopes& other) {
      modes += other.modes;
      xx += other.xx;
      xy += other.xy;
      yy += other.yy;
    }
    static constexpr double enough = 16;  // modes
    /// Mean squares of the principal slopes, the greater first.
    [[nodiscard]] std::array<double, 2> principal() const {
      const double mean = (xx + yy) / 2, split = std::hypot((xx - yy) / 2, xy);
      return {mean + split, std::fmax(0, mean - split)};
    }
    /// Of the principal slopes; none where one is 0, or of few modes.
    [[nodiscard]] std::optional<double> ratio() const {
      const auto [across, along] = principal();
      return modes >= enough && along > 1e-12 * across ? std::optional(std::sqrt(across / along)) : std::nullopt;
    }
  };
  /// Of the modes of column k_x from one wavenumber to another [1/m].
  template <class T>
  void add_slopes(std::size_t kx, const std::complex<T>* column, double lowest, double highest, Slopes& sums) const {
    const std::size_t ny = shape_[0];
    const double x = radius(kx, side_x_), x2 = x * x, low = lowest / dq(), high = highest / dq();
    Slopes of;
    for (std::size_t ky = 0; ky <= ny / 2; ++ky) {
      const double y2 = squared_radius_[ky], q2 = x2 + y2;
      if (is_above(q2, high * high)) break;
      if (is_below(q2, low * low)) continue;
      const bool single = ky == 0 || 2 * ky == ny;  // of either sign
      const double above = norm(column[ky]), below = single ? 0 : norm(column[ny - ky]);
      of.xx += (above + below) * x2;
      if (!single) of.xy += (above - below) * x * std::sqrt(y2);
      of.yy += (above + below) * y2;
      of.modes += single ? 1 : 2;
    }
    const double mirrored = kx == 0 || 2 * kx == shape_[1] ? 1 : 2;
    sums.add({mirrored * of.xx, mirrored * of.xy, mirrored * of.yy, of.modes});
  }

  /// Adds the modes of column k_x, all ny of them, k_y and -k_y together: they lie in one ring.
  template <class T>
  void add_column(std::size_t kx, const std::complex<T>* column, std::vector<Ring>& sums) const {
    const std::size_t ny = shape_[0];
    const double x = radius(kx, side_x_), x2 = x * x;
    // off the axes k_x = 0 and k_x = nx / 2 a mode stands for its mirror image too
    const double images = kx == 0 || 2 * kx == shape_[1] ? 1 : 2;
    const Pair of_power{images, images * images};
    for (std::size_t ky = 0; ky <= ny / 2; ++ky) {
      const bool single = ky == 0 || 2 * ky == ny;
      const double length = std::sqrt(x2 + squared_radius_[ky]);
      const double above = norm(column[ky]), below = single ? 0 : norm(column[ny - ky]);
      Ring& sum = sums[static_cast<std::size_t>(length + 0.5)];
      sum.power += of_power * Pair{above + below, above * above + below * below};
      sum.modes += images * (single ? 0.5 : 1) * Pair{length, 1};
    }
  }

 private:
  template <class T>
  static double norm(std::complex<T> z) {
    return static_cast<double>(z.real()) * z.real() + static_cast<double>(z.imag()) * z.imag();
  }

  static constexpr double most_rings = 1e6;

  /// |q| / dq of the k-th mode along a side.
  [[nodiscard]] double radius(std::size_t k, double side) const { return static_cast<double>(k) * longest_ / side; }

  HeightMap::Shape shape_;
  double ly_, lx_, coarser_, side_y_, side_x_, longest_;
  std::size_t count_;
  std::vector<double> squared_radius_;  // of k_y = 0 .. ny / 2
};

/// With `most` harmonics of each ring, or none.
struct RingSums {
  std::vector<Ring> rings;
  std::vector<Rings::Directions> directions;
  Rings::Slopes slopes = {};
};
RingSums ring_sums(const HeightMap& map, const Rings& rings, const Preparation& prepared, unsigned threads,
                   std::size_t most, const Reliability& reliable) {
  RingSums total{std::vector<Ring>(rings.size()), std::vector<Rings::Directions>(rings.size() * most)};
  std::vector<RingSums> parts(threads, total);
  for_each_mode_column(map, prepared, threads, [&](unsigned part, std::size_t kx, const auto* column) {
    rings.add_column(kx, column, parts[part].rings);
    rings.add_slopes(kx, column, reliable.lowest, reliable.highest, parts[part].slopes);
    if (most > 0) rings.add_directions(kx, column, most, parts[part].directions);
  });
  for (const RingSums& part : parts) {
    total.slopes.add(part.slopes);
    for (std::size_t i = 0; i < part.directions.size(); ++i) {
      total.directions[i].cosine += part.directions[i].cosine;
      total.directions[i].sine += part.directions[i].sine;
      total.directions[i].modes += part.directions[i].modes;
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
      total.rings[r].power += part.rings[r].power;
      total.rings[r].modes += part.rings[r].modes;
    }
  }
  return total;
}

/// The harmonics up to the last that some octave of the scan's roughness supports: rows of noise have the most modes,
/// and would drown others in a mean over all.
RingHarmonics supported(const RingHarmonics& all, const RowQuality& quality, std::span<const double> q,
                        std::span<const double> density) {
  constexpr double sure = 4;            // standard errors of a mean over an octave
  constexpr double least_share = 1e-3;  // of the mean square slope
  struct Octave {
    double slope = 0, cosine = 0, sine = 0, variance = 0;
  };
  const std::size_t rows = q.size();
  std::size_t count = 1;
  for (std::size_t m = 1; m < all.count; ++m) {
    std::vector<Octave> octaves;
    double whole = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      if (quality.flag[i] != 0) continue;
      const auto number = static_cast<std::size_t>(std::log2(q[i] / q[0]));
      if (octaves.size() <= number) octaves.resize(number + 1);
      Octave& o = octaves[number];
      const double power = quality.count[i] * density[i], error = power * all.standard_error[i * all.count + m];
      o.slope += power * q[i] * q[i];
      whole += power * q[i] * q[i];
      o.cosine += power * all.cosine[i * all.count + m];
      o.sine += power * all.sine[i * all.count + m];
      o.variance += error * error;
    }
    if (std::ranges::any_of(octaves, [&](const Octave& o) {
          return o.slope > least_share * whole && std::hypot(o.cosine, o.sine) > sure * std::sqrt(o.variance);
        }))
      count = m + 1;
  }
  RingHarmonics result{count, {}, {}, {}};
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t m = 0; m < count; ++m) {
      result.cosine.push_back(all.cosine[i * all.count + m]);
      result.sine.push_back(all.sine[i * all.count + m]);
      result.standard_error.push_back(all.standard_error[i * all.count + m]);
    }
  return result;
}

/// Of about 512 rows: their waves are the map's.
std::optional<HeightShape> height_shape(const HeightMap& map, const std::optional<Trend>& trend) {
  constexpr std::size_t enough = 512;
  const std::size_t step = std::max<std::size_t>(1, map.shape()[0] / enough);
  HeightMoments moments;
  const double anchor = trend ? 0 : first_height(map);
  const auto row_at = [&](std::size_t y) {
    Eigen::ArrayXd row(static_cast<Eigen::Index>(map.shape()[1]));
    map.read_row(y, row.data());
    if (trend) trend->subtract(y, row.data(), row.data());
    return row;
  };
  for (std::size_t y = 0; y < map.shape()[0]; y += step) {
    const Eigen::ArrayXd row = row_at(y);
    moments.add(row, anchor);
    if (y + 4 < map.shape()[0]) moments.add_across(row, row_at(y + 2), row_at(y + 4));
  }
  return moments.shape();
}

/// The heights above (or below) the mean plane, the others set to it, and the share of the points that they are.
std::pair<HeightMap, double> one_side(const HeightMap& map, std::optional<Detrend> detrend, Part part) {
  const HeightMap flat = detrend ? map.detrend(*detrend) : map;
  const double mean = flat.statistics().mean;
  double points = 0;
  HeightMap side = map_rows(flat, [&](std::size_t, std::span<double> row) { points += keep_side(row, mean, part); });
  const auto [ny, nx] = map.shape();
  return {std::move(side), points / (static_cast<double>(ny) * static_cast<double>(nx))};
}

// |h|^2 of a mode is spread like its own mean (exponentially, for a Gaussian surface), so that its square, whose mean
// is twice the variance, tells the error of the ring's mean even where the ring's modes are not alike. Rings are as
// many rows apart as rings, but for empty ones near the corner.
TabulatedSpectrum ring_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads,
                                std::size_t most) {
  if (threads == 0 || threads > 1024) refuse("threads", threads, "from 1 to 1024");
  const Preparation prepared = prepare(map, window, detrend, threads);
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  const Rings rings(map.shape(), map.pixel_size());
  const std::vector<double>& covariances = prepared.ring_covariances;
  const Reliability reliable = rings.reliable(window, prepared);
  const auto [sums, directions, slopes] = ring_sums(map, rings, prepared, threads, most, reliable);
  RingHarmonics harmonics{most, {}, {}, {}};
  std::vector<double> wavenumber, density;
  RowQuality quality;
  quality.heights = height_shape(map, prepared.trend);
  if (quality.heights) quality.heights->slope_ratio = slopes.ratio();
  for (std::size_t ring = 1; ring < rings.size(); ++ring) {  // ring 0 is the mean height
    const Ring& sum = sums[ring];
    const double modes = 2 * sum.modes[1];  // k_y and -k_y were counted as one
    if (modes == 0) continue;               // non-square pixels leave rings empty near the corner
    wavenumber.push_back(rings.dq() * 2 * sum.modes[0] / modes);
    density.push_back(prepared.scale * sum.power[0] / modes);
    quality.count.push_back(modes);
    quality.standard_error.push_back(prepared.scale * std::sqrt(covariances[0] * sum.power[1] / 2) / modes);
    for (std::size_t m = 0; m < most; ++m) {
      // less what modes that lie unevenly in the ring would have of a flat spectrum
      const Rings::Directions& of = directions[ring * most + m];
      std::complex<double> mean(0);
      if (sum.power[0] > 0) mean = {of.cosine / sum.power[0] - of.modes / modes, of.sine / sum.power[0]};
      mean /= std::fmax(1, std::abs(mean));
      harmonics.cosine.push_back(mean.real());
      harmonics.sine.push_back(mean.imag());
      harmonics.standard_error.push_back(sum.power[0] > 0 ? std::sqrt(covariances[0] * sum.power[1]) / 2 / sum.power[0]
                                                          : 1);
    }
    quality.flag.push_back(reliable.flag(wavenumber.back(), modes));
    for (std::size_t m = 1; m < covariances.size(); ++m) quality.correlation.push_back(covariances[m] / covariances[0]);
  }
  if (wavenumber.size() < 2)
    throw InvalidInput(argument("surface") + " has shape (" + std::to_string(ny) + ", " + std::to_string(nx) + ")" +
                       must(": must have ") + "more points; these make only one ring of wavenumbers");
  if (most > 0) harmonics = supported(harmonics, quality, wavenumber, density);
  const double nyquist = std::min(pi / std::max(dy, dx), wavenumber.back());  // beyond it rings are incomplete
  return {std::move(wavenumber), std::move(density), std::move(quality), std::move(harmonics), nyquist};
}

}  // namespace

// <dh/dx_i dh/dx_j> = int q_i q_j C d^2q, whose principal axis of the lesser value is the lay.
Anisotropy anisotropy(const HeightMap& map, Window window, std::optional<Detrend> detrend, std::optional<double> q_min,
                      std::optional<double> q_max) {
  if (q_min) require_positive("q_min", *q_min);
  if (q_max) require_positive("q_max", *q_max);
  const Preparation prepared = prepare(map, window, detrend, 1);
  const Rings rings(map.shape(), map.pixel_size());
  const Reliability reliable = rings.reliable(window, prepared);
  const double lowest = q_min.value_or(reliable.lowest), highest = q_max.value_or(reliable.highest);
  if (!(highest > lowest))
    throw InvalidInput(argument("surface") + ": has no band between " + show(lowest, 6) +
                       " 1/m, the longest waves that the window leaves, and " + show(highest, 6) +
                       ", half of pi / pixel: is too small for its anisotropy; q_min and q_max choose one");
  Rings::Slopes sums;
  for_each_mode_column(map, prepared, 1, [&](unsigned, std::size_t kx, const auto* column) {
    rings.add_slopes(kx, column, lowest, highest, sums);
  });
  if (sums.modes < Rings::Slopes::enough)
    throw InvalidInput(argument("q_min") + ", " + argument("q_max") + ": " + show(sums.modes) +
                       " modes of the map in [" + show(lowest, 6) + ", " + show(highest, 6) + "] 1/m" + must_be() +
                       show(Rings::Slopes::enough) + " or more for its anisotropy");
  const auto [across, along] = sums.principal();
  const double to_slope = prepared.scale * rings.area_of_mode() * rings.dq() * rings.dq();
  const double steep = std::atan2(2 * sums.xy, sums.xx - sums.yy) / 2;  // of the greatest slope, in (-pi/2, pi/2]
  return {std::sqrt(to_slope * across), std::sqrt(to_slope * along), steep > 0 ? steep - pi / 2 : steep + pi / 2};
}

TabulatedSpectrum directional_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend,
                                       unsigned threads) {
  constexpr std::size_t most = 16;
  return ring_spectrum(map, window, detrend, threads, most);
}

TabulatedSpectrum power_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads,
                                 Part part) {
  if (part != Part::all) {
    require_plane(map);
    const auto [side, share] = one_side(map, detrend, part);
    const TabulatedSpectrum spectrum = power_spectrum(side, window, Detrend::offset, threads);
    RowQuality quality = spectrum.quality();
    quality.heights.reset();  // they are those of the side, not of the map
    const TabulatedSpectrum table(spectrum.wavenumber(), spectrum.density(), std::move(quality), {}, spectrum.q1());
    return share > 0 ? scaled_table(table, 1 / share) : table;  // a constant map has no side
  }
  return ring_spectrum(map, window, detrend, threads, 0);
}

}  // namespace asperity
