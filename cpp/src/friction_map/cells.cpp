// The cells of a map: a quadtree whose leaves hold bicubic Hermite polynomials; beside a larger neighbour a corner
// takes the neighbour's values, so that the map has continuous derivatives.
#include <algorithm>

#include "friction_map/format.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

/// Values and slopes along a side, in both functions, at t of it.
void blend(const std::array<double, 2>& a, const std::array<double, 2>& da, const std::array<double, 2>& b,
           const std::array<double, 2>& db, double h, double t, std::array<double, 2>& value,
           std::array<double, 2>& slope) {
  for (std::size_t k = 0; k < 2; ++k) {
    const ValueAndSlope at = hermite(a[k], da[k], b[k], db[k], h, t);
    value[k] = at.value;
    slope[k] = at.slope;
  }
}

}  // namespace

MapTree::MapTree(std::array<double, 2> x, std::vector<double> cuts, std::size_t planes)
    : x_(x), cuts_(std::move(cuts)), planes_(planes) {
  for (std::uint32_t k = 0; k < bands(); ++k) nodes_.push_back({0, k * unit, unit, unit});
}

double MapTree::z(std::uint32_t at) const {
  const std::uint32_t band = std::min(at / unit, bands() - 1);
  return cuts_[band] + (at - band * unit) * ((cuts_[band + 1] - cuts_[band]) / unit);
}

std::array<double, 2> MapTree::size(const Leaf& leaf) const {
  const std::uint32_t band = leaf.z / unit;
  return {leaf.wide * ((x_[1] - x_[0]) / unit), leaf.high * ((cuts_[band + 1] - cuts_[band]) / unit)};
}

void MapTree::halve(std::size_t node, bool in_x) {
  Leaf half = nodes_[node];
  (in_x ? half.wide : half.high) /= 2;
  nodes_[node].child = static_cast<std::int32_t>(nodes_.size());
  nodes_[node].in_x = in_x;
  nodes_.push_back(half);
  (in_x ? half.x : half.z) += in_x ? half.wide : half.high;
  nodes_.push_back(half);
}

std::size_t MapTree::leaf_around(std::uint32_t half_x, std::uint32_t half_z) const {
  std::size_t at = half_z / (2 * unit);
  while (nodes_[at].child >= 0) {
    const auto first = static_cast<std::size_t>(nodes_[at].child);
    const Leaf& second = nodes_[first + 1];
    const bool beyond = nodes_[at].in_x ? half_x > 2 * second.x : half_z > 2 * second.z;
    at = beyond ? first + 1 : first;
  }
  return at;
}

std::optional<MapTree::Side> MapTree::side_through(std::uint32_t x, std::uint32_t z) const {
  for (const bool above : {false, true})
    for (const bool right : {false, true}) {
      if (above ? z == bands() * unit : z == 0) continue;
      if (right ? x == unit : x == 0) continue;
      const std::size_t at = leaf_around(right ? 2 * x + 1 : 2 * x - 1, above ? 2 * z + 1 : 2 * z - 1);
      const Leaf& leaf = nodes_[at];
      if (!leaf.needed) continue;
      if (x != leaf.x && x != leaf.x + leaf.wide) return Side{at, true, above};
      if (z != leaf.z && z != leaf.z + leaf.high) return Side{at, false, above};
    }
  return std::nullopt;
}

std::vector<std::size_t> MapTree::holders(const Leaf& leaf) const {
  std::vector<std::size_t> result;
  for (const std::uint32_t x : {leaf.x, leaf.x + leaf.wide})
    for (const std::uint32_t z : {leaf.z, leaf.z + leaf.high})
      if (const std::optional<Side> side = side_through(x, z)) result.push_back(side->leaf);
  return result;
}

