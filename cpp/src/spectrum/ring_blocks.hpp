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
#include "spectrum/segments.hpp"

namespace asperity {

/// On y = ln(q / q0), with c = q^4 C as rough as it may be, G is smooth in m(y) = int_0^y c dy, since dG / dm is I2 up
/// to a factor; and u = sqrt(m) makes F(G), which goes like sqrt(G), nearly linear. A block is a stretch of y. p_j are
/// the polynomials in u that are orthonormal under dy on it, u_i and g_i the nodes and weights of their Gauss rule.
/// L_k are the polynomials through `nodes` points of the block's group. For a block from a on, row i of a matrix is
///   to_g:     u_i^2 sum_j p_j(u_i) int p_j M_k / m dy,  M_k(y) = int_a^y c L_k dy, and 1 instead of M_k in column
///             `nodes`: G at u_i, of I2 at the points and of G at a
///   to_slope: g_i sum_j p_j(u_i) int p_j L_k' dy: the weight times dR / dy at u_i, of R at the points
/// The projection is that of G / m, so that a small G is told in its own digits: the rest is orthogonal to all that is
/// smooth in u, and so is u^2 of it times F', which goes like 1 / u or less, times dR / dy. Row `end` has int c L_k
/// dy over the block and 1, and L_k at its upper end. Rows in excess tell G at a.
struct RingBlock {
  static constexpr std::size_t nodes = 16, fine = 12, coarse = 8, end = fine + coarse, rows = 24;
  RowsOf24 to_g[nodes + 1] = {}, to_slope[nodes] = {};  // by columns
  std::array<double, rows> measure{};                   // g_i
  double lower, upper;                                  // in y
  double m_lower, m_part;                               // m at the lower end, and its growth
  std::array<double, 16> foot{};  // lengths in y on which u is below 10^-0.5, 10^-1 ... of its value at the upper end
};

/// A block with the two halves that it is split into when they are first asked for.
struct RingTree {
  RingBlock block;
  mutable std::atomic<const std::array<RingTree, 2>*> halves{nullptr};
};

class RingSurface {
 public:
  /// Groups of blocks are no longer than `longest` in ln q.
  RingSurface(std::span<const Segment> surface, double longest);
  ~RingSurface();
  RingSurface(const RingSurface&) = delete;
  RingSurface(RingSurface&&) = delete;
  RingSurface& operator=(const RingSurface&) = delete;
  RingSurface& operator=(RingSurface&&) = delete;

  struct Group {
    double lower, upper;                              // in y
    std::array<double, RingBlock::nodes> wavenumber;  // at which I1 and I2 are wanted [1/m]
    RingTree root;
  };
  [[nodiscard]] std::span<const Group> groups() const { return {groups_.get(), count_}; }
  /// The halves of a part of `group`. Of threads that come at once the first leaves its own.
  [[nodiscard]] const std::array<RingTree, 2>& halves(const Group& group, const RingTree& tree) const;

 private:
  /// A part of one segment, on s = start + linear t + square t^2, t from 0 to `upper`, in which u is smooth.
  struct Piece {
    const Segment* segment;
    double start, linear, square, upper;
  };
  void make(const Group& group, double lower, double upper, double m_lower, RingBlock& block) const;
  void cut(double lower, double upper, double m_lower, std::vector<Piece>& pieces) const;
  static void cut(const Segment& segment, double begin, double end, double m, double longest,
                  std::vector<Piece>& pieces);

  std::vector<Segment> surface_;
  std::vector<double> start_, m_part_;  // of each segment: where it starts in y, and int c dy over it
  std::size_t count_;
  std::unique_ptr<Group[]> groups_;
};

}  // namespace asperity
