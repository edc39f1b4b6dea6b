// The rule of PartialContact (contact/theory/partial_contact_rule.hpp) where each node has a temperature of its own:
// kappa is a function of all of them by the sum rule, and so are the stresses of all waves. Slopes come from that rule
// implicitly. The stress of the edges, which begins at the end q_e of the roughness, heats and is heated too.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "contact/grid/cell_sums.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/partial_loops.hpp"
#include "contact/theory/partial_root.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

class PartialContactTheory final : public Theory {
 public:
  PartialContactTheory(const ContactGrid& grid, double crossed) : Theory(grid), crossed_(crossed) {}
  void start(std::function<VectorXd()> cold) override {
    kappa_ = usual_kappa;
    cold_ = std::move(cold);
    cold_excess_.reset();
  }
  void take(const NodeModulus& modulus) override;
  void take_edges(const EdgeIntegrals& edges) override { end_.tail = edges; }
  const ContactSums& solve(double scale, double rtol, double start) override;
  void evaluate(double scale, std::optional<double> log_kappa) override;
  [[nodiscard]] double area() override { return area_; }
  [[nodiscard]] std::optional<double> log_kappa() const override { return std::log(kappa_); }
  [[nodiscard]] double off_rule() const override { return off_rule_; }
  void begin_at(double log_kappa) override { kappa_ = std::exp(log_kappa); }
  void differentiate(const ModulusSlopes& along, ContactSlopes& result) override;
  void gradient(const ContactNumber& number, ContactGradient& result) override;
  [[nodiscard]] const VectorXd& stress_slopes() override;
  [[nodiscard]] VectorXd steering() const override;
  [[nodiscard]] double stress_at(double g, double wavenumber, double i2) const override;
  [[nodiscard]] double density_of_edges(double wavenumber, double i1, double i2) const override;

 private:
  [[nodiscard]] partial_contact::AtEnd rule(double log_g, double excess) const {
    return {std::exp(log_g) * kappa_ * g(), kappa_, {grid_.beyond().end->factor, excess, crossed_}};
  }
  /// Of logarithms at a fixed kappa, over ln G1 and over the excess.
  struct RuleSlopes {
    partial_contact::AtEnd at;
    double obstacle_by_g, edges_by_g, spread_by_g, spread_by_excess, edges_by_excess;
  };
  [[nodiscard]] RuleSlopes rule_slopes() const;
  [[nodiscard]] Index end_node() const { return static_cast<Index>(grid_.beyond().first + grid_.beyond().count); }
  /// 1 - 1 / rho, which raises T where stiff waves beyond q_e have most of G. With heat long waves are colder and may
  /// have it, too: then it is not below that at T0, by which the limit of no heat is the contact without heat.
  [[nodiscard]] double excess() {
    const RoughnessEnd& end = *grid_.beyond().end;
    const double hot = end.band(unit_g(), end_.tail.i2_at_end).excess;
    held_ = false;
    if (!cold_ || partial_contact::last * (1 - hot) <= 1) return hot;
    if (!cold_excess_) {
      cold_i2_ = cold_();
      const double g = grid_.weight().dot(cold_i2_.head(grid_.weight().size()));
      cold_excess_ = end.band(g, cold_i2_[end_node()]).excess;
    }
    held_ = *cold_excess_ > hot;
    return std::clamp(*cold_excess_, hot, 0.0);
  }

  std::function<VectorXd()> cold_;
  VectorXd cold_i2_;
  std::optional<double> cold_excess_;
  double crossed_;     // edges over those of isotropic roughness
  bool held_ = false;  // excess_ is that at T0, or 0
  double kappa_ = usual_kappa, area_ = 1, excess_ = 0, edges_ = 0, obstacle_ = 0, off_rule_ = 0;
  PartialEnd end_;
  VectorXd weight_, steepness_;          // dG and g' of the band's nodes, at unit load
  VectorXd log_slope_;                   // of R of the band's nodes over ln G, the obstacle Z / A^2 alone
  VectorXd share_, of_waves_, in_tail_;  // A and Z of the band's nodes; int dln x of T / g'(q_e) of the edges'
};

