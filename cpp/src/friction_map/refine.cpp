// Refinement of a map: cells are halved until ln mu_H and ln A/A0 keep the tolerance on lattices of 5 x 5 points and on
// random points unseen before, with heat at the nodes of height (T0, or the share of a slanted line, class Slant),
// between them, and at random. The numbers that
// they are held against, and the derivatives at corners, are those of polynomials through points of the solver
// (slices.hpp), whose error is added to the cell's.
#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

#include "asperity/watch.hpp"
#include "friction_map/format.hpp"
#include "friction_map/slices.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_cells = 100'000;
constexpr std::size_t unseen = 12;      // points a cell
constexpr double lattice_share = 0.45;  // of rtol, allowed on lattices: between their points errors are larger

class Builder {
 public:
  Builder(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress)
      : frame_(frame),
        rtol_(rtol),
        slices_(frame, rtol, threads, progress),
        tree_(frame.x(), frame.cuts(), slices_.planes()) {}

  /// Halves cells until lattices and unseen points agree.
  RefinedMap refine() && {
    for (;;) {
      do {
        interpolate();
        for (std::size_t n = 0; n < checked_.size(); ++n)
          if (Checked& cell = checked_[n]; wanted(n) && !cell.on_lattice) cell.on_lattice = lattice_error(n);
      } while (halve_where(&Checked::on_lattice, lattice_share * rtol_));
      for (std::size_t n = 0; n < checked_.size(); ++n)
        if (Checked& cell = checked_[n]; wanted(n) && !cell.unseen) cell.unseen = unseen_error(n);
      if (halve_where(&Checked::unseen, rtol_ / 2)) continue;
      const double error = 2 * largest_error();
      return {std::move(tree_), slices_.nodes(), error};
    }
  }

 private:
  /// Errors of a cell, where they have been found.
  struct Checked {
    std::optional<double> on_lattice, unseen;
  };

  [[nodiscard]] bool wanted(std::size_t node) {
    heed_at(node);
    return tree_.nodes()[node].child < 0 && tree_.nodes()[node].needed;
  }

  /// The polynomials of all cells; what was found of those that did not change holds.
  void interpolate() {
    for (std::size_t plane = 0; plane < tree_.planes(); ++plane) {
      heed();
      tree_.interpolate(plane,
                        [&](std::uint32_t x, std::uint32_t z) -> const MapCorner& { return corners(x, z)[plane]; });
    }
    checked_.resize(tree_.nodes().size());
    for (std::size_t n = 0; n < checked_.size(); ++n)
      if (wanted(n) && std::exchange(tree_.nodes()[n].changed, false)) checked_[n] = {};
  }

  /// Values and derivatives at a corner on each plane, on a cut those of either side.
  const std::vector<MapCorner>& corners(std::uint32_t x, std::uint32_t z) {
    const auto [at, is_new] = corners_.try_emplace(MapTree::key(x, z), tree_.planes());
    if (!is_new) return at->second;
    const std::uint32_t above = std::min(z / MapTree::unit, tree_.bands() - 1);
    for (const std::uint32_t side : {0u, 1u}) {
      const std::uint32_t band = tree_.on_cut(z) && side == 0 ? above - 1 : above;
      const std::vector<MapSlopes> found = slices_.slopes(band, {tree_.x(x), tree_.z(z)});
      for (std::size_t plane = 0; plane < found.size(); ++plane) {
        MapCorner& corner = at->second[plane];
        corner.f = found[plane].f;
        corner.x = found[plane].x;
        corner.z[side] = found[plane].z;
        corner.xz[side] = found[plane].xz;
      }
    }
    if (frame_.slant() && (z == 0 || z == tree_.bands() * MapTree::unit)) end_line(at->second);
    return at->second;
  }

  /// At the ends of z slanted lines are as short as a point: nothing changes along them, not by rounding either, as
  /// slopes over the velocity are those along a line over its length.
  static void end_line(std::vector<MapCorner>& planes) {
    for (std::size_t plane = 1; plane < planes.size(); ++plane) {
      const bool is_slope = plane % 2 == 1;
      planes[plane].f = is_slope ? std::array<double, 2>{} : planes[0].f;
      planes[plane].x = is_slope ? std::array<double, 2>{} : planes[0].x;
    }
  }

