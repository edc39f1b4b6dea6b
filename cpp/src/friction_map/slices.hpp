// The solver's numbers over the rectangle of a map and, with heat, over the temperatures of the background, or along
// slanted lines (slant.hpp): heights.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "friction_map/patches.hpp"
#include "friction_map/sampling.hpp"

namespace asperity {

/// Patches at Chebyshev's points of height on intervals that are halved until the polynomials over it keep a
/// twentieth of rtol; or at the one temperature of a map that has no such axis. Between the nodes, equal steps of it,
/// the map is to be the cubic through values and slopes over it: they are as many as this needs to keep a tenth of
/// rtol.
class MapSlices {
 public:
  /// The frame is the map's, at its lowest height where it has several.
  MapSlices(const MapFrame& frame, double rtol, unsigned threads, const std::function<void(double)>& progress);

  /// The nodes, heights; one that says nothing where the map has no axis.
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  /// What cells hold a polynomial of: the value at each node, followed by the slope over the height where there is an
  /// axis.
  [[nodiscard]] std::size_t planes() const { return nodes_.size() == 1 ? 1 : 2 * nodes_.size(); }
  [[nodiscard]] std::vector<MapSlopes> slopes(std::uint32_t band, const MapPlace& place);

  [[nodiscard]] MapSample at(const MapPlace& place, double height);
  /// The heights on which cells are checked: nodes, and the middles between them.
  [[nodiscard]] const std::vector<double>& checked() const { return checked_; }
  /// At all of them.
  [[nodiscard]] std::vector<MapSample> column(const MapPlace& place);

 private:
  static constexpr std::size_t n = 12;  // points an interval
  using Weights = std::array<double, n>;
  struct Interval {
    double lower, upper, error = 0;
    std::vector<std::unique_ptr<MapFrame>> frames;
    std::vector<std::unique_ptr<MapPatches>> patches;
  };
  struct Combination {  // of an interval's patches
    std::size_t interval;
    Weights value, slope;
  };

  void tell(double height);
  void add(double lower, double upper, int depth);
  [[nodiscard]] bool is_smooth(double lower, double upper) const;
  void make(Interval& interval);
  [[nodiscard]] double test(Interval& interval);
  void choose_nodes();
  [[nodiscard]] double error_between_nodes();
  void set_nodes(std::size_t steps);
  [[nodiscard]] Combination combination(double height) const;
  [[nodiscard]] MapSample combined(const Combination& sum, std::span<const MapSample> samples) const;
  [[nodiscard]] MapPlace random_place();

  const MapFrame& frame_;
  double rtol_;
  unsigned threads_;
  const std::function<void(double)>& progress_;
  std::array<double, 2> range_;
  double told_ = 0;                  // of the progress
  std::vector<Interval> intervals_;  // rising
  std::vector<double> nodes_, checked_;
  std::vector<Combination> at_nodes_, at_checked_;
  Random random_{20261123};
};

}  // namespace asperity
