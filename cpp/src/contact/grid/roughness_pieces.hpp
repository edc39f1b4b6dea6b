// A measured spectrum as few nodes, for integrals over int c d ln q of functions of ln q, G and the roughness beside q.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "contact/grid/roughness_cells.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// Pieces of y = ln(q / qf), qf where roughness begins, each with the Gauss rule of two nodes of dm = c dy on it, c =
/// q^4 C. Rings are taken together where m and the roughness of the window about q differ so little from what is smooth
/// that their squares do not matter: what stands at the nodes are projections on what is linear in y, so that the rest
/// is orthogonal to it.
class RoughnessPieces {
 public:
  /// For functions as smooth as a Prony series makes them, and for such as have kinks at measured rows anywhere.
  static constexpr std::size_t levels = 4, levels_with_rows = 6;
  static constexpr std::size_t least_rows = 8;  // of a table: of fewer panels are as quick
  /// What pieces have of the mean squares of what is not smooth of m and of the window, over theirs, at most.
  static constexpr double roughest(std::size_t level) {
    return 2e-6 / static_cast<double>(std::size_t{1} << (4 * level));
  }
  /// `level` from 0 on; each piece of a level is cut on the next one. Pieces end at `stops` [1/m] too. The surface must
  /// outlive it.
  RoughnessPieces(std::span<const Segment> surface, std::size_t level, std::span<const double> stops = {},
                  const TabulatedSpectrum* directions = nullptr);

  struct Nodes {
    /// [1/m], two a piece; nodes of no weight at the end of the band, one at least, make up for a multiple of four.
    std::vector<double> wavenumber;
    std::vector<double> end;     // of the pieces, their upper ends [1/m]
    std::vector<double> weight;  // int c l_k dy, l_k the straight line that is 1 at the node and 0 at the other
    std::vector<double> window;  // of RoughnessWindow
    /// With directions, a row of harmonics a node: that of the straight lines which stand for harmonics a of the table
    /// on a piece, and int a l_k (m - m_k) dm over the square of its roughness, m the roughness from the
    /// piece's lower end up to a wave, m_k its straight line at the node, l_k the line that is 1 there and 0 at the
    /// other.
    struct Harmonics {
      std::vector<double> cosine, sine;
    };
    Harmonics line, rest;
    std::vector<double> rest_size;            // of each piece
    std::vector<double> of_first, of_second;  // int c l dy from the piece's lower end up to the node, of both lines
    /// Fourth differences of a function in ln q, by its values at the node and at two to each side of it, times the
    /// weight of the nodes that they stand for.
    std::array<std::vector<double>, 5> difference;
  };
  [[nodiscard]] const Nodes& nodes() const { return nodes_; }
  /// Over the band from where roughness begins.
  [[nodiscard]] const RoughnessCells& cells() const { return cells_; }
  /// Shorter ones with fewer points, for functions with kinks.
  [[nodiscard]] const RoughnessCells& coarse_cells() const { return coarse_cells_; }
  [[nodiscard]] const RoughnessWindow& window() const { return window_; }

 private:
  /// A part of one segment, and int c dy and int c (y - lower) dy over it.
  struct Atom {
    double lower, zeroth, first;
    std::size_t points;
  };
  /// Points of a piece, atom by atom, with the same integrals from the atom's lower end up to them; m from the foot on.
  struct Points {
    std::vector<double> y, weight, m, window, zeroth, first;
    std::vector<Atom> atoms;
    double m_lower = 0, m_upper = 0;
  };
  void cut(double lower, double upper, std::size_t reached);
  [[nodiscard]] bool short_enough(double lower, double upper, std::size_t level) const;
  [[nodiscard]] bool smooth(const Points& points, std::size_t level) const;
  [[nodiscard]] Points points_of(double lower, double upper) const;
  [[nodiscard]] std::size_t segment_at(double y) const;
  [[nodiscard]] double m_at(double y) const;
  void add_piece(const Points& points, double upper);
  void take_differences();

  std::span<const Segment> surface_;
  const TabulatedSpectrum* directions_;  // for as long as the nodes are made: others share them
  RoughnessWindow window_;
  std::size_t level_;
  std::vector<double> start_, before_;  // of each segment: where it starts in y, and m there
  std::vector<double> bends_;           // where the window meets a row at which c bends sharply, in y
  Nodes nodes_;
  RoughnessCells cells_, coarse_cells_;
  double foot_ = 0;
};

/// Those of a table, made when first asked for and kept with it; each level finer than the one before.
const RoughnessPieces& roughness_pieces(const TabulatedSpectrum& table, std::size_t level);

/// Those of a law. The last law's are kept, for calls of one point each.
std::shared_ptr<const RoughnessPieces> roughness_pieces(const SelfAffineSpectrum& law, std::size_t level);

}  // namespace asperity