  /// Halves the leaves that are off by more than `allowed`, in the way in which their lattice bends more; whether there
  /// were any. A leaf whose corner is held by the side of a much larger one cannot be better than that side is: the
  /// larger one is halved too.
  bool halve_where(std::optional<double> Checked::*error, double allowed) {
    std::set<std::size_t> bad;
    std::size_t cells = 0;
    for (std::size_t i = 0; i < checked_.size(); ++i) {
      if (!wanted(i)) continue;
      ++cells;
      if (checked_[i].*error <= allowed) continue;
      bad.insert(i);
      const MapTree::Leaf& leaf = tree_.nodes()[i];
      for (const std::size_t holder : tree_.holders(leaf)) {
        const MapTree::Leaf& other = tree_.nodes()[holder];
        if (other.wide >= 4 * leaf.wide || other.high >= 4 * leaf.high) bad.insert(holder);
      }
    }
    bool stuck = cells + bad.size() > most_cells;
    for (const std::size_t i : bad) {
      const auto [in_x, in_z] = bending(tree_.nodes()[i]);
      bool way = in_x > in_z;
      if (!MapTree::can_halve(tree_.nodes()[i], way)) way = !way;
      stuck = stuck || !MapTree::can_halve(tree_.nodes()[i], way);
      if (stuck) break;
      tree_.halve(i, way);
      const auto child = static_cast<std::size_t>(tree_.nodes()[i].child);
      for (const std::size_t half : {child, child + 1}) {
        MapTree::Leaf& leaf = tree_.nodes()[half];
        const auto [wide, high] = tree_.size(leaf);
        leaf.needed = frame_.touches_box({tree_.x(leaf.x), tree_.z(leaf.z)}, {wide, high});
      }
    }
    if (stuck)
      throw NotConverged(argument("rtol") + " = " + asperity::value(rtol_) + ": " + show(2 * largest_error(), 3) +
                         " was reached with " + std::to_string(cells) + " cells");
    return !bad.empty();
  }

  double largest_error() {
    double largest = 0;
    for (std::size_t n = 0; n < checked_.size(); ++n)
      if (wanted(n))
        largest = std::fmax(largest, std::fmax(checked_[n].on_lattice.value_or(0), checked_[n].unseen.value_or(0)));
    return largest;
  }

  template <class Visit>
  void each_lattice_place(const MapTree::Leaf& leaf, Visit visit) const {
    for (std::uint32_t i = 0; i <= 4; ++i)
      for (std::uint32_t j = 0; j <= 4; ++j)
        visit(i, j, MapPlace{tree_.x(leaf.x + leaf.wide / 4 * i), tree_.z(leaf.z + leaf.high / 4 * j)});
  }