double share_of(double g) { return g > 0 ? std::erf(0.5 / std::sqrt(g)) : 1; }

/// d ln A / d ln G
double share_slope(double g, double share) {
  if (!(g > 0)) return 0;
  const double s = 0.5 / std::sqrt(g);
  return -s * std::exp(-s * s) * std::numbers::inv_sqrtpi / share;
}

void PartialContactTheory::take(const NodeModulus& modulus) {
  Theory::take(modulus);
  const ContactGrid::Beyond& beyond = grid_.beyond();
  const Index n = g_.size(), first = static_cast<Index>(beyond.first), count = static_cast<Index>(beyond.count);
  if (!grid_.pieces()) g_ = g_.cwiseMax(1e-300);
  weight_ = grid_.weight().cwiseProduct(i2_.head(n));
  const double* const about = modulus.about.empty() ? i2_.data() + beyond.about : modulus.about.data();
  steepness_ = Eigen::Map<const VectorXd>(beyond.window.data(), n).cwiseProduct(Eigen::Map<const VectorXd>(about, n));
  stress_.resize(n);
  share_.resize(n);
  log_slope_.resize(n);
  end_.g = unit_g();
  end_.window = beyond.end->window;
  if (count == 0) return;
  end_.tail = {};
  end_.tail.i2_at_end = i2_[static_cast<Index>(beyond.first + beyond.count)];
  static_assert(partial_contact::tail_excess == 0.25);
  in_tail_ = beyond.weight.cwiseProduct(i2_.segment(first, count))
                 .cwiseProduct((i2_.segment(first, count) / end_.tail.i2_at_end).cwiseSqrt().cwiseSqrt());
  end_.tail.i2 = in_tail_.sum();
  end_.tail.i1 = in_tail_.dot(ratio_.segment(first, count));
}

const ContactSums& PartialContactTheory::solve(double scale, double rtol, double start) {
  scale_ = scale;
  end_.band = {grid_.beyond().end->factor, excess_ = excess(), crossed_};
  const PartialNodes nodes{g_.data(), steepness_.data(), weight_.data(), ratio_.data(),
                           static_cast<std::size_t>(g_.size())};
  sums_ = partial_root(nodes, end_, scale, rtol, start, {share_.data(), stress_.data(), log_slope_.data()});
  kappa_ = sums_.kappa;
  edges_ = sums_.edges;
  obstacle_ = sums_.obstacle;
  if (grid_.pieces()) return sums_;
  const Index n = g_.size(), count = in_tail_.size();
  part_.setZero(i2_.size());
  part_.head(n) = scale * weight_.cwiseProduct(ratio_.head(n)).cwiseProduct(stress_);
  part_.segment(n, count) = scale * edges_ * end_.window * in_tail_.cwiseProduct(ratio_.segment(n, count));
  sum_cells(grid_, part_, cell_part_);
  const double band = part_.head(n).sum();
  mean_place_ = band > 0 ? part_.head(n).dot(place_) / band : 0;
  return sums_;
}

void PartialContactTheory::evaluate(double scale, std::optional<double> log_kappa) {
  const ContactGrid::Beyond& beyond = grid_.beyond();
  const Index n = g_.size(), first = static_cast<Index>(beyond.first), count = static_cast<Index>(beyond.count);
  scale_ = scale;
  part_.setZero(i2_.size());
  if (unit_g() == 0) {
    area_ = macro_ = 1;
    off_rule_ = 0;
    return;
  }
  constexpr double to_rounding = 1e-15;
  if (log_kappa) {
    kappa_ = std::exp(*log_kappa);
    excess_ = excess();
  } else {
    (void)solve(scale, to_rounding, kappa_);
  }

  const partial_contact::AtEnd at = rule(0, excess_);
  edges_ = at.edges.value;
  obstacle_ = at.obstacle.value;
  share_.resize(n);
  of_waves_.resize(n);
  double variance = edges_ * end_.window * end_.tail.i2;
  for (Index j = 0; j < n; ++j) {
    const double a = share_[j] = share_of(kappa_ * scale * g_[j]);
    of_waves_[j] = obstacle_ * scale * steepness_[j] * a * a;
    const double stressed = weight_[j] * partial_contact::stress(a, of_waves_[j]);
    part_[j] = scale * stressed * ratio_[j];
    variance += stressed;
  }
  off_rule_ = std::log(at.integral * at.spread.value / (scale * variance));
  part_.segment(first, count) = scale * edges_ * end_.window * in_tail_.cwiseProduct(ratio_.segment(first, count));
  area_ = at.share;
  macro_ = share_of(kappa_ * scale * g_macro_);
}

