// Which part each node has in area and friction, by the theory of the contact.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "contact/grid/grid.hpp"
#include "contact/theory/contact_integral.hpp"
#include "contact/theory/partial_root.hpp"
#include "contact/theory/s_factor.hpp"

namespace asperity {

/// I1 [Pa] and I2 [Pa^2] of the rubber at each node; `about` is I2 with the directions of all roughness, where those of
/// a node are its own.
struct NodeModulus {
  std::span<const double> i1, i2, about = {};
};

/// Slopes of the logarithms of I2 and of I1 / I2 along directions in which the temperature changes, a column each, and
/// that of the scale of G; and those of ln kappa, unless it goes along as the root of its rule.
struct ModulusSlopes {
  Eigen::MatrixXd i2, ratio;
  Eigen::RowVectorXd scale;
  std::optional<Eigen::RowVectorXd> log_kappa = std::nullopt;
};

/// The same of the result.
struct ContactSlopes {
  Eigen::MatrixXd part;            // of each node, not of its logarithm
  Eigen::RowVectorXd area, macro;  // dA / A0, dP_m
  Eigen::RowVectorXd rule;         // of what the rule of kappa is off, where ln kappa has slopes of its own
};

/// A number that a contact has: all parts, times a factor each, with A / A0 and P_m.
struct ContactNumber {
  Eigen::VectorXd by_part;
  double by_area = 0, by_macro = 0;
};

/// The slopes of one number over the logarithms of all that it is made of.
struct ContactGradient {
  Eigen::VectorXd i2, ratio;         // of I2 and of I1 / I2, of all nodes
  Eigen::VectorXd weight;            // of the roughness of all nodes, as far as it is in G and in the stress
  Eigen::VectorXd window;            // of the mean roughness about those of the band, with PartialContact
  double scale = 0;                  // of the scale of G
  double end_window = 0, total = 0;  // of w_e and of M
  double edges = 0;                  // of those that are crossed over those of isotropic roughness
  double macro = 0;                  // over G at q_m itself, at unit load
  Eigen::VectorXd by_part;           // of the number, with Persson's theory
  Eigen::VectorXd cold_i2;           // of I2 at T0, where PartialContact holds its excess at that of T0
};

/// mu_H is 4 (1 - nu^2) sigma0 times the sum of all parts, R dF of Eq. 22 or R times the stress of PartialContact.
class Theory {
 public:
  explicit Theory(const ContactGrid& grid)
      : grid_(grid),
        place_(Eigen::Map<const Eigen::ArrayXd>(grid.wavenumber().data(), static_cast<Eigen::Index>(grid.band_size()))
                   .log()) {}
  Theory(const Theory&) = delete;
  Theory(Theory&&) = delete;
  Theory& operator=(const Theory&) = delete;
  Theory& operator=(Theory&&) = delete;
  virtual ~Theory() = default;

  /// A new point, whose numbers shall not depend on the one before. `cold` has I2 at T0 of all nodes; it may be
  /// asked for until the next point.
  virtual void start(std::function<Eigen::VectorXd()> /*cold*/) {}
  /// The rubber at the nodes, from which G at unit load follows; any number of loads may follow.
  virtual void take(const NodeModulus& modulus);
  /// What PartialContact has of the edges of contacts then, where the grid has no nodes for them.
  virtual void take_edges(const EdgeIntegrals& /*edges*/) {}
  /// At a load, the sums alone, to `rtol` and from a kappa to start at. `scale` is 1 / (sigma0 p_T)^2.
  virtual const ContactSums& solve(double scale, double rtol, double start) = 0;
  /// At a load, with the part of each node. PartialContact takes kappa as it is given, or the root of its rule to
  /// which steps from the kappa before lead: where long waves are colder than short ones there may be several.
  virtual void evaluate(double scale, std::optional<double> log_kappa) = 0;
  /// ln kappa of the last evaluation, and by how much its rule is off; none without PartialContact.
  [[nodiscard]] virtual std::optional<double> log_kappa() const { return {}; }
  [[nodiscard]] virtual double off_rule() const { return 0; }
  /// Of the last solution: the error of friction, at most, from what the rule on the nodes misses of a front.
  [[nodiscard]] virtual double front_misfit() { return 0; }
  virtual void begin_at(double /*log_kappa*/) {}
  /// Of the last evaluation.
  virtual void differentiate(const ModulusSlopes& along, ContactSlopes& result) = 0;
  /// The same of one number, over all directions at once.
  virtual void gradient(const ContactNumber& number, ContactGradient& result) = 0;
  /// What stands where Eq. 22 has P S, at a wavenumber of the band where G at the load is `g`.
  [[nodiscard]] virtual double stress_at(double g, double wavenumber, double i2) const = 0;
  /// dmu_H / dln q over 4 (1 - nu^2) sigma0 of the edges of contacts, which PartialContact has from the end of the
  /// roughness on.
  [[nodiscard]] virtual double density_of_edges(double /*wavenumber*/, double /*i1*/, double /*i2*/) const { return 0; }

