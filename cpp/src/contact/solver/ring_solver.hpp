// Area and hysteresis on a measured spectrum, at the cost of a smooth one.
#pragma once

#include <cstddef>
#include <vector>

#include "asperity/rubber.hpp"
#include "contact/solver/panel_solver.hpp"
#include "contact/theory/contact_integral.hpp"
#include "spectrum/ring_blocks.hpp"

namespace asperity {

/// Eq. 22 by parts on blocks of rings (spectrum/ring_blocks.hpp), with R = I1 / I2 and F of `ContactIntegral`:
///   mu_H = 4 (1 - nu^2) sigma0 sum over blocks of [R at the upper end times the rise of F
///                                                  - int (F - F at the lower end) dR].
/// I2 and R are polynomials in ln q on each cell of a grid.
class RingSolver {
 public:
  RingSolver(const RingSurface& surface, const Rubber& rubber, double poisson_ratio, double rtol);

  /// A velocity, at which any number of points follow.
  void start(double velocity);
  [[nodiscard]] double velocity() const { return velocity_; }
  /// How many times larger than allowed the errors of the polynomials are: above 1 a finer grid is wanted.
  [[nodiscard]] double excess() const { return excess_; }

  /// Whether the tolerance is reached; on a finer grid it may be where G is not or the grid is too coarse for mu_H.
  enum class Outcome { solved, no_g, too_coarse, not_converged };
  /// Solves for G, and for mu_H where `contact` is given.
  [[nodiscard]] Outcome solve(double pressure, double shift, const ContactIntegral* contact);

  [[nodiscard]] const PanelSolver::Hysteresis& hysteresis() const { return hysteresis_; }
  /// G at the upper end of the spectrum, and its relative error.
  [[nodiscard]] double g() const { return unit_g_ * scale_; }
  [[nodiscard]] double relative_error() const { return g_relative_error_; }

 private:
  /// The parts of the tolerance for the error of G and for all that is of mu_H; the rest is for the shift's. Panels
  /// leave as much to G.
  static constexpr double of_g = 0.125, of_hysteresis = 0.85;

  /// The rubber on a group at the velocity.
  struct Modulus {
    std::vector<double> i2, ratio;    // at the points of the group's cells
    std::vector<double> outside;      // part of `ratio` from frequencies outside of the measured range; empty without
    std::vector<double> ratio_error;  // of the polynomial in each cell
  };
  /// A part of a group's tree: what the velocity makes of it, and then the pressure.
  struct Part {
    const RingTree* tree;  // null for a group's until it is asked for
    std::size_t group;
    std::size_t halves = 0;             // where the first of two is, 0 if they were not asked for yet
    bool uneven = false;                // one of them has most of the growth of u
    std::size_t started = 0;            // the velocity that what follows is of
    std::size_t outside_of = 0;         // the one that the slopes of R from outside are of
    double g_lower = 0, g_upper = 0;    // at unit load
    double root[RingBlock::rows] = {};  // of G at unit load, below 0 where G is
    double slope[RingBlock::rows] = {}, slope_outside[RingBlock::rows] = {};
    double mean_slope = 0;           // of R over y, by size
    double f[RingBlock::rows] = {};  // F, less that at the lower end
    double f_lower = 0, f_upper = 0;
    double value = 0;      // R dF
    double area = 0;       // int (F - F at the lower end) dy
    double by_nodes = 0;   // how much both change, by R, where the rule has fewer nodes
    double by_halves = 0;  // and where the halves stand for the whole
    [[nodiscard]] const RingBlock& block() const { return tree->block; }
  };
  void take_modulus(const RingSurface::Group& group, Modulus& at);
  void fill(Part& part);
  void take_f(Part& part, double f_lower, std::size_t count, const ContactIntegral& contact) const;
  void evaluate(Part& part, double f_lower, const ContactIntegral& contact) const;
  void halve(std::size_t index);
  void evaluate_halves(std::size_t index, const ContactIntegral& contact);
  [[nodiscard]] double error(const Part& part) const;
  [[nodiscard]] double interpolation_error(const ContactIntegral& contact);
  [[nodiscard]] double outside();
  [[nodiscard]] double outside(Part& part) const;

  const RingSurface& surface_;
  const Rubber& rubber_;
  double stiffening_, g_factor_, rtol_;
  double velocity_ = 0, scale_ = 0, root_of_scale_ = 0, unit_g_ = 0, g_relative_error_ = 0, excess_ = 0;
  std::size_t starts_ = 0;
  PanelSolver::Hysteresis hysteresis_;
  std::vector<double> frequency_, i1_outside_;
  std::vector<Modulus> moduli_;                     // of each group
  std::vector<double> root_at_cells_, f_at_cells_;  // at the upper end of each cell: of G at unit load; of the point
  std::vector<Part> parts_;                         // the groups' roots first
  std::vector<std::size_t> whole_, next_;           // parts whose halves make up the sum
};

}  // namespace asperity
