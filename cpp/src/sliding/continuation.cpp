// A measured map made periodic: by its mirror images, or with its end joined to its beginning. Faded, over an eighth,
// weights are a sine and a cosine, whose squares add up to 1: waves that do not know of each other keep their variance,
// but skewed heights become Gaussian, and worn surfaces get peaks. Blended, over two of the shortest waves, weights add
// up to 1: heights stay between those that were measured.
#include <Eigen/Core>
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

using Heights = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The mean taken off, in two passes: the first height may be kilometres above them all.
void centre(Heights& heights) {
  const double first = heights(0, 0);
  heights -= first;
  for (int pass = 0; pass < 2; ++pass) heights -= heights.mean();
}

/// The rms height, which must be there.
double require_roughness(const Heights& heights) {
  const double rms = std::sqrt(heights.square().mean());
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

/// The last `margin` rows over the first ones.
Heights joined(const Heights& heights, Continuation continuation, std::size_t margin) {
  const auto over = static_cast<Eigen::Index>(margin), kept = heights.rows() - over;
  Heights result = heights.topRows(kept);
  for (Eigen::Index y = 0; y < over; ++y) {
    heed();
    const auto [beginning, end] = weights(continuation, (static_cast<double>(y) + 0.5) / static_cast<double>(margin));
    result.row(y) = beginning * heights.row(y) + end * heights.row(kept + y);
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
  const auto [ny, nx] = map.shape();
  if (ny < fewest || nx < fewest)
    throw InvalidInput(argument("height_map") + " has " + count(ny) + " x " + std::to_string(nx) + " points" +
                       must(": must have ") + "16 or more along both sides");
  if (map.dropout_fraction() > 0)
    throw InvalidInput(argument("height_map") + " has drop-outs (" + show(100 * map.dropout_fraction(), 3) +
                       " %); call fill_dropouts() first");
  Heights heights(ny, nx);
  for (std::size_t y = 0; y < ny; ++y) {
    heed();
    map.read_row(y, heights.data() + y * nx);
  }
  centre(heights);
  if (continuation == Continuation::fade || continuation == Continuation::blend) {
    require_roughness(heights);
    const auto [margin_y, margin_x] = margins(map, continuation, shortest);
    heights = joined(heights.transpose(), continuation, margin_x).transpose().eval();
    heights = joined(heights, continuation, margin_y);
  }
  if (continuation == Continuation::mirror) {
    Heights images(2 * heights.rows(), 2 * heights.cols());
    images << heights, heights.rowwise().reverse(), heights.colwise().reverse(), heights.reverse();
    heights.swap(images);
  }
  centre(heights);
  return {{static_cast<std::size_t>(heights.rows()), static_cast<std::size_t>(heights.cols())},
          {heights.data(), heights.data() + heights.size()},
          require_roughness(heights)};
}

HeightMap continued(const HeightMap& map, Continuation continuation) {
  Period period = one_period(map, continuation);
  return {std::move(period.heights), period.shape, map.pixel_size()};
}

}  // namespace asperity