/// By differences over ln G1 and the excess.
PartialContactTheory::RuleSlopes PartialContactTheory::rule_slopes() const {
  constexpr double step = 1e-4;
  const partial_contact::AtEnd more = rule(step, excess_), less = rule(-step, excess_);
  const auto slope = [](const partial_contact::Factor& upper, const partial_contact::Factor& lower) {
    return upper.value > 0 && lower.value > 0 ? std::log(upper.value / lower.value) / (2 * step) : 0;
  };
  const bool raised = partial_contact::last * (1 - excess_) > 1;
  return {rule(0, excess_),
          slope(more.obstacle, less.obstacle),
          slope(more.edges, less.edges),
          slope(more.spread, less.spread),
          slope(rule(0, excess_ + step).spread, rule(0, excess_ - step).spread),
          raised ? 1 / (excess_ - 1) : 0};
}

void PartialContactTheory::differentiate(const ModulusSlopes& along, ContactSlopes& result) {
  const ContactGrid::Beyond& beyond = grid_.beyond();
  const Index n = g_.size(), first = static_cast<Index>(beyond.first), count = static_cast<Index>(beyond.count);
  const Index directions = along.i2.cols(), about = static_cast<Index>(beyond.about);
  result.part.setZero(part_.size(), directions);
  result.area = result.macro = RowVectorXd::Zero(directions);
  result.rule = along.log_kappa.value_or(result.area);
  if (unit_g() == 0) return;
  GSlopes slopes;
  add_up(along, slopes);
  const double g1 = kappa_ * g();
  const RowVectorXd log_g1 = slopes.edge.bottomRows(1) / g(), at_end = along.i2.row(end_node());
  const RowVectorXd excess = (held_ ? 0 : excess_ - 1) * (log_g1 - along.scale - at_end);

  const RuleSlopes of = rule_slopes();
  const partial_contact::AtEnd& at = of.at;
  const RowVectorXd log_edges = of.edges_by_g * log_g1 + of.edges_by_excess * excess;

  // d ln R of each node: along the directions at a fixed kappa, and over ln kappa
  MatrixXd log_stress(n, directions);
  VectorXd by_kappa(n);
  RowVectorXd variance = RowVectorXd::Zero(directions);
  double sum = 0, variance_by_kappa = 0;
  for (Index j = 0; j < n; ++j) {
    const double g = scale_ * g_[j], slope = share_slope(kappa_ * g, share_[j]), z = of_waves_[j],
                 passed = 2 * z / (1 + z);
    by_kappa[j] = slope - passed * (at.obstacle.log_slope + 2 * slope);
    if (g > 0)
      log_stress.row(j) = (slope * (1 - 2 * passed) / g) * slopes.node.row(j);
    else
      log_stress.row(j).setZero();
    log_stress.row(j) -= passed * (of.obstacle_by_g * log_g1 + along.i2.row(about + j) + along.scale);
    const double part = ratio_[j] > 0 ? part_[j] / ratio_[j] : 0;  // R dG
    variance += part * (along.i2.row(j) + along.scale + log_stress.row(j));
    variance_by_kappa += part * by_kappa[j];
    sum += part;
  }
  constexpr double tail = partial_contact::tail_excess;
  const double per_tail = scale_ * edges_ * beyond.end->window;
  for (Index t = 0; t < count; ++t) {
    const double part = per_tail * in_tail_[t];
    variance += part * (log_edges + along.scale + (1 + tail) * along.i2.row(first + t) - tail * at_end);
    variance_by_kappa += part * at.edges.log_slope;
    sum += part;
  }
  // ln(F spread) - ln variance stays 0
  const double integral_by_g = g1 * at.share / at.integral;
  const RowVectorXd residual =
      (integral_by_g + of.spread_by_g) * log_g1 + of.spread_by_excess * excess - variance / sum;
  const double residual_by_kappa = integral_by_g + at.spread.log_slope - variance_by_kappa / sum;
  const RowVectorXd log_kappa = along.log_kappa.value_or(residual / -residual_by_kappa);
  result.rule = residual + residual_by_kappa * log_kappa;

  for (Index j = 0; j < n; ++j)
    result.part.row(j) =
        part_[j] * (along.ratio.row(j) + along.i2.row(j) + along.scale + log_stress.row(j) + by_kappa[j] * log_kappa);
  for (Index t = first; t < first + count; ++t)
    result.part.row(t) = part_[t] * (along.ratio.row(t) + (1 + tail) * along.i2.row(t) - tail * at_end + along.scale +
                                     log_edges + at.edges.log_slope * log_kappa);
  result.area = at.share_slope * (log_g1 + log_kappa);
  if (const double g = scale_ * g_macro_; g > 0)
    result.macro = macro_ * share_slope(kappa_ * g, macro_) * (slopes.macro / g + log_kappa);
}

