// The parts of a friction map, from cells that are halved until each keeps the tolerance to the checked file, whose
// layout stands in asperity/friction_map.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "friction_map/sampling.hpp"

namespace asperity {

/// Two functions with their derivatives at a corner of a leaf. At a cut, derivatives in z differ below [0] and above
/// [1]; elsewhere the two are equal.
struct MapCorner {
  std::array<double, 2> f, x;
  std::array<std::array<double, 2>, 2> z, xz;
};

class MapTree {
 public:
  /// Places are whole numbers: x in [0, unit], z in [k unit, (k + 1) unit] for band k.
  static constexpr std::uint32_t unit = 1u << 20;

  struct Leaf {
    std::uint32_t x, z, wide, high;
    std::int32_t child = -1;  // the first of two; -1: a leaf indeed
    bool in_x = false;        // which way it was halved
    bool needed = true;
    bool changed = true;                                  // by `interpolate`, since its user said not
    std::vector<std::array<double, 32>> polynomial = {};  // of each plane, as in the file
  };

  MapTree(std::array<double, 2> x, std::vector<double> cuts, std::size_t planes);

  /// The key of a place in tables.
  static std::uint64_t key(std::uint32_t x, std::uint32_t z) { return std::uint64_t{x} << 32 | z; }
  [[nodiscard]] double x(std::uint32_t at) const { return x_[0] + at * ((x_[1] - x_[0]) / unit); }
  [[nodiscard]] double z(std::uint32_t at) const;
  /// The size of a leaf in x and in z.
  [[nodiscard]] std::array<double, 2> size(const Leaf& leaf) const;
  [[nodiscard]] bool on_cut(std::uint32_t z) const { return z % unit == 0 && z != 0 && z != bands() * unit; }
  [[nodiscard]] const std::vector<double>& cuts() const { return cuts_; }
  [[nodiscard]] std::uint32_t bands() const { return static_cast<std::uint32_t>(cuts_.size() - 1); }

  /// Nodes of the tree, leaves and halved ones; those of the bands come first.
  [[nodiscard]] std::vector<Leaf>& nodes() { return nodes_; }
  [[nodiscard]] const std::vector<Leaf>& nodes() const { return nodes_; }
  [[nodiscard]] static bool can_halve(const Leaf& leaf, bool in_x) { return (in_x ? leaf.wide : leaf.high) > 16; }
  void halve(std::size_t node, bool in_x);

  /// The leaf around a place given in halves of a step, so that a place beside a side is in one leaf only.
  [[nodiscard]] std::size_t leaf_around(std::uint32_t half_x, std::uint32_t half_z) const;

  /// Leaves in the middle of whose sides a leaf has a corner.
  [[nodiscard]] std::vector<std::size_t> holders(const Leaf& leaf) const;
  [[nodiscard]] std::size_t planes() const { return planes_; }
  /// Makes the polynomial of every needed leaf on a plane. A corner in the middle of another leaf's side has its values
  /// from that side, so that both leaves agree along it.
  void interpolate(std::size_t plane,
                   const std::function<const MapCorner&(std::uint32_t x, std::uint32_t z)>& free_corner);

  /// The two functions on a plane at a distance from a leaf's lower corner.
  static std::array<double, 2> value(const Leaf& leaf, std::size_t plane, double dx, double dz);

 private:
  struct Side {  // that a corner is in the middle of
    std::size_t leaf;
    bool along_x, leaf_above;
  };
  [[nodiscard]] std::optional<Side> side_through(std::uint32_t x, std::uint32_t z) const;

  std::array<double, 2> x_;
  std::vector<double> cuts_;
  std::size_t planes_;
  std::vector<Leaf> nodes_;
};

struct RefinedMap {
  MapTree tree;
  std::vector<double> heights;  // at which the tree has planes, of a value and a slope each; or one
  double max_error;             // twice the largest relative error on lattices and unseen points
};

/// NotConverged, with what was reached, where too many cells would be needed. `progress` hears of the share of the
/// points that are solved.
RefinedMap refine(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress);

struct SlidingTable {
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;  // row by row: ln s0 [m] and its slope over ln v at each column
  double error = 0;            // relative, of mu while the rubber heats up, on random points
};

/// At equal steps of ln v and of T0, at the middle of the box's pressures, on which s0 hardly depends. `progress` hears
/// of the share that is done.
SlidingTable sliding_table(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                           const MapHeat& heat, const MapRequest& request, unsigned threads,
                           const std::function<void(double)>& progress);

struct MapCertificate {
  double max_error = 0, largest_checked_error = 0;
  std::size_t checked = 0, exceeded = 0;
};

/// What the file of a map with heat, or of one that knows directions, has beside its cells.
struct MapHeatTables {
  std::vector<unsigned char> cold, across;  // files of the map without heat, and of forces across
  SlidingTable sliding;
};

/// `text` is for whoever reads the file.
std::vector<unsigned char> map_file(const MapFrame& frame, const RefinedMap& refined,
                                    const std::optional<Adhesion>& adhesion, const MapRequest& request,
                                    std::string_view text, const MapCertificate& certificate,
                                    const MapHeatTables& beside);

}  // namespace asperity
