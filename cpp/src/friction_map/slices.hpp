// The solver's numbers over the rectangle of a map as polynomials of high degree, from which cells are made; and, with
// heat, over the temperatures of the background, or along slanted lines (class Slant): heights.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "friction_map/sampling.hpp"
#include "numerics/random.hpp"

namespace asperity {

/// The functions of a MapSample with their derivatives.
struct MapSlopes {
  std::array<double, 2> f, x, z, xz;
};

/// Patches of 12 x 12 points with the polynomial through them over ln v and the load ln(p p_T), p_T being that of a
/// Greenwood-Williamson correction: without it there are no kinks, and of the modulus at a single frequency none is
/// passed on. They are halved in either until they keep a twentieth of rtol,
/// by its last coefficients and at 22 random points. ln mu_H and ln A are smooth in ln p, and in ln v as smooth as the
/// rubber makes them: with a Prony series a few dozen patches stand for a box at any rtol, where the number of cells
/// grows as rtol^(-1/2).
class MapPatches {
 public:
  /// Beyond, what patches are off by is told and not mended: a map at 1e-4 takes a few hundred, at 1e-7 a few thousand,
  /// and each of them 166 points of the solver.
  static constexpr std::size_t most = 5000;
  static constexpr std::size_t n = 12;  // points of a polynomial in one variable

  /// Makes the patches that the box touches; `progress` hears of the share that is done.
  MapPatches(MapFrame frame, double rtol, unsigned threads, const std::function<void(double)>& progress);

  /// The error is twice the largest that was found on the patch, and the solver's. A patch outside of the box is made
  /// when it is asked for.
  [[nodiscard]] MapSample at(const MapPlace& place);
  /// On the side of a cut that the band is on.
  [[nodiscard]] MapSlopes slopes(std::uint32_t band, const MapPlace& place);

 private:
  using Vector = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
  struct Patch {
    MapPlace middle, half;  // half its size
    bool made = false;
    std::int32_t child = -1;  // the first of two; -1: not halved
    bool in_x = false;        // which way it was halved
    double error = 0;
    std::array<Matrix, 2> coefficient{Matrix::Zero(), Matrix::Zero()};  // of T_i(x) T_j(z), of each function
  };
  struct Strip {  // patches that all begins with, by columns; one a band of slanted coordinates, else one in all
    std::size_t first, columns, rows;
    MapPlace corner, size;  // of a patch
  };

  void make(std::vector<std::size_t> wanted, const std::function<void(double)>& progress);
  void interpolate(std::span<const std::size_t> wanted);
  [[nodiscard]] std::vector<double> test(std::span<const std::size_t> wanted);
  void halve(std::size_t index, bool in_x);
  [[nodiscard]] static std::array<double, 2> last_coefficients(const Patch& patch);
  void add_strip(std::array<double, 2> z);
  [[nodiscard]] std::vector<std::size_t> in_box() const;
  [[nodiscard]] static std::size_t first_at(const Strip& strip, const MapPlace& place);
  [[nodiscard]] const Patch& find(std::uint32_t band, const MapPlace& place);
  [[nodiscard]] static Vector vector(const std::array<double, n>& values) {
    return Eigen::Map<const Vector>(values.data());
  }
  [[nodiscard]] static std::array<double, 2> value(const Patch& patch, const MapPlace& place);

  MapFrame frame_;
  double tolerance_;
  unsigned threads_;
  std::vector<Strip> strips_;
  std::vector<Patch> patches_;
  Random random_{20261122};
};

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
  static constexpr std::size_t n = MapPatches::n;
  using Weights = std::array<double, n>;
  struct Interval {
    double lower, upper, error = 0;
    std::vector<MapPatches> patches = {};
  };
  struct Combination {  // of an interval's patches
    std::size_t interval;
    Weights value, slope;
  };

  void tell(double height);
  void add(double lower, double upper, int depth);
  [[nodiscard]] bool is_smooth(double lower, double upper) const;
  void make(Interval& interval);
  [[nodiscard]] double test(const Interval& interval);
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
