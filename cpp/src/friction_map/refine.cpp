// Refinement of a map: cells are halved until ln mu_H and ln A/A0 keep the tolerance on lattices of 5 x 5 points and on
// random points unseen before. Corner derivatives are differences over five points.
#include "friction_map/refine.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr std::size_t most_cells = 100'000;
constexpr std::size_t unseen = 12;      // points a cell
constexpr double lattice_share = 0.45;  // of rtol, allowed on lattices: between their points errors are larger

class Builder {
 public:
  Builder(const MapFrame& frame, double rtol, unsigned threads)
      : frame_(frame), rtol_(rtol), threads_(threads), tree_(frame.x(), frame.cuts()) {}

  /// Halves cells until lattices and unseen points agree; returns twice the largest error of both.
  double refine() {
    for (;;) {
      std::vector<double> on_lattices;
      do {
        on_lattices = lattice_errors();
      } while (halve_where(on_lattices, lattice_share * rtol_));
      const std::vector<double> errors = unseen_errors();
      const double largest = std::fmax(std::ranges::max(errors), std::ranges::max(on_lattices));
      if (!halve_where(errors, rtol_ / 2)) return 2 * largest;
    }
  }
  MapTree tree() && { return std::move(tree_); }

 private:
  /// Halves the leaves that are off by more than `allowed`, in the way in which their lattice bends more; whether there
  /// were any. A leaf whose corner is held by the side of a much larger one cannot be better than that side is: the
  /// larger one is halved too.
  bool halve_where(const std::vector<double>& errors, double allowed) {
    std::set<std::size_t> bad;
    std::size_t cells = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const MapTree::Leaf& leaf = tree_.nodes()[i];
      if (leaf.child >= 0 || !leaf.needed) continue;
      ++cells;
      if (errors[i] <= allowed) continue;
      bad.insert(i);
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
      for (const std::size_t half : {child, child + 1}) tree_.nodes()[half].needed = in_box(tree_.nodes()[half]);
    }
    if (stuck)
      throw NotConverged("rtol = " + show(rtol_) + ": " + show(2 * std::ranges::max(errors), 3) + " was reached with " +
                         std::to_string(cells) + " cells");
    return !bad.empty();
  }

  [[nodiscard]] std::vector<MapSample> sample(std::span<const MapPlace> places) const {
    return frame_.sample(places, threads_);
  }

  /// Whether any of it is in the box; one at its very edge is.
  [[nodiscard]] bool in_box(const MapTree::Leaf& leaf) const {
    constexpr double margin = 1e-9;
    if (frame_.log_modulus_nodes().empty()) return true;
    const double bottom = tree_.z(leaf.z), top = bottom + tree_.size(leaf)[1];
    double lowest = frame_.log_modulus_offset(tree_.x(leaf.x)), highest = lowest;
    constexpr std::uint32_t steps = 16;  // at least as many are left in a leaf
    for (std::uint32_t i = 1; i <= steps; ++i) {
      const double s = frame_.log_modulus_offset(tree_.x(leaf.x + leaf.wide / steps * i));
      lowest = std::fmin(lowest, s);
      highest = std::fmax(highest, s);
    }
    const double slack = (highest - lowest) / steps + margin;
    return top + highest >= frame_.ln_pressure(0) - slack && bottom + lowest <= frame_.ln_pressure(1) + slack;
  }

  [[nodiscard]] bool in_box(const MapPlace& place) const {
    const double y = place.z + frame_.log_modulus_offset(place.x);
    return y >= frame_.ln_pressure(0) && y <= frame_.ln_pressure(1);
  }

  template <class Visit>
  void each_lattice_place(const MapTree::Leaf& leaf, Visit visit) const {
    for (std::uint32_t i = 0; i <= 4; ++i)
      for (std::uint32_t j = 0; j <= 4; ++j) visit(i, j, leaf.x + leaf.wide / 4 * i, leaf.z + leaf.high / 4 * j);
  }

  /// Largest fourth difference of the functions on the lattice, in x and in z.
  [[nodiscard]] std::array<double, 2> bending(const MapTree::Leaf& leaf) const {
    std::array<std::array<std::array<double, 2>, 5>, 5> f;
    each_lattice_place(leaf, [&](std::uint32_t i, std::uint32_t j, std::uint32_t x, std::uint32_t z) {
      f[i][j] = lattice_.at(MapTree::key(x, z)).f;
    });
    std::array<double, 2> most{};
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const auto fourth = [&](auto at) { return std::fabs(at(0) - 4 * at(1) + 6 * at(2) - 4 * at(3) + at(4)); };
        most[0] = std::fmax(most[0], fourth([&](std::size_t n) { return f[n][i][k]; }));
        most[1] = std::fmax(most[1], fourth([&](std::size_t n) { return f[i][n][k]; }));
      }
    return most;
  }

  [[nodiscard]] double error_at(const MapTree::Leaf& leaf, const MapPlace& place, const MapSample& truth) const {
    const auto found = MapTree::value(leaf, place.x - tree_.x(leaf.x), place.z - tree_.z(leaf.z));
    double error = 0;
    for (std::size_t k = 0; k < 2; ++k) error = std::fmax(error, std::fabs(std::expm1(found[k] - truth.f[k])));
    return error + truth.error;
  }

  /// Largest error of every leaf in the box on its lattice.
  std::vector<double> lattice_errors() {
    sample_lattices();
    sample_corners();
    tree_.interpolate(
        [&](std::uint32_t x, std::uint32_t z) -> const MapCorner& { return corners_.at(MapTree::key(x, z)); });
    std::vector<double> errors(tree_.nodes().size(), 0);
    for (std::size_t n = 0; n < errors.size(); ++n) {
      const MapTree::Leaf& leaf = tree_.nodes()[n];
      if (leaf.child >= 0 || !leaf.needed) continue;
      each_lattice_place(leaf, [&](std::uint32_t, std::uint32_t, std::uint32_t x, std::uint32_t z) {
        const MapPlace place{tree_.x(x), tree_.z(z)};
        if (in_box(place)) errors[n] = std::fmax(errors[n], error_at(leaf, place, lattice_.at(MapTree::key(x, z))));
      });
    }
    return errors;
  }

  /// Largest error of every leaf on random points that nothing was made from.
  std::vector<double> unseen_errors() {
    std::vector<MapPlace> places;
    std::vector<std::size_t> owner;
    for (std::size_t n = 0; n < tree_.nodes().size(); ++n) {
      const MapTree::Leaf& leaf = tree_.nodes()[n];
      if (leaf.child >= 0 || !leaf.needed) continue;
      const auto [wide, high] = tree_.size(leaf);
      const double x = tree_.x(leaf.x), z = tree_.z(leaf.z);
      // one in each of 4 x 3 parts; of a cell that the box's side cuts, where the box is
      std::size_t taken = 0;
      for (std::size_t tried = 0; taken < unseen && tried < 50 * unseen; ++tried) {
        const auto column = static_cast<double>(tried % 4), row = static_cast<double>(taken % 3);
        const double at_x = x + (column + random_()) / 4 * wide, s = frame_.log_modulus_offset(at_x);
        const double from = std::fmax(z, frame_.ln_pressure(0) - s);
        const double to = std::fmin(z + high, frame_.ln_pressure(1) - s);
        if (!(from < to)) continue;
        places.push_back({at_x, from + (row + random_()) / 3 * (to - from)});
        owner.push_back(n);
        ++taken;
      }
    }
    const std::vector<MapSample> truth = sample(places);
    std::vector<double> errors(tree_.nodes().size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i)
      errors[owner[i]] = std::fmax(errors[owner[i]], error_at(tree_.nodes()[owner[i]], places[i], truth[i]));
    return errors;
  }

  void sample_lattices() {
    std::vector<std::uint64_t> keys;
    std::vector<MapPlace> places;
    for (const MapTree::Leaf& leaf : tree_.nodes())
      if (leaf.child < 0 && leaf.needed)
        each_lattice_place(leaf, [&](std::uint32_t, std::uint32_t, std::uint32_t x, std::uint32_t z) {
          if (!lattice_.try_emplace(MapTree::key(x, z)).second) return;
          keys.push_back(MapTree::key(x, z));
          places.push_back({tree_.x(x), tree_.z(z)});
        });
    const std::vector<MapSample> found = sample(places);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      lattice_[keys[i]] = found[i];
      if (found[i].error > lattice_share * rtol_)  // no number of cells would help
        throw NotConverged("rtol = " + show(rtol_) + ": " + show(2 * found[i].error, 3) +
                           " was reached, twice the solver's own estimate of its error");
    }
  }

  /// Values and derivatives at new corners, from 5 x 5 points around them: on a cut from either side, at the edges from
  /// within.
  void sample_corners() {
    struct Stencil {
      std::uint64_t corner;
      std::size_t kx, kz;  // which of the five is the corner
      double step_x, step_z;
      std::array<std::size_t, 2> sides;
    };
    std::vector<Stencil> stencils;
    std::vector<MapPlace> places;
    const double fine = 0.3 * std::sqrt(std::sqrt(rtol_));  // as the cells shrink with rtol
    const auto [x_lo, x_hi] = frame_.x();
    const double step_x = std::fmin(fine, (x_hi - x_lo) / 8);
    const auto add = [&](std::uint32_t x, std::uint32_t z, std::size_t kz, double step_z,
                         std::array<std::size_t, 2> sides) {
      const double at_x = tree_.x(x), at_z = tree_.z(z);
      const std::size_t kx = at_x - 2 * step_x < x_lo ? 0 : at_x + 2 * step_x > x_hi ? 4 : 2;
      stencils.push_back({MapTree::key(x, z), kx, kz, step_x, step_z, sides});
      for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j)
          places.push_back({at_x + (static_cast<double>(i) - static_cast<double>(kx)) * step_x,
                            at_z + (static_cast<double>(j) - static_cast<double>(kz)) * step_z});
    };
    const auto band_step = [&](std::uint32_t band) {
      return std::fmin(fine, (tree_.cuts()[band + 1] - tree_.cuts()[band]) / 8);
    };
    for (const auto& [x, z] : tree_.free_corners()) {
      if (!corners_.try_emplace(MapTree::key(x, z)).second) continue;
      if (tree_.on_cut(z)) {
        add(x, z, 4, band_step(z / MapTree::unit - 1), {0, 0});
        add(x, z, 0, band_step(z / MapTree::unit), {1, 1});
        continue;
      }
      const std::uint32_t band = std::min(z / MapTree::unit, tree_.bands() - 1);
      const double step = band_step(band), at = tree_.z(z);
      add(x, z, at - 2 * step < tree_.cuts()[band] ? 0 : at + 2 * step > tree_.cuts()[band + 1] ? 4 : 2, step, {0, 1});
    }
    const std::vector<MapSample> found = sample(places);
    for (std::size_t n = 0; n < stencils.size(); ++n) {
      const Stencil& s = stencils[n];
      const auto in_x = derivative_weights(s.kx), in_z = derivative_weights(s.kz);
      MapCorner& corner = corners_.at(s.corner);
      const auto f = [&](std::size_t i, std::size_t j, std::size_t k) { return found[25 * n + 5 * i + j].f[k]; };
      for (std::size_t k = 0; k < 2; ++k) {
        double x = 0, z = 0, xz = 0;
        for (std::size_t i = 0; i < 5; ++i) {
          x += in_x[i] * f(i, s.kz, k) / s.step_x;
          z += in_z[i] * f(s.kx, i, k) / s.step_z;
          for (std::size_t j = 0; j < 5; ++j) xz += in_x[i] * in_z[j] * f(i, j, k) / (s.step_x * s.step_z);
        }
        corner.f[k] = f(s.kx, s.kz, k);
        corner.x[k] = x;
        for (const std::size_t side : s.sides) {
          corner.z[side][k] = z;
          corner.xz[side][k] = xz;
        }
      }
    }
  }

  const MapFrame& frame_;
  double rtol_;
  unsigned threads_;
  MapTree tree_;
  std::unordered_map<std::uint64_t, MapSample> lattice_;
  std::unordered_map<std::uint64_t, MapCorner> corners_;
  Random random_;
};

}  // namespace

RefinedMap refine(const MapFrame& frame, double rtol, unsigned threads) {
  Builder builder(frame, rtol, threads);
  const double max_error = builder.refine();
  return {std::move(builder).tree(), max_error};
}

}  // namespace asperity
