// The nodes in ln q at which a contact is integrated, whether its rubber has one temperature or many.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "contact/grid/gauss_of_measure.hpp"
#include "contact/grid/roughness_pieces.hpp"
#include "contact/theory/partial_root.hpp"
#include "numerics/gauss_legendre.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

struct ContactGridOptions {
  double poisson_ratio = 0.5;
  std::size_t level = 0;                           // a level more is two digits more
  std::size_t halvings = 0;                        // of panels, in which rows of a measured modulus lie anywhere
  bool tabulated = false;                          // the rubber has knots: panels are shorter
  double macro_wavenumber = 0;                     // at which G is asked for [1/m]
  std::vector<double> stops = {};                  // wavenumbers at which panels shall end [1/m]
  bool kinks_at_stops = false;                     // in the modulus
  const RoughnessWindow* window = nullptr;         // with PartialContact, which must outlive the grid
  bool edge_nodes = true;                          // for the stress that it carries beyond the end of the roughness
  bool about_nodes = false;                        // where rings have directions; with those of edges
  std::optional<double> held_from = std::nullopt;  // where beyond it the modulus is not known any more [1/m]
  const RoughnessPieces* pieces = nullptr;         // instead of panels
  const TabulatedSpectrum* rings = nullptr;        // with pieces, whose harmonics the nodes of q_m have
};

/// Nodes in ln q. The cells of the band are Gauss-Legendre panels in t, the root of the distance of ln q from where G
/// begins, in which the square root that F(G) has behind the front is smooth, or pieces of rings with two nodes each.
/// Behind the nodes of the band follow those of the edges of contacts, from the end of the roughness on, and those that
/// G at q_m is taken from.
class ContactGrid {
 public:
  static constexpr int first_digits = 4;  // of level 0
  struct Cell {
    std::size_t first, count;  // of its nodes
    const LegendreRule* rule;  // none on a piece
    double origin;             // of a panel, where t is 0: ln(q / q0) = origin + t^2
    double lower, upper;       // in t
    double end;                // q at its upper end [1/m]
    const Segment* segment;
    Eigen::MatrixXd to_g;  // of a panel: from I2 at the nodes to G there at unit load, less that at the lower end
  };

  ContactGrid(std::span<const Segment> surface, const ContactGridOptions& options);

  [[nodiscard]] std::size_t size() const { return wavenumber_.size(); }
  [[nodiscard]] std::size_t band_size() const { return band_size_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }  // [1/m], of the nodes
  /// G at the nodes of the band and at the ends of cells, the first where G is 0, from I2 of the nodes, at unit load.
  void integrate(const Eigen::VectorXd& i2, Eigen::VectorXd& at_nodes, std::vector<double>& at_ends) const;
  /// The same of as many columns of I2.
  void integrate(const Eigen::MatrixXd& i2, Eigen::MatrixXd& at_nodes, Eigen::MatrixXd& at_ends) const;
  /// The transpose: from numbers that multiply G at the nodes and at the ends of cells to those that multiply I2.
  [[nodiscard]] Eigen::VectorXd integrate_back(const Eigen::VectorXd& at_nodes, const Eigen::VectorXd& at_ends) const;
  /// What the cells are made of, none with panels.
  [[nodiscard]] const RoughnessPieces* pieces() const { return options_.pieces; }
  /// dG at I2 = 1 and unit load of each node of the band, with the weights of the rule.
  [[nodiscard]] const Eigen::VectorXd& weight() const { return weight_; }
  /// G at q_m as a sum over I2 of all nodes.
  [[nodiscard]] const Eigen::VectorXd& macro_weight() const { return macro_weight_; }
  [[nodiscard]] bool has_macro() const { return options_.macro_wavenumber > 0; }
  /// On pieces the last nodes are those of that sum: their harmonics, a row a node, none without directions.
  struct Harmonics {
    std::vector<double> cosine, sine;
  };
  [[nodiscard]] const Harmonics& macro_harmonics() const { return macro_harmonics_; }
  /// Stretches of ln q up to q_m, each with a Gauss rule of its roughness: nodes beside pieces.
  struct Stretch {
    std::size_t first, count;
    double lower, upper;  // [1/m]
  };
  [[nodiscard]] const std::vector<Stretch>& macro_stretches() const { return macro_stretches_; }
  /// ln q of both ends of all nodes, those of the edges among them.
  [[nodiscard]] double lowest() const { return lowest_; }
  [[nodiscard]] double highest() const { return highest_; }
  [[nodiscard]] double foot() const { return foot_; }  // q where the roughness begins [1/m]
  /// ln q above the foot, with all digits of it on narrow bands.
  [[nodiscard]] double distance(double q) const { return std::log1p(std::fmax(q - foot_, 0) / foot_); }
  /// Where in the panels a wavenumber of the band is.
  struct Place {
    std::size_t cell;
    double wavenumber, t;
    double rate;  // dG / dln q at I2 = 1 and unit load
  };
  [[nodiscard]] Place place_of(double wavenumber) const;
  /// The nodes of a rule from the lower end of the panel up to a place in it, with dG at I2 = 1 and unit load.
  void nodes_to(const Place& place, std::vector<double>& wavenumber, std::vector<double>& weight) const;

