// Which part each node has in the friction, by the theory of the contact.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "asperity/contact.hpp"
#include "contact/grid/grid.hpp"
#include "contact/theory/contact_integral.hpp"
#include "contact/theory/s_factor.hpp"

namespace asperity {

/// What the nodes' temperatures make of the rubber there.
struct NodeModulus {
  Eigen::VectorXd i2, ratio;  // I2 [Pa^2], I1 / I2 [1/Pa]
};

/// Slopes of their logarithms along directions in which the temperature changes, a column each, and that of the scale
/// of G; and those of ln kappa, unless it goes along as the root of its rule.
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

/// mu_H is 4 (1 - nu^2) sigma0 times the sum of all parts, R dF of Eq. 22 or R times the stress of PartialContact.
class Theory {
 public:
  explicit Theory(const ContactGrid& grid) : grid_(grid) {}
  Theory(const Theory&) = delete;
  Theory(Theory&&) = delete;
  Theory& operator=(const Theory&) = delete;
  Theory& operator=(Theory&&) = delete;
  virtual ~Theory() = default;

  /// A new point, whose numbers shall not depend on the one before. `cold` has the rubber at T0 at all nodes; it may be
  /// asked for until the next point.
  virtual void start(std::function<NodeModulus()> /*cold*/) {}
  /// `scale` is 1 / (sigma0 p_T)^2. PartialContact takes kappa as it is given, or the root of its rule to which steps
  /// from the kappa before lead: where long waves are colder than short ones there may be several.
  virtual void evaluate(const NodeModulus& modulus, double scale, std::optional<double> log_kappa) = 0;
  /// ln kappa of the last evaluation, and by how much its rule is off; none without PartialContact.
  [[nodiscard]] virtual std::optional<double> log_kappa() const { return {}; }
  [[nodiscard]] virtual double off_rule() const { return 0; }
  virtual void begin_at(double /*log_kappa*/) {}
  /// Of the last evaluation.
  virtual void differentiate(const ModulusSlopes& along, ContactSlopes& result) = 0;
  /// dmu_H / dln q over 4 (1 - nu^2) sigma0 where G has the slope `rate` over ln q, at u in [-1, 1] of a panel.
  [[nodiscard]] virtual double density(std::size_t panel, double u, double wavenumber, double i1, double i2,
                                       double rate) const = 0;
  /// The same of the edges of contacts, which PartialContact has from the end of the roughness on.
  [[nodiscard]] virtual double density_of_edges(double /*wavenumber*/, double /*i1*/, double /*i2*/) const { return 0; }

  [[nodiscard]] const Eigen::VectorXd& part() const { return part_; }
  [[nodiscard]] double area() const { return area_; }                              // A / A0 at q1
  [[nodiscard]] double macro_area() const { return macro_; }                       // P at q_m
  [[nodiscard]] double g() const { return g_edge_.empty() ? 0 : g_edge_.back(); }  // at q1

 protected:
  /// G at the nodes, the ends of cells and q_m.
  void add_up(const NodeModulus& modulus, double scale);
  /// The same of slopes of ln I2; its own scale's are added.
  struct GSlopes {
    Eigen::MatrixXd node;  // of the band
    Eigen::MatrixXd edge;  // a row an end of a cell, the first at G = 0
    Eigen::RowVectorXd macro;
  };
  void add_up(const ModulusSlopes& along, GSlopes& slopes) const;
  /// G at u on a panel.
  [[nodiscard]] double g_on(std::size_t panel, double u) const;

  const ContactGrid& grid_;
  double scale_ = 0, area_ = 0, macro_ = 1, g_macro_ = 0;
  Eigen::VectorXd i2_, ratio_, g_, part_;
  std::vector<double> g_edge_;
};

/// Persson's P with S, or the rule of PartialContact.
std::unique_ptr<Theory> contact_theory(const ContactModel& model, const Spectrum& spectrum,
                                       std::span<const Segment> surface, const ContactGrid& grid);

/// The rule of PartialContact.
std::unique_ptr<Theory> partial_contact_theory(const ContactGrid& grid);

}  // namespace asperity