/// The number and `tied` times the rule, ln(F spread) - ln variance, which stays 0: `tied` is such that both together
/// do not change with ln kappa.
void PartialContactTheory::gradient(const ContactNumber& number, ContactGradient& result) {
  const ContactGrid::Beyond& beyond = grid_.beyond();
  const Index n = g_.size(), first = static_cast<Index>(beyond.first), count = static_cast<Index>(beyond.count);
  result = {};
  result.i2.setZero(i2_.size());
  const VectorXd by_part = result.ratio = number.by_part.cwiseProduct(part_);
  result.weight.setZero(i2_.size());
  result.window.setZero(n);
  if (unit_g() == 0) return;
  const RuleSlopes of = rule_slopes();
  const partial_contact::AtEnd& at = of.at;
  VectorXd slope(n), passed(n), stressed(n);
  double variance = 0, variance_by_kappa = 0, number_by_kappa = number.by_area * at.share_slope;
  for (Index j = 0; j < n; ++j) {
    const double z = of_waves_[j], a = slope[j] = share_slope(kappa_ * scale_ * g_[j], share_[j]);
    passed[j] = 2 * z / (1 + z);
    stressed[j] = scale_ * weight_[j] * partial_contact::stress(share_[j], z);
    const double by_kappa = a - passed[j] * (at.obstacle.log_slope + 2 * a);
    variance += stressed[j];
    variance_by_kappa += stressed[j] * by_kappa;
    number_by_kappa += by_part[j] * by_kappa;
  }
  const VectorXd in_tail = scale_ * edges_ * beyond.end->window * in_tail_.head(count);
  variance += in_tail.sum();
  variance_by_kappa += in_tail.sum() * at.edges.log_slope;
  number_by_kappa += by_part.segment(first, count).sum() * at.edges.log_slope;
  const double g_macro = scale_ * g_macro_,
               by_macro = number.by_macro * macro_ * share_slope(kappa_ * g_macro, macro_);  // over ln(kappa G)
  number_by_kappa += by_macro;
  const double integral_by_g = kappa_ * g() * at.share / at.integral;
  const double tied = -number_by_kappa / (integral_by_g + at.spread.log_slope - variance_by_kappa / variance);

  // over ln(R dG) of the nodes and ln(T d ln x), and from there over each factor in them
  const VectorXd by_stress = by_part.head(n) - tied / variance * stressed;
  const VectorXd by_tail = by_part.segment(first, count) - tied / variance * in_tail;
  result.window = -passed.cwiseProduct(by_stress);
  const double by_obstacle = result.window.sum(), by_edges = by_tail.sum();
  const double by_excess = tied * of.spread_by_excess + by_edges * of.edges_by_excess;
  const bool cold = held_ && cold_excess_ && excess_ == *cold_excess_;
  const double over_excess = by_excess * (excess_ - 1);  // of 1 - 1 / rho over ln G1, -ln M and -ln I2(v q_e)
  const double off = held_ ? 0 : over_excess;
  const double by_g1 = tied * (integral_by_g + of.spread_by_g) + by_edges * of.edges_by_g +
                       by_obstacle * of.obstacle_by_g + number.by_area * at.share_slope + off;
  VectorXd by_node(n), by_edge = VectorXd::Zero(static_cast<Index>(g_edge_.size()));
  for (Index j = 0; j < n; ++j) {
    const double g = scale_ * g_[j];
    by_node[j] = g > 1e-250 ? by_stress[j] * slope[j] * (1 - 2 * passed[j]) / g : 0;
  }
  by_edge[by_edge.size() - 1] = by_g1 / g();
  const VectorXd through_g = back_through_g(by_node, by_edge);
  constexpr double tail = partial_contact::tail_excess;
  result.weight.head(n) = by_stress + through_g;
  result.i2.head(n) = result.weight.head(n);
  result.i2.segment(static_cast<Index>(beyond.about), n) += result.window;
  result.i2.segment(first, count) = (1 + tail) * by_tail;
  result.i2[end_node()] -= tail * by_edges + off;
  result.scale = by_part.sum() - tied + by_obstacle - off + through_g.sum();
  constexpr double end_power = 0.2;  // of 4 w_e / M in Z
  result.end_window = by_edges + end_power * by_obstacle;
  result.edges = by_edges;
  result.total = -end_power * by_obstacle - off;
  if (cold) {
    const VectorXd& weight = grid_.weight();
    result.cold_i2.setZero(i2_.size());
    result.cold_i2.head(n) = over_excess / weight.dot(cold_i2_.head(n)) * weight.cwiseProduct(cold_i2_.head(n));
    result.weight.head(n) += result.cold_i2.head(n);
    result.cold_i2[end_node()] -= over_excess;
    result.total -= over_excess;
  }
  back_through_macro(g_macro > 0 ? by_macro / g_macro : 0, result);
}