  /// Largest fourth difference of the functions on the lattice, in x and in z, at any height.
  [[nodiscard]] std::array<double, 2> bending(const MapTree::Leaf& leaf) {
    std::array<std::array<std::vector<MapSample>, 5>, 5> f;
    each_lattice_place(
        leaf, [&](std::uint32_t i, std::uint32_t j, const MapPlace& place) { f[i][j] = slices_.column(place); });
    std::array<double, 2> most{};
    for (std::size_t t = 0; t < f[0][0].size(); ++t)
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
          const auto fourth = [&](auto at) { return std::fabs(at(0) - 4 * at(1) + 6 * at(2) - 4 * at(3) + at(4)); };
          most[0] = std::fmax(most[0], fourth([&](std::size_t n) { return f[n][i][t].f[k]; }));
          most[1] = std::fmax(most[1], fourth([&](std::size_t n) { return f[i][n][t].f[k]; }));
        }
    return most;
  }

  /// The functions of a leaf at a height, by the cubic between two nodes.
  [[nodiscard]] std::array<double, 2> value(const MapTree::Leaf& leaf, const MapPlace& place, double height) const {
    const double dx = place.x - tree_.x(leaf.x), dz = place.z - tree_.z(leaf.z);
    if (tree_.planes() == 1) return MapTree::value(leaf, 0, dx, dz);
    const std::vector<double>& nodes = slices_.nodes();
    const double step = (nodes.back() - nodes.front()) / static_cast<double>(nodes.size() - 1);
    const double at = (height - nodes.front()) / step, last = static_cast<double>(nodes.size() - 2);
    const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, last));
    std::array<std::array<double, 2>, 4> f;
    for (std::size_t k = 0; k < 4; ++k) f[k] = MapTree::value(leaf, 2 * i + k, dx, dz);
    std::array<double, 2> result;
    for (std::size_t k = 0; k < 2; ++k)
      result[k] = hermite(f[0][k], f[1][k], f[2][k], f[3][k], step, at - static_cast<double>(i)).value;
    return result;
  }

  double error_at(const MapTree::Leaf& leaf, const MapPlace& place, double height, const MapSample& truth) {
    if (truth.error > lattice_share * rtol_)  // no number of cells would help
      throw NotConverged(argument("rtol") + " = " + asperity::value(rtol_) + ": " + show(2 * truth.error, 3) +
                         " was reached, twice the error of what the solver and " + std::to_string(MapPatches::most) +
                         " polynomials through its points tell");
    const auto found = value(leaf, place, height);
    double error = 0;
    for (std::size_t k = 0; k < 2; ++k) error = std::fmax(error, std::fabs(std::expm1(found[k] - truth.f[k])));
    return error + truth.error;
  }

  /// The largest error of a cell on its lattice, where that is in the box; and where a step of the modulus that the
  /// lattice passes over would show.
  double lattice_error(std::size_t node) {
    const MapTree::Leaf& leaf = tree_.nodes()[node];
    double largest = 0;
    const auto visit = [&](const MapPlace& place) {
      if (!frame_.in_box(place)) return;
      const std::vector<MapSample> truth = slices_.column(place);
      for (std::size_t t = 0; t < truth.size(); ++t)
        largest = std::fmax(largest, error_at(leaf, place, slices_.checked()[t], truth[t]));
    };
    each_lattice_place(leaf, [&](std::uint32_t, std::uint32_t, const MapPlace& place) { visit(place); });
    if (const auto x = frame_.least_smooth(tree_.x(leaf.x), tree_.x(leaf.x + leaf.wide)))
      for (std::uint32_t j = 0; j <= 4; ++j) visit({*x, tree_.z(leaf.z + leaf.high / 4 * j)});
    return largest;
  }

  /// The largest error of a cell on random points that nothing was made from: one in each of 4 x 3 parts; of a cell
  /// that the box's side cuts, where the box is.
  double unseen_error(std::size_t node) {
    const MapTree::Leaf& leaf = tree_.nodes()[node];
    const auto [wide, high] = tree_.size(leaf);
    const double x = tree_.x(leaf.x), z = tree_.z(leaf.z);
    double largest = 0;
    std::size_t taken = 0;
    for (std::size_t tried = 0; taken < unseen && tried < 50 * unseen; ++tried) {
      const auto column = static_cast<double>(tried % 4), row = static_cast<double>(taken % 3);
      const double at_x = x + (column + random_()) / 4 * wide;
      const auto [bottom, top] = frame_.z(at_x);
      const double from = std::fmax(z, bottom), to = std::fmin(z + high, top);
      if (!(from < to)) continue;
      const MapPlace place{at_x, from + (row + random_()) / 3 * (to - from)};
      const auto [lowest, highest] = frame_.heights();
      const double height = lowest == highest ? lowest : lowest + random_() * (highest - lowest);
      largest = std::fmax(largest, error_at(leaf, place, height, slices_.at(place, height)));
      ++taken;
    }
    return largest;
  }

  const MapFrame& frame_;
  double rtol_;
  MapSlices slices_;
  MapTree tree_;
  std::vector<Checked> checked_;                                       // one a node of the tree
  std::unordered_map<std::uint64_t, std::vector<MapCorner>> corners_;  // of each plane
  Random random_{20261121};
};

}  // namespace

RefinedMap refine(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress) {
  return Builder(frame, rtol, threads, progress).refine();
}

}  // namespace asperity