  /// Of the last evaluation or solution: the share of the directions of roughness that the stress of each of the band's
  /// nodes has, by which the force across is less; none where all.
  [[nodiscard]] virtual Eigen::VectorXd steering() const { return {}; }
  [[nodiscard]] virtual const Eigen::VectorXd& part() { return part_; }
  /// Of the last solution: the sums of `part` over cells (contact/grid/cell_sums.hpp), if they are at hand, and the
  /// mean ln q of friction in the band, on panels.
  [[nodiscard]] const Eigen::VectorXd& cell_part() const { return cell_part_; }
  [[nodiscard]] double mean_place() const { return mean_place_; }
  [[nodiscard]] virtual double area() = 0;                    // A / A0 at q1
  [[nodiscard]] double macro_area() const { return macro_; }  // P at q_m
  [[nodiscard]] double g() const { return scale_ * unit_g(); }
  [[nodiscard]] double unit_g() const { return g_edge_.empty() ? 0 : g_edge_.back(); }  // at q1 and unit load
  /// G at the load at a place, by the polynomial through I2 of its panel's nodes; at unit load where the panel begins.
  [[nodiscard]] double g_on(const ContactGrid::Place& place) const;
  [[nodiscard]] double unit_g_before(const ContactGrid::Place& place) const { return g_edge_[place.cell]; }
  /// Of the band's nodes: G at unit load, and what stands where Eq. 22 has P S.
  [[nodiscard]] const Eigen::VectorXd& node_g() const { return g_; }
  [[nodiscard]] virtual const Eigen::VectorXd& stress() { return stress_; }
  /// Of the last solution on pieces: how that of each node changes with G at unit load, over [1/Pa^2], at the obstacle
  /// that PartialContact has.
  [[nodiscard]] virtual const Eigen::VectorXd& stress_slopes() = 0;
  /// Of all nodes: I1 / I2.
  [[nodiscard]] const Eigen::VectorXd& ratio() const { return ratio_; }

 protected:
  /// Slopes of G at the load by those of ln I2 and of the scale.
  struct GSlopes {
    Eigen::MatrixXd node;  // of the band
    Eigen::MatrixXd edge;  // a row an end of a cell, the first at G = 0
    Eigen::RowVectorXd macro;
  };
  void add_up(const ModulusSlopes& along, GSlopes& slopes) const;
  /// From slopes of a number over G at the nodes and at the ends of cells to those over ln I2, which go through G.
  [[nodiscard]] Eigen::VectorXd back_through_g(const Eigen::VectorXd& by_node, const Eigen::VectorXd& by_edge) const;
  /// Adds those that go through G at q_m, from one over that at the load.
  void back_through_macro(double by_g, ContactGradient& result) const;

  const ContactGrid& grid_;
  Eigen::VectorXd place_;  // ln q of the band's nodes
  double scale_ = 0, macro_ = 1, mean_place_ = 0;
  ContactSums sums_;
  Eigen::VectorXd i2_, ratio_, part_, cell_part_, stress_, stress_slopes_;
  // at unit load: at the nodes of the band, at q_m and at the ends of cells
  Eigen::VectorXd g_;
  double g_macro_ = 0;
  std::vector<double> g_edge_;
};

class Directions;

/// Persson's P with S, or the rule of PartialContact, over directions where there are any.
std::unique_ptr<Theory> contact_theory(const ContactModel& model, const Spectrum& spectrum,
                                       std::span<const Segment> surface, const ContactGrid& grid,
                                       const Directions* directions);

/// The rule of PartialContact; `crossed` edges over those of isotropic roughness.
std::unique_ptr<Theory> partial_contact_theory(const ContactGrid& grid, double crossed);

}  // namespace asperity
