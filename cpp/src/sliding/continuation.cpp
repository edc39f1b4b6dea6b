// A measured map made periodic: by its mirror images, or with its end joined to its beginning. Faded, over an eighth,
// weights are a sine and a cosine, whose squares add up to 1: waves that do not know of each other keep their variance,
// but skewed heights become Gaussian, and worn surfaces get peaks. Blended, over two of the shortest waves, weights add
// up to 1: heights stay between those that were measured.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "sliding/slide_period.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

namespace {

constexpr std::size_t fewest = 16;  // points along a side

/// The mean taken off, in two passes: the first height may be kilometres above them all.
void centre(std::vector<double>& heights) {
  for (int pass = 0; pass < 2; ++pass) {
    double sum = 0;
    const double first = pass == 0 ? heights.front() : 0;
    for (double& h : heights) sum += h -= first;
    const double mean = sum / static_cast<double>(heights.size());
    for (double& h : heights) h -= mean;
  }
}

/// The rms height, which must be there.
double require_roughness(const std::vector<double>& heights) {
  double square = 0;
  for (const double h : heights) square += h * h;
  const double rms = std::sqrt(square / static_cast<double>(heights.size()));
  if (!(rms > 0) || !std::isfinite(rms))
    throw InvalidInput(argument("height_map") + " has an rms height of " + show(rms, 3) + " m" + must(": must have ") +
                       "roughness");
  return rms;
}

struct Weights {
  double beginning, end;
};

/// At a share of the margin, from 0 to 1.
Weights weights(Continuation continuation, double share) {
  const double s = std::sin(std::numbers::pi / 2 * share), c = std::cos(std::numbers::pi / 2 * share);
  if (continuation == Continuation::fade) return {s, c};
  return {s * s, c * c};
}

/// One axis joined: its last `margin` points over its first ones.
std::vector<double> joined(const std::vector<double>& heights, HeightMap::Shape shape, bool along_x,
                           Continuation continuation, std::size_t margin) {
  const std::size_t kept = shape[along_x ? 1 : 0] - margin;
  const std::size_t ny = along_x ? shape[0] : kept, nx = along_x ? kept : shape[1];
  std::vector<double> result(ny * nx);
  for (std::size_t y = 0; y < ny; ++y) {
    heed();
    for (std::size_t x = 0; x < nx; ++x) {
      const std::size_t i = along_x ? x : y;
      double h = heights[y * shape[1] + x];
      if (i < margin) {
        const auto [beginning, end] =
            weights(continuation, (static_cast<double>(i) + 0.5) / static_cast<double>(margin));
        const std::size_t other = along_x ? y * shape[1] + x + kept : (y + kept) * shape[1] + x;
        h = beginning * h + end * heights[other];
      }
      result[y * nx + x] = h;
    }
  }
  return result;
}

std::vector<double> mirrored(const std::vector<double>& heights, HeightMap::Shape shape) {
  const auto [ny, nx] = shape;
  std::vector<double> result(4 * heights.size());
  for (std::size_t y = 0; y < 2 * ny; ++y) {
    heed();
    const std::size_t from = std::min(y, 2 * ny - 1 - y);
    for (std::size_t x = 0; x < 2 * nx; ++x) result[y * 2 * nx + x] = heights[from * nx + std::min(x, 2 * nx - 1 - x)];
  }
  return result;
}

/// Where the roughness of a map ends [1/m].
double roughness_end(const HeightMap& map) { return RoughnessWindow(segments_of_rows(power_spectrum(map))).end(); }

/// Points of both axes over which the map is joined.
HeightMap::Shape margins(const HeightMap& map, Continuation continuation, double shortest) {
  const auto [ny, nx] = map.shape();
  if (continuation == Continuation::fade) return {ny / 8, nx / 8};
  constexpr double waves = 2;
  const double length = waves * 2 * std::numbers::pi / std::min(shortest, roughness_end(map));
  const auto points = [&](std::size_t n, double pixel) {
    return std::clamp(static_cast<std::size_t>(std::ceil(std::min(length / pixel, static_cast<double>(n)))),
                      std::size_t{2}, n / 4);
  };
  return {points(ny, map.pixel_size()[0]), points(nx, map.pixel_size()[1])};
}

}  // namespace

Period one_period(const HeightMap& map, Continuation continuation, double shortest) {
  Period period{map.shape(), std::vector<double>(map.shape()[0] * map.shape()[1]), 0};
  auto& [shape, heights, rms] = period;
  if (shape[0] < fewest || shape[1] < fewest)
    throw InvalidInput(argument("height_map") + " has " + count(shape[0]) + " x " + std::to_string(shape[1]) +
                       " points" + must(": must have ") + "16 or more along both sides");
  if (map.dropout_fraction() > 0)
    throw InvalidInput(argument("height_map") + " has drop-outs (" + show(100 * map.dropout_fraction(), 3) +
                       " %); call fill_dropouts() first");
  for (std::size_t y = 0; y < shape[0]; ++y) {
    heed();
    map.read_row(y, heights.data() + y * shape[1]);
  }
  centre(heights);
  if (continuation == Continuation::fade || continuation == Continuation::blend) {
    require_roughness(heights);
    const HeightMap::Shape margin = margins(map, continuation, shortest);
    for (const std::size_t axis : {std::size_t{1}, std::size_t{0}}) {
      heights = joined(heights, shape, axis == 1, continuation, margin[axis]);
      shape[axis] -= margin[axis];
    }
  }
  if (continuation == Continuation::mirror) {
    heights = mirrored(heights, shape);
    shape = {2 * shape[0], 2 * shape[1]};
  }
  centre(heights);
  rms = require_roughness(heights);
  return period;
}

HeightMap continued(const HeightMap& map, Continuation continuation) {
  Period period = one_period(map, continuation);
  return {std::move(period.heights), period.shape, map.pixel_size()};
}

}  // namespace asperity
