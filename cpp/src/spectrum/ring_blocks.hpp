// A measured spectrum prepared for contact: matrices that turn a rubber's angular integrals into G and friction without
// a look at the rings. Nothing in it knows a rubber, a velocity or a pressure.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "numerics/kernels.hpp"
#include "spectrum/ring_points.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// On y = ln(q / q0), with c = q^4 C as rough as it may be, G is smooth in m(y) = int_0^y c dy, since dG / dm is I2 up
/// to a factor; and u = sqrt(m) makes F(G), which goes like sqrt(G), nearly linear. A block is a stretch of y. p_j are
/// the polynomials in u that are orthonormal under dy on it, u_i and g_i the nodes and weights of their Gauss rule.
/// I2 and R are known at `nodes` points of each cell of the block's group; L_k are the polynomials through those of a
/// cell, and nothing outside of it. For a block from a on, row i of a matrix has in column k
///   to_g:     u_i^2 sum_j p_j(u_i) int p_j M_k / m dy,  M_k(y) = int_a^y c L_k dy: G at u_i, of I2 at the points
///   to_slope: g_i sum_j p_j(u_i) int p_j dL_k, jumps at the ends of cells included: the weight times dR / dy at u_i
/// The projection is that of G / m, so that a small G is told in its own digits: the rest is orthogonal to all that is
/// smooth in u, and so is u^2 of it times F', which goes like 1 / u or less, times dR / dy. Row `end` has int c L_k
/// dy over the block, and L_k at its upper end.
struct RingBlock {
  static constexpr std::size_t nodes = 16, fine = 12, coarse = 8, end = fine + coarse, rows = 24;
  std::size_t first_cell = 0;            // of the group's
  std::vector<RowsOf24> to_g, to_slope;  // by columns
  RowsOf24 of_lower = {};                // 1 instead of M_k: what G at a adds; rows in excess tell it
  std::array<double, rows> measure{};    // g_i
  double lower = 0, upper = 0;           // in y
  double m_lower = 0, m_part = 0;        // m at the lower end, and its growth
  std::array<double, 16> foot{};  // lengths in y on which u is below 10^-0.5, 10^-1 ... of its value at the upper end
};

/// A block with the two halves that it is split into when they are first asked for.
struct RingTree {
  RingBlock block;
  const RingTree* finer = nullptr;  // that it comes from, where the grid comes from a finer one
  mutable std::atomic<const std::array<RingTree, 2>*> halves{nullptr};
};

/// Groups of blocks are no longer than `longest` in ln q, and each has as many cells.
struct RingGrid {
  double longest;
  std::size_t cells;
};

/// Segments, and of each of them where it starts in y and int c dy over it.
struct RingRows {
  std::span<const Segment> segments;
  std::vector<double> start, m_part;
  explicit RingRows(std::span<const Segment> surface);
};

struct BlockSums;

class RingSurface {
 public:
  /// The rows must outlive it, and so must the surface of a finer grid: one whose groups are as long and have twice as
  /// many cells, so that all matrices are had from its.
  RingSurface(const RingRows& rows, const RingGrid& grid, const RingSurface* finer = nullptr);
  ~RingSurface();
  RingSurface(const RingSurface&) = delete;
  RingSurface(RingSurface&&) = delete;
  RingSurface& operator=(const RingSurface&) = delete;
  RingSurface& operator=(RingSurface&&) = delete;

  /// int P_k dm and int P_k du over a cell, the latter twice; P_k Legendre's.
  struct Moments {
    std::array<double, RingBlock::nodes> of_m{}, of_u{};
  };
  /// The growth of m, and the integrals of a Legendre polynomial of high degree over m and over u in units of theirs.
  struct Cell {
    double m_part, roughness_of_m, roughness_of_u;
  };
  struct Group {
    double lower, upper;             // in y
    std::vector<double> wavenumber;  // at which I1 and I2 are wanted, those of a cell after those of another [1/m]
    std::vector<double> to_g;        // of each of them: int c L_k dy over its cell
    std::vector<Cell> cells;
    std::vector<Moments> moments;  // of each cell
    double m_lower = 0;            // m at the lower end
    mutable std::atomic<const RingTree*> root{nullptr};
    /// Where a cell begins, and the last one ends, in y.
    [[nodiscard]] double edge(std::size_t cell) const {
      return cell == cells.size()
                 ? upper
                 : lower + (upper - lower) * (static_cast<double>(cell) / static_cast<double>(cells.size()));
    }
  };
  [[nodiscard]] std::span<const Group> groups() const { return {groups_.get(), count_}; }
  /// The block that is all of a group, made of its halves, and the halves of a part of it, when first asked for. Of
  /// threads that come at once the first leaves its own.
  [[nodiscard]] const RingTree& root(const Group& group) const;
  [[nodiscard]] const std::array<RingTree, 2>& halves(const Group& group, const RingTree& tree) const;

 private:
  /// A part of one segment, on s = start + linear t + square t^2, t from 0 to `upper`, in which u is smooth.
  struct Piece {
    const Segment* segment;
    double start, linear, square, upper;
  };
  [[nodiscard]] BlockSums sums(const Group& group, double lower, double upper, double m_lower) const;
  /// Where a block is halved: in the middle, or at a row near it.
  [[nodiscard]] double middle(double lower, double upper) const;
  /// The integrals over the cells of a group, from points or from those of a finer grid.
  void take_moments(Group& group) const;
  void take_moments(const Group& finer, Group& group) const;
  /// Sets what follows from them. Returns the growth of m.
  static double measure_cells(Group& group);
  [[nodiscard]] const Group& finer(const Group& group) const;
  [[nodiscard]] std::unique_ptr<RingTree> root_of(const Group& group) const;
  [[nodiscard]] std::unique_ptr<std::array<RingTree, 2>> halves_of(const Group& group, const RingTree& tree) const;
  [[nodiscard]] std::unique_ptr<RingTree> root_of_finer(const Group& group) const;
  [[nodiscard]] std::unique_ptr<std::array<RingTree, 2>> halves_of_finer(const Group& group,
                                                                         const RingTree& tree) const;
  [[nodiscard]] FineRule points_of(const Group& group, double lower, double upper, double m_lower) const;
  void add_points(const Piece& piece, const PieceRule& rule, std::size_t first, std::size_t last, double begin,
                  double end, FineRule& fine) const;
  /// Appends the pieces from `lower` to `upper`, none longer than `longest`. Returns m at the upper end.
  double cut(double lower, double upper, double m_lower, double longest, std::vector<Piece>& pieces) const;
  static void cut(const Segment& segment, double begin, double end, double m, double longest,
                  std::vector<Piece>& pieces);

  const RingRows& rows_;
  const RingSurface* finer_;
  std::size_t count_;
  std::unique_ptr<Group[]> groups_;
};

}  // namespace asperity
