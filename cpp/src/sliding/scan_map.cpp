// The heights of a scan between q0 and q1 alone: modes of the closed map outside of the band are left out, and those
// inside summed on a grid that is as fine as the shortest wave asks for, finer or coarser than the scan's own.
#include "sliding/scan_map.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

constexpr std::size_t fewest = 32;  // points along a side

/// The next length of 8, 9, 10, 12 or 15 times a power of two, whose transforms are quick.
std::size_t quick_length(double n) {
  for (std::size_t power = 1;; power *= 2)
    for (const std::size_t factor : {8, 9, 10, 12, 15})
      if (const std::size_t length = factor * power;
          length >= fewest && length % 2 == 0 && static_cast<double>(length) >= n)
        return length;
}

/// The modes of `from` inside of the band as heights on the grid `to`.
std::vector<double> band_heights(const std::vector<double>& heights, Grid from, Grid to, double length_y,
                                 double length_x, const Band& band) {
  const auto modes = forward_transform(heights, from);
  const std::size_t half_from = from[1] / 2 + 1, half_to = to[1] / 2 + 1;
  std::vector<std::complex<double>> kept(to[0] * half_to);
  const double norm = 1 / static_cast<double>(from[0] * from[1]);
  // waves of two points, of either grid, have no phase: they are left out
  const std::size_t rows = (std::min(from[0], to[0]) - 1) / 2, columns = (std::min(from[1], to[1]) - 1) / 2;
  for (std::size_t y = 0; y < from[0]; ++y) {
    heed();
    const std::size_t wave = std::min(y, from[0] - y);
    if (wave > rows) continue;
    const std::size_t row = y <= rows ? y : to[0] - wave;
    const double qy = 2 * pi / length_y * static_cast<double>(wave);
    for (std::size_t x = 0; x <= columns; ++x) {
      const double q = std::hypot(qy, 2 * pi / length_x * static_cast<double>(x));
      if (is_within(q, band.q0, band.q1)) kept[row * half_to + x] = norm * modes[y * half_from + x];
    }
  }
  return backward_transform(kept, to);
}

/// Points along a side: the scan's own where these are enough and few more, which leaves the pixels where they are.
std::size_t grid_length(std::size_t scanned, double needed) {
  constexpr double spare = 1.2;
  const auto own = static_cast<double>(scanned);
  return own >= needed && own <= spare * needed && scanned % 2 == 0 ? scanned : quick_length(needed);
}

double shortest_wave(const Spectrum& rings) { return 2 * pi / RoughnessWindow(segments(rings)).end(); }

/// The rows of a band as far as the table has them.
Spectrum within(const TabulatedSpectrum& table, const Band& band) {
  const auto [first, last] = asperity::band(Spectrum(table));
  const double q0 = std::max(band.q0, first), q1 = std::min(band.q1, last);
  if (!is_below(q0, q1))
    throw InvalidInput(argument("height_map") + ": the band of the spectrum, " + show(band.q0, 4) + " to " +
                       show(band.q1, 4) + " 1/m, has less than two rings of its waves, which are known from " +
                       show(first, 4) + " to " + show(last, 4) + " 1/m");
  return truncated(Spectrum(table), q0, q1);
}

}  // namespace

Band known_band(const HeightMap& map) {
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  return {2 * pi / std::max(static_cast<double>(ny) * dy, static_cast<double>(nx) * dx), pi / std::max(dy, dx)};
}

double grid_points(const HeightMap& map, const Band& band, double points_a_wave) {
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  const double wave = shortest_wave(within(power_spectrum(map), band));
  return static_cast<double>(ny) * dy * static_cast<double>(nx) * dx * std::pow(points_a_wave / wave, 2);
}

Spectrum scan_rings(const HeightMap& map, Continuation continuation, const Band& band) {
  Period closed = one_period(map, continuation, band.q1);
  const HeightMap whole(std::move(closed.heights), closed.shape, map.pixel_size());
  return within(power_spectrum(whole, Window::none, std::nullopt), band);
}

ScanMap scan_map(const HeightMap& map, Continuation continuation, const Band& band, double points_a_wave,
                 double shortest) {
  Period closed = one_period(map, continuation, shortest);
  const auto [dy, dx] = map.pixel_size();
  const double length_y = dy * static_cast<double>(closed.shape[0]),
               length_x = dx * static_cast<double>(closed.shape[1]);
  const HeightMap whole(closed.heights, closed.shape, map.pixel_size());
  Spectrum rings = within(power_spectrum(whole, Window::none, std::nullopt), band);
  const double wave = shortest_wave(rings);
  const Grid grid{grid_length(closed.shape[0], points_a_wave * length_y / wave),
                  grid_length(closed.shape[1], points_a_wave * length_x / wave)};
  std::vector<double> heights = band_heights(closed.heights, closed.shape, grid, length_y, length_x, band);
  double square = 0;
  for (const double h : heights) square += h * h;
  const double rms = std::sqrt(square / static_cast<double>(heights.size()));
  return {{grid, std::move(heights), rms},
          {length_y / static_cast<double>(grid[0]), length_x / static_cast<double>(grid[1])},
          std::move(rings),
          closed.shape};
}

HeightMap scan_part(const HeightMap& map, int part, std::size_t most) {
  const auto [ny, nx] = map.shape();
  const std::size_t half_y = ny / 2, half_x = nx / 2, py = std::min(half_y, most), px = std::min(half_x, most);
  const std::size_t first_y = (part / 2 == 0 ? 0 : ny - half_y) + (half_y - py) / 2;
  const std::size_t first_x = (part % 2 == 0 ? 0 : nx - half_x) + (half_x - px) / 2;
  std::vector<double> row(nx), heights(py * px);
  for (std::size_t y = 0; y < py; ++y) {
    map.read_row(first_y + y, row.data());
    std::copy_n(row.data() + first_x, px, heights.data() + y * px);
  }
  return HeightMap(std::move(heights), {py, px}, map.pixel_size()).detrend(Detrend::plane);
}

}  // namespace asperity