const VectorXd& PartialContactTheory::stress_slopes() {
  stress_slopes_ = log_slope_.cwiseQuotient(g_);
  return stress_slopes_;
}

VectorXd PartialContactTheory::steering() const {
  static_assert(partial_contact::steering == 0.125);
  VectorXd result(share_.size());
  eighth_roots(share_.data(), static_cast<std::size_t>(share_.size()), result.data());
  return result;
}

double PartialContactTheory::stress_at(double g, double wavenumber, double i2) const {
  if (unit_g() == 0) return 1;
  const double a = share_of(kappa_ * g);
  return partial_contact::stress(a, obstacle_ * scale_ * grid_.beyond().window_at(wavenumber) * i2 * a * a);
}

double PartialContactTheory::density_of_edges(double wavenumber, double i1, double i2) const {
  const RoughnessEnd& end = *grid_.beyond().end;
  const double x = wavenumber / end.wavenumber;
  if (unit_g() == 0 || !(x >= 1 && x <= partial_contact::tail_end)) return 0;
  return scale_ * edges_ * end.window * i1 * std::pow(i2 / end_.tail.i2_at_end, partial_contact::tail_excess) *
         std::pow(x, -partial_contact::tail_power);
}

}  // namespace

std::unique_ptr<Theory> partial_contact_theory(const ContactGrid& grid, double crossed) {
  return std::make_unique<PartialContactTheory>(grid, crossed);
}

}  // namespace asperity