void MapTree::interpolate(std::size_t plane,
                          const std::function<const MapCorner&(std::uint32_t, std::uint32_t)>& free_corner) {
  std::unordered_map<std::uint64_t, MapCorner> known;
  // Halving makes no ring of corners that wait for each other.
  const std::function<const MapCorner&(std::uint32_t, std::uint32_t)> corner =
      [&](std::uint32_t x, std::uint32_t z) -> const MapCorner& {
    if (const auto at = known.find(key(x, z)); at != known.end()) return at->second;
    const std::optional<Side> side = side_through(x, z);
    if (!side) return known.emplace(key(x, z), free_corner(x, z)).first->second;
    const Leaf& leaf = nodes_[side->leaf];
    const auto [hx, hz] = size(leaf);
    MapCorner c = on_cut(z) ? free_corner(x, z) : MapCorner{};
    if (side->along_x) {
      const MapCorner a = corner(leaf.x, z), b = corner(leaf.x + leaf.wide, z);
      const double t = static_cast<double>(x - leaf.x) / leaf.wide;
      const std::size_t own = side->leaf_above, other = 1 - own;
      blend(a.f, a.x, b.f, b.x, hx, t, c.f, c.x);
      blend(a.z[own], a.xz[own], b.z[own], b.xz[own], hx, t, c.z[own], c.xz[own]);
      if (!on_cut(z)) c.z[other] = c.z[own], c.xz[other] = c.xz[own];
    } else {
      const MapCorner a = corner(x, leaf.z), b = corner(x, leaf.z + leaf.high);
      const double t = static_cast<double>(z - leaf.z) / leaf.high;
      blend(a.f, a.z[1], b.f, b.z[0], hz, t, c.f, c.z[0]);
      blend(a.x, a.xz[1], b.x, b.xz[0], hz, t, c.x, c.xz[0]);
      c.z[1] = c.z[0], c.xz[1] = c.xz[0];
    }
    return known.emplace(key(x, z), c).first->second;
  };
  for (Leaf& leaf : nodes_) {
    if (leaf.child >= 0 || !leaf.needed) continue;
    const auto [hx, hz] = size(leaf);
    leaf.polynomial.resize(planes_);
    std::array<double, 32> polynomial;
    for (std::size_t k = 0; k < 2; ++k) {
      // rows: value at both ends in x, slope in x at both; columns the same in z
      double m[4][4];
      for (std::size_t right = 0; right < 2; ++right)
        for (std::size_t above = 0; above < 2; ++above) {
          const MapCorner& c = corner(leaf.x + static_cast<std::uint32_t>(right) * leaf.wide,
                                      leaf.z + static_cast<std::uint32_t>(above) * leaf.high);
          m[right][above] = c.f[k];
          m[right][2 + above] = hz * c.z[1 - above][k];
          m[2 + right][above] = hx * c.x[k];
          m[2 + right][2 + above] = hx * hz * c.xz[1 - above][k];
        }
      const auto to_powers = [](double& a, double& b, double& da, double& db) {
        const double rise = b - a, slope = da, square = 3 * rise - 2 * da - db, cube = da + db - 2 * rise;
        b = slope, da = square, db = cube;
      };
      for (auto& row : m) to_powers(row[0], row[1], row[2], row[3]);
      for (std::size_t j = 0; j < 4; ++j) to_powers(m[0][j], m[1][j], m[2][j], m[3][j]);
      double per_x = 1;
      for (std::size_t p = 0; p < 4; ++p, per_x /= hx) {
        double scale = per_x;
        for (std::size_t j = 0; j < 4; ++j, scale /= hz) polynomial[8 * j + 2 * p + k] = m[p][j] * scale;
      }
    }
    leaf.changed = leaf.changed || leaf.polynomial[plane] != polynomial;
    leaf.polynomial[plane] = polynomial;
  }
}

std::array<double, 2> MapTree::value(const Leaf& leaf, std::size_t plane, double dx, double dz) {
  std::array<double, 2> result{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double* const c = &leaf.polynomial[plane][k];
    for (std::size_t j = 4; j-- > 0;)
      result[k] = result[k] * dz + (((c[8 * j + 6] * dx + c[8 * j + 4]) * dx + c[8 * j + 2]) * dx + c[8 * j]);
  }
  return result;
}

}  // namespace asperity
