#include "spectrum/preparation.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "numerics/arguments.hpp"
#include "spectrum/window.hpp"

namespace asperity {

void require_filled(const HeightMap& map) {
  if (map.dropout_fraction() > 0)
    throw InvalidInput("surface: has drop-outs (" + show(100 * map.dropout_fraction(), 4) +
                       " %), fill_dropouts must come before its spectrum");
}

void require_plane(const HeightMap& map) {
  require_filled(map);
  const auto [ny, nx] = map.shape();
  if (ny < 2 || nx < 2)
    throw InvalidInput("surface has shape (" + std::to_string(ny) + ", " + std::to_string(nx) +
                       "): must be 2 x 2 or more for a two-dimensional spectrum; one line is a LineScan");
}

Preparation prepare(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads) {
  require_plane(map);
  const auto [ny, nx] = map.shape();
  Preparation result{window_weights(window, ny), window_weights(window, nx), {}, 0, 0};
  if (detrend) result.trend.emplace(map, *detrend, threads);
  const WindowMoments y(result.wy), x(result.wx);
  const auto [dy, dx] = map.pixel_size();
  constexpr double pi = std::numbers::pi;
  const double n = static_cast<double>(ny) * static_cast<double>(nx);
  result.scale = dy * dx / (4 * pi * pi * n) / (y.mean_square * x.mean_square);
  result.ring_variance_factor = std::sqrt(y.variance_factor * x.variance_factor);
  return result;
}

}  // namespace asperity
