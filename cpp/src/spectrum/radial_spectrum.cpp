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
#include "spectrum/preparation.hpp"
#include "spectrum/ring_covariance.hpp"
#include "spectrum/tabulated.hpp"
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
      : shape_(shape), ly_(static_cast<double>(shape[0]) * pixel[0]), lx_(static_cast<double>(shape[1]) * pixel[1]) {
    // sides in units of dx, so that the rings do not depend on the unit of length: exact for square pixels
    side_y_ = static_cast<double>(shape[0]) * (pixel[0] / pixel[1]);
    side_x_ = static_cast<double>(shape[1]);
    longest_ = std::max(side_y_, side_x_);
    for (std::size_t k = 0; k <= shape[0] / 2; ++k) squared_radius_.push_back(std::pow(radius(k, side_y_), 2));
    const double corner = std::sqrt(std::pow(radius(shape[1] / 2, side_x_), 2) + squared_radius_.back());
    const std::size_t columns = shape[1] / 2 + 1;
    const double modes = static_cast<double>(shape[0]) * static_cast<double>(columns);
    if (!(corner <= most_rings || corner <= modes))  // of more rings than modes most are empty
      throw InvalidInput(
          argument("pixel_size") + " = " +
          Phrase(Phrase::Kind::value, "(" + show(pixel[0]) + ", " + show(pixel[1]) + ")", {pixel[0], pixel[1]}) +
          ": its aspect of " + show(std::fmax(pixel[0] / pixel[1], pixel[1] / pixel[0]), 3) + " makes " +
          show(corner, 3) + " rings of wavenumbers for the " + show(modes) + " modes of this map" + must_be() +
          "at most " + show(most_rings));
    count_ = static_cast<std::size_t>(std::lround(corner)) + 1;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] double dq() const { return 2 * pi / std::max(ly_, lx_); }

  /// Rings that are being summed, and room for half a column, k_y = 0 .. ny / 2.
  struct Sums {
    std::vector<Ring> own, mirrored;  // of columns that are their own mirror image, and of the others
    std::vector<Pair> power;
    std::vector<double> length;
    std::vector<int> ring;
    explicit Sums(const Rings& rings)
        : own(rings.size()),
          mirrored(rings.size()),
          power(rings.squared_radius_.size()),
          length(power.size()),
          ring(power.size()) {}
  };

  /// Adds the modes of column k_x, all ny of them, k_y and -k_y together: they lie in one ring.
  template <class T>
  void add_column(std::size_t kx, const std::complex<T>* column, Sums& sums) const {
    const std::size_t ny = shape_[0], last = ny / 2;
    const double x = radius(kx, side_x_), x2 = x * x;
    const double* const y2 = squared_radius_.data();
    double* const length = sums.length.data();
    int* const ring = sums.ring.data();
    for (std::size_t ky = 0; ky <= last; ++ky) {
      length[ky] = std::sqrt(x2 + y2[ky]);
      ring[ky] = static_cast<int>(length[ky] + 0.5);  // NOLINT(bugprone-incorrect-roundings): it runs on vectors
    }
    Pair* const power = sums.power.data();
    for (std::size_t ky = 1; ky <= last; ++ky) {
      const double above = norm(column[ky]), below = norm(column[ny - ky]);
      power[ky] = Pair{above + below, above * above + below * below};
    }
    // off the axes k_x = 0 and k_x = nx / 2 a mode stands for its mirror image too
    Ring* const rings = (kx == 0 || 2 * kx == shape_[1] ? sums.own : sums.mirrored).data();
    for (std::size_t ky = 1; 2 * ky < ny; ++ky) {
      Ring& sum = rings[ring[ky]];
      sum.power += power[ky];
      sum.modes += Pair{length[ky], 1};
    }
    const auto single = [&](std::size_t ky) {
      const double alone = norm(column[ky]);
      rings[ring[ky]].power += Pair{alone, alone * alone};
      rings[ring[ky]].modes += 0.5 * Pair{length[ky], 1};
    };
    single(0);
    if (2 * last == ny) single(last);
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
  double ly_, lx_, side_y_, side_x_, longest_;
  std::size_t count_;
  std::vector<double> squared_radius_;  // of k_y = 0 .. ny / 2
};