  /// What PartialContact asks for. c is q^4 C with the factor of dG / dln q. The edges begin at q_e, where the
  /// roughness ends, inside of the band.
  struct Beyond {
    std::size_t first = 0, count = 0;  // of the edges' nodes; the one behind them is q_e itself
    /// Of the band's nodes once more, with the directions of all roughness; 0, their own, where there are none.
    std::size_t about = 0;
    Eigen::VectorXd weight;           // dln x x^-3 of them, x = q / q_e
    std::vector<double> window;       // mean of c about each node of the band
    std::optional<RoughnessEnd> end;  // with PartialContact
    std::vector<double> ends;         // of panels, from q_e on [1/m]
    std::vector<std::size_t> panel_nodes;
    const RoughnessWindow* roughness = nullptr;
    double g_factor = 0;
    [[nodiscard]] double window_at(double q) const { return g_factor * (*roughness)(q); }
  };
  [[nodiscard]] const Beyond& beyond() const { return beyond_; }
  /// The nodes of the edges anew, with panels that end where the modulus is not known any more.
  void lay_edges(const std::optional<double>& held_from);

 private:
  void add_panels(std::span<const Segment> surface);
  void add_front(const Segment& segment, double upper, double end);
  void add_after(std::span<const Segment> surface, const Segment& segment, double from, double to, double end);
  void add_panel(const Segment& segment, double origin, double from, double to, double end, std::size_t nodes);
  void add_pieces(const RoughnessPieces& pieces);
  void add_beyond();
  void add_macro_nodes(std::span<const Segment> surface);
  void add_macro_harmonics(const std::vector<double>& x, const std::vector<double>& wavenumber,
                           const std::vector<double>& weight, const NodeRule& nodes);
  /// q on a panel at t, and dG / du at I2 = 1, u from -1 to 1 over 2 `half` of t.
  struct OnPanel {
    double wavenumber, roughness;
  };
  [[nodiscard]] OnPanel on_panel(const Segment& segment, double origin, double t, double half) const;

  ContactGridOptions options_;
  double g_factor_, foot_, start_;  // where the roughness begins, and ln q there
  double lowest_, highest_;
  double end_of_band_;  // [1/m]
  std::size_t band_size_ = 0;
  std::vector<Cell> cells_;
  std::vector<double> wavenumber_;
  Eigen::VectorXd weight_, macro_weight_;
  std::vector<double> weights_, macro_weights_;
  std::vector<Stretch> macro_stretches_;
  std::vector<double> roughness_before_{0.0};  // each panel, and after all: sums of weights_
  Harmonics macro_harmonics_;
  Beyond beyond_;
};

/// From the nodes of panels, those of the edges among them, to those of other panels of the same surface.
RoughnessCells cells_between(const ContactGrid& from, const ContactGrid& to);

/// int l_j du from -1 to u, l_j the polynomial that is 1 at node j of the rule.
void integrals_to(const LegendreRule& rule, double u, double* weights);

}  // namespace asperity