std::vector<Ring> ring_sums(const HeightMap& map, const Rings& rings, const Preparation& prepared, unsigned threads) {
  std::vector<Rings::Sums> sums(threads, Rings::Sums(rings));
  for_each_mode_column(map, prepared, threads, [&](unsigned part, std::size_t kx, const auto* column) {
    rings.add_column(kx, column, sums[part]);
  });
  std::vector<Ring> total(rings.size());
  for (const Rings::Sums& part : sums)
    for (std::size_t r = 0; r < rings.size(); ++r) {
      total[r].power += part.own[r].power + Pair{2, 4} * part.mirrored[r].power;
      total[r].modes += part.own[r].modes + 2 * part.mirrored[r].modes;
    }
  return total;
}

/// Of about 512 rows: their waves are the map's.
std::optional<HeightShape> height_shape(const HeightMap& map, const std::optional<Trend>& trend) {
  constexpr std::size_t enough = 512;
  const std::size_t step = std::max<std::size_t>(1, map.shape()[0] / enough);
  HeightMoments moments;
  const double anchor = trend ? 0 : first_height(map);
  std::vector<double> row(map.shape()[1]);
  for (std::size_t y = 0; y < map.shape()[0]; y += step) {
    map.read_row(y, row.data());
    if (trend) trend->subtract(y, row.data(), row.data());
    moments.add(row, anchor);
  }
  return moments.shape();
}

/// The heights above (or below) the mean plane, the others set to it, and the share of the points that they are.
std::pair<HeightMap, double> one_side(const HeightMap& map, std::optional<Detrend> detrend, Part part) {
  const HeightMap flat = detrend ? map.detrend(*detrend) : map;
  const double mean = flat.statistics().mean;
  double points = 0;
  HeightMap side = map_rows(flat, [&](std::size_t, std::span<double> row) {
    for (double& z : row) {
      const bool mine = part == Part::top ? z > mean : z < mean;
      z = mine ? z - mean : 0;
      points += mine;
    }
  });
  const auto [ny, nx] = map.shape();
  return {std::move(side), points / (static_cast<double>(ny) * static_cast<double>(nx))};
}

}  // namespace

// |h|^2 of a mode is spread like its own mean (exponentially, for a Gaussian surface), so that its square, whose mean
// is twice the variance, tells the error of the ring's mean even where the ring's modes are not alike. Rings are as
// many rows apart as rings, but for empty ones near the corner.
TabulatedSpectrum power_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads,
                                 Part part) {
  if (threads == 0 || threads > 1024) refuse("threads", threads, "from 1 to 1024");
  if (part != Part::all) {
    require_plane(map);
    const auto [side, share] = one_side(map, detrend, part);
    const TabulatedSpectrum spectrum = power_spectrum(side, window, Detrend::offset, threads);
    RowQuality quality = spectrum.quality();
    quality.heights.reset();  // they are those of the side, not of the map
    const TabulatedSpectrum table(spectrum.wavenumber(), spectrum.density(), std::move(quality));
    return share > 0 ? scaled_table(table, 1 / share) : table;  // a constant map has no side
  }
  const Preparation prepared = prepare(map, window, detrend, threads);
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  const Rings rings(map.shape(), map.pixel_size());
  const std::vector<Ring> sums = ring_sums(map, rings, prepared, threads);
  const double shorter = std::min(static_cast<double>(ny) * dy, static_cast<double>(nx) * dx);
  const std::vector<double>& covariances = prepared.ring_covariances;
  const Reliability reliable(window, shorter, std::max(dy, dx), covariances[0]);
  std::vector<double> wavenumber, density;
  RowQuality quality;
  quality.heights = height_shape(map, prepared.trend);
  for (std::size_t ring = 1; ring < rings.size(); ++ring) {  // ring 0 is the mean height
    const Ring& sum = sums[ring];
    const double modes = 2 * sum.modes[1];  // k_y and -k_y were counted as one
    if (modes == 0) continue;               // non-square pixels leave rings empty near the corner
    wavenumber.push_back(rings.dq() * 2 * sum.modes[0] / modes);
    density.push_back(prepared.scale * sum.power[0] / modes);
    quality.count.push_back(modes);
    quality.standard_error.push_back(prepared.scale * std::sqrt(covariances[0] * sum.power[1] / 2) / modes);
    quality.flag.push_back(reliable.flag(wavenumber.back(), modes));
    for (std::size_t m = 1; m < covariances.size(); ++m) quality.correlation.push_back(covariances[m] / covariances[0]);
  }
  if (wavenumber.size() < 2)
    throw InvalidInput(argument("surface") + " has shape (" + std::to_string(ny) + ", " + std::to_string(nx) + ")" +
                       must(": must have ") + "more points; these make only one ring of wavenumbers");
  return {std::move(wavenumber), std::move(density), std::move(quality)};
}

}  // namespace asperity
