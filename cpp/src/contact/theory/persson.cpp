// F(G) = int_0^G P S dG of Eq. 22 with G of Eq. 7. By parts on each panel dF is a measure of the nodes, so that the
// front of F is met exactly; on pieces of rings, whose two nodes have what F rises and int G dF = [G F] - int F dG.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contact/grid/directions.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "contact/theory/partial_loops.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

/// Weight times derivative at each node, a column for the value at each.
auto slopes_of(const LegendreRule& rule) {
  const auto n = static_cast<Index>(rule.n);
  return Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>(&rule.slope[0][0], n, n,
                                                             Eigen::OuterStride<>(LegendreRule::most));
}

constexpr double begins = 0.02, ends = 10;  // of G: P changes between

double p_of(double g, Form form) { return g <= 0 ? 1 : contact_share(g, form); }

class PerssonTheory final : public Theory {
 public:
  PerssonTheory(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface,
                const ContactGrid& grid)
      : Theory(grid),
        form_(model.form),
        factor_(s_in_integrand(model.correction)),
        contact_(model.form, factor_),
        area_g_(model, spectrum, surface, surface.back().b) {}

  void take(const NodeModulus& modulus) override;
  const ContactSums& solve(double scale, double rtol, double start) override;
  void evaluate(double scale, std::optional<double> log_kappa) override;
  [[nodiscard]] const VectorXd& part() override;
  [[nodiscard]] double area() override { return p_of(area_g_(g()), form_); }
  void differentiate(const ModulusSlopes& along, ContactSlopes& result) override;
  void gradient(const ContactNumber& number, ContactGradient& result) override;
  [[nodiscard]] double front_misfit() override;
  [[nodiscard]] const VectorXd& stress() override;  // on pieces their means
  [[nodiscard]] const VectorXd& stress_slopes() override;
  [[nodiscard]] double stress_at(double g, double /*wavenumber*/, double /*i2*/) const override { return p_s(g); }

 private:
  [[nodiscard]] double p_s(double g) const {
    const double p = p_of(g, form_);
    return factor_ ? p * (*factor_)(p) : p;
  }
  void integral_of(const double* g, Index n, double* f) const;
  void integrate_to(double scale);
  void take_stress();
  void take_columns();
  [[nodiscard]] double rise_of(std::size_t cell) const { return f_edge_[cell + 1] - f_edge_[cell]; }
  void make_stress(Eigen::Ref<VectorXd> g) const;

  std::size_t pieces_ = grid_.pieces() ? grid_.cells().size() : 0;
  Form form_;
  std::optional<SFunction> factor_;
  ContactIntegral contact_;
  AreaG area_g_;
  /// dF of the upper node of a piece is rise (F2 - F1) - first (F at the lower node - F1) - second (at the upper one).
  struct Upper {
    double rise, first, second;
  };
  [[nodiscard]] Upper by_upper(std::size_t piece) const;
  std::vector<double> edge_, f_edge_;    // G and F at the ends of cells, at the load
  VectorXd g_at_load_, f_;               // at the nodes, F less that where their cell begins
  MatrixXd columns_, end_columns_;       // of panels: friction, and that times ln q, by F of nodes and by its rise
  VectorXd moment_, measure_;            // R ln q, and dF
  bool columns_are_of_modulus_ = false;  // and of the load:
  bool part_is_of_load_ = false, stress_is_of_load_ = false;
};

/// F at values of G; their number is a multiple of `lanes`.
void PerssonTheory::integral_of(const double* g, Index n, double* f) const {
  kernels().contact_integral(contact_.table, g, static_cast<std::size_t>(n), f);
  for (Index i = 0; i < n; ++i)
    if (g[i] < contact_.whole) f[i] = g[i];
}

/// From values of G to P S, in their place.
void PerssonTheory::make_stress(Eigen::Ref<VectorXd> g) const {
  g = g.cwiseMax(0);  // an interpolated G may be below 0 at the first nodes
  if (form_ == Form::exact)
    contact_shares(g.data(), static_cast<std::size_t>(g.size()), g.data());
  else
    for (double& one : g) one = p_of(one, form_);
  const double gamma = contact_.gamma;
  if (factor_) g.array() *= gamma + (1 - gamma) * (g.array() * g.array());
}

void PerssonTheory::take(const NodeModulus& modulus) {
  Theory::take(modulus);
  columns_are_of_modulus_ = false;
}

PerssonTheory::Upper PerssonTheory::by_upper(std::size_t piece) const {
  const auto i = static_cast<Index>(2 * piece);
  const double apart = g_[i + 1] - g_[i], by = apart > 0 ? 1 / apart : 0;
  return {(g_edge_[piece + 1] - g_[i]) * by, grid_.weight()[i] * i2_[i] * by, grid_.weight()[i + 1] * i2_[i + 1] * by};
}

const VectorXd& PerssonTheory::stress() {
  if (stress_is_of_load_) return stress_;
  stress_is_of_load_ = true;
  if (!grid_.pieces()) {
    take_stress();
    return stress_;
  }
  stress_.resize(g_.size());
  for (std::size_t c = 0; c < pieces_; ++c) {
    const double apart = edge_[c + 1] - edge_[c];
    stress_.segment<2>(static_cast<Index>(2 * c)).setConstant(apart > 0 ? (f_edge_[c + 1] - f_edge_[c]) / apart : 0);
  }
  return stress_;
}

/// At the nodes.
void PerssonTheory::take_stress() {
  stress_ = g_at_load_;
  make_stress(stress_);
}

/// G and F at the nodes and at the ends of cells at a load.
void PerssonTheory::integrate_to(double scale) {
  scale_ = scale;
  part_is_of_load_ = stress_is_of_load_ = false;
  edge_.resize((g_edge_.size() + lanes - 1) / lanes * lanes, 1.0);
  for (std::size_t i = 0; i < g_edge_.size(); ++i) edge_[i] = scale * g_edge_[i];
  f_edge_.resize(edge_.size());
  integral_of(edge_.data(), std::ssize(edge_), f_edge_.data());
  g_at_load_ = scale * g_;
  f_.resize(g_.size());
  integral_of(g_at_load_.data(), f_.size(), f_.data());
  const auto& cells = grid_.cells();
  measure_.resize(f_.size());
  for (std::size_t c = 0; c < pieces_; ++c) {
    double* const f = &f_[static_cast<Index>(2 * c)];
    f[0] -= f_edge_[c];
    f[1] -= f_edge_[c];
    const Upper by = by_upper(c);
    const double upper = by.rise * rise_of(c) - by.first * f[0] - by.second * f[1];
    measure_.segment<2>(static_cast<Index>(2 * c)) << rise_of(c) - upper, upper;
  }
  for (std::size_t c = pieces_; c < cells.size(); ++c)
    f_.segment(static_cast<Index>(cells[c].first), static_cast<Index>(cells[c].count)).array() -= f_edge_[c];
}

const VectorXd& PerssonTheory::part() {
  if (part_is_of_load_) return part_;
  part_is_of_load_ = true;
  const auto& cells = grid_.cells();
  for (std::size_t c = pieces_; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    auto measure = measure_.segment(first, count);
    measure = -slopes_of(*cells[c].rule).transpose().lazyProduct(f_.segment(first, count));
    measure += rise_of(c) * Eigen::Map<const VectorXd>(cells[c].rule->at_upper, count);
  }
  part_.resize(i2_.size());
  part_.tail(i2_.size() - f_.size()).setZero();
  part_.head(f_.size()) = ratio_.head(f_.size()).cwiseProduct(measure_);
  return part_;
}

void PerssonTheory::evaluate(double scale, std::optional<double> /*log_kappa*/) {
  integrate_to(scale);
  (void)part();
  macro_ = p_of(scale * g_macro_, form_);
}

/// Any number of loads may follow, to which friction is linear in F.
void PerssonTheory::take_columns() {
  columns_are_of_modulus_ = true;
  const auto& cells = grid_.cells();
  const Index n = g_.size();
  moment_ = ratio_.head(n).cwiseProduct(place_);
  columns_.resize(n, 2);
  end_columns_.resize(std::ssize(cells), 2);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const LegendreRule& rule = *cells[c].rule;
    for (Index i = 0; i < count; i += lanes) {
      using Some = Eigen::Array<double, lanes, 1>;
      Some of_friction = Some::Zero(), of_place = Some::Zero();
      for (Index j = 0; j < count; ++j) {
        const Some slope = Eigen::Map<const Some>(&rule.slope[j][i]);
        of_friction += ratio_[first + j] * slope;
        of_place += moment_[first + j] * slope;
      }
      columns_.col(0).segment<lanes>(first + i) = of_friction;
      columns_.col(1).segment<lanes>(first + i) = of_place;
    }
    const Eigen::Map<const VectorXd> at_upper(rule.at_upper, count);
    end_columns_.row(static_cast<Index>(c)) << at_upper.dot(ratio_.segment(first, count)),
        at_upper.dot(moment_.segment(first, count));
  }
}

const ContactSums& PerssonTheory::solve(double scale, double /*rtol*/, double /*start*/) {
  integrate_to(scale);
  const auto& cells = grid_.cells();
  cell_part_.resize(std::ssize(cells));
  for (std::size_t c = 0; c < pieces_; ++c) {
    const auto i = static_cast<Index>(2 * c);
    cell_part_[static_cast<Index>(c)] = ratio_[i] * measure_[i] + ratio_[i + 1] * measure_[i + 1];
  }
  if (!grid_.pieces()) {
    if (!columns_are_of_modulus_) take_columns();
    double by_place = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count),
                 at = static_cast<Index>(c);
      const auto f = f_.segment(first, count);
      cell_part_[at] = rise_of(c) * end_columns_(at, 0) - columns_.col(0).segment(first, count).dot(f);
      by_place += rise_of(c) * end_columns_(at, 1) - columns_.col(1).segment(first, count).dot(f);
    }
    const double whole = cell_part_.sum();
    mean_place_ = whole > 0 ? by_place / whole : 0;
  }
  sums_.slope = 1;
  sums_.variance = g_edge_.back();
  sums_.friction = cell_part_.sum() / scale;
  return sums_;
}

/// From the mean stress before, between and behind the nodes of a piece, whose middles lie as those of Gauss' rule.
const VectorXd& PerssonTheory::stress_slopes() {
  constexpr double node = std::numbers::inv_sqrt3, beyond = (3 * node - 1) / (2 * (1 + node));
  stress_slopes_.setZero(f_.size());
  for (std::size_t c = 0; c < pieces_; ++c) {
    if (edge_[c + 1] < begins) continue;
    const auto i = static_cast<Index>(2 * c);
    const double *const g = g_at_load_.data() + i, *const f = f_.data() + i;
    const double before = g[0] - edge_[c], between = g[1] - g[0], behind = edge_[c + 1] - g[1],
                 lower = before * between * (before + between), upper = between * behind * (between + behind);
    if (!(lower > 0 && upper > 0)) continue;
    const double rise = f[1] - f[0], first = 2 * scale_ * (rise * before - f[0] * between) / lower,
                 second = 2 * scale_ * ((rise_of(c) - f[1]) * between - rise * behind) / upper;
    stress_slopes_[i] = first + beyond * (first - second);
    stress_slopes_[i + 1] = second + beyond * (second - first);
  }
  return stress_slopes_;
}

/// What a panel's rule on P S dG is off the rise of F, times half of what R changes between two nodes there: by parts,
/// friction has F at all ends, and what the rule misses of a front is no farther from a node.
double PerssonTheory::front_misfit() {
  if (grid_.pieces()) return 0;
  double result = 0;
  for (std::size_t c = 0; c < grid_.cells().size(); ++c) {
    if (!(edge_[c] < ends && edge_[c + 1] > begins)) continue;
    const auto first = static_cast<Index>(grid_.cells()[c].first), count = static_cast<Index>(grid_.cells()[c].count);
    const auto g = g_at_load_.segment(first, count), ratio = ratio_.segment(first, count);
    int gaps = 0;
    double apart = 0;
    for (Index i = 1; i < count; ++i) {
      const double next = i + 1 < count ? g[i + 1] : edge_[c + 1];
      if (!(g[i - 1] < ends && next > begins)) continue;
      ++gaps;
      apart = std::fmax(apart, std::fabs(ratio[i] - ratio[i - 1]));
    }
    if (gaps < 2) apart = ratio.maxCoeff() - ratio.minCoeff();
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, LegendreRule::most> stress = g;
    make_stress(stress);
    const double rule =
        (grid_.weight().segment(first, count).array() * i2_.segment(first, count).array() * stress.array()).sum();
    result += std::fabs(rise_of(c) / scale_ - rule) * apart / 2;
  }
  return result;
}

void PerssonTheory::differentiate(const ModulusSlopes& along, ContactSlopes& result) {
  GSlopes slopes;
  add_up(along, slopes);
  const auto& cells = grid_.cells();
  const Index n = g_.size();
  result.part.setZero(part_.size(), along.i2.cols());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const auto edge = static_cast<Index>(c);
    auto part = result.part.middleRows(first, count);
    if (cells[c].rule) {  // d(measure) by dF = P S dG
      const LegendreRule& rule = *cells[c].rule;
      const Eigen::Map<const VectorXd> at_lower(rule.at_lower, count), at_upper(rule.at_upper, count);
      VectorXd share(count);
      for (Index i = 0; i < count; ++i) share[i] = p_s(g_at_load_[first + i]);
      const MatrixXd df = share.asDiagonal() * slopes.node.middleRows(first, count);
      part.noalias() = -(slopes_of(rule).transpose() * df);
      part += at_upper * (p_s(edge_[c + 1]) * slopes.edge.row(edge + 1)) -
              at_lower * (p_s(edge_[c]) * slopes.edge.row(edge));
      part = ratio_.segment(first, count).asDiagonal() * part;
    } else {
      const auto [by_rise, by_first, by_second] = by_upper(c);
      const double rise = rise_of(c), apart = g_at_load_[first + 1] - g_at_load_[first];
      const RowVectorXd from_slope = p_s(edge_[c]) * slopes.edge.row(edge),
                        rise_slope = p_s(edge_[c + 1]) * slopes.edge.row(edge + 1) - from_slope;
      RowVectorXd upper = by_rise * rise_slope;
      if (apart > 0)
        upper += (rise * slopes.edge.row(edge + 1) - measure_[first] * slopes.node.row(first) -
                  measure_[first + 1] * slopes.node.row(first + 1)) /
                 apart;
      for (const auto& [i, by] : {std::pair(first, by_first), std::pair(first + 1, by_second)})
        upper -= by * (p_s(g_at_load_[i]) * slopes.node.row(i) - from_slope + f_[i] * (along.i2.row(i) + along.scale));
      part.row(0) = ratio_[first] * (rise_slope - upper);
      part.row(1) = ratio_[first + 1] * upper;
    }
  }
  result.part.topRows(n) += part_.head(n).asDiagonal() * along.ratio.topRows(n);
  const CorrectedG area = area_g_.at(g());
  result.area = contact_slope(area.g, form_) * area.slope * slopes.edge.bottomRows(1);
  result.macro = contact_slope(scale_ * g_macro_, form_) * slopes.macro;
}

void PerssonTheory::gradient(const ContactNumber& number, ContactGradient& result) {
  const auto& cells = grid_.cells();
  const Index n = g_.size();
  VectorXd by_node = VectorXd::Zero(n), by_edge = VectorXd::Zero(static_cast<Index>(cells.size()) + 1);
  result = {};
  result.by_part = number.by_part;
  result.ratio = number.by_part.cwiseProduct(part_);
  result.i2.setZero(i2_.size());
  result.weight.setZero(i2_.size());
  result.window.setZero(n);
  take_stress();
  VectorXd at_edges = VectorXd::Map(edge_.data(), std::ssize(edge_));
  make_stress(at_edges);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const auto edge = static_cast<Index>(c);
    const double before = at_edges[edge], at_end = at_edges[edge + 1];
    if (cells[c].rule) {  // by dF = P S dG
      const LegendreRule& rule = *cells[c].rule;
      const Eigen::Map<const VectorXd> at_lower(rule.at_lower, count), at_upper(rule.at_upper, count);
      const VectorXd by_measure = number.by_part.segment(first, count).cwiseProduct(ratio_.segment(first, count)),
                     by_f = -(slopes_of(rule) * by_measure);
      for (Index i = 0; i < count; ++i) by_node[first + i] = stress_[first + i] * by_f[i];
      by_edge[edge + 1] += at_end * at_upper.dot(by_measure);
      by_edge[edge] -= before * at_lower.dot(by_measure);
    } else {
      const auto [by_rise, by_first, by_second] = by_upper(c);
      const double rise = rise_of(c), apart = g_at_load_[first + 1] - g_at_load_[first];
      const double by_lower = number.by_part[first] * ratio_[first],
                   by_upper = number.by_part[first + 1] * ratio_[first + 1] - by_lower,
                   per_g = apart > 0 ? by_upper / apart : 0, whole = by_lower + by_upper * by_rise;
      by_edge[edge + 1] += at_end * whole + per_g * rise;
      by_edge[edge] -= before * (whole - by_upper * (by_first + by_second));
      for (const auto& [i, by] : {std::pair(first, by_first), std::pair(first + 1, by_second)}) {
        by_node[i] = -stress_[i] * by_upper * by - per_g * measure_[i];
        result.weight[i] = -by_upper * by * f_[i];
      }
    }
  }
  const CorrectedG area = area_g_.at(g());
  by_edge[by_edge.size() - 1] += number.by_area * contact_slope(area.g, form_) * area.slope;
  const VectorXd through_g = back_through_g(by_node, by_edge);
  result.weight.head(n) += through_g;
  result.i2.head(n) = result.weight.head(n);
  result.scale = result.weight.sum();
  back_through_macro(number.by_macro * contact_slope(scale_ * g_macro_, form_), result);
}

}  // namespace

std::unique_ptr<Theory> contact_theory(const ContactModel& model, const Spectrum& spectrum,
                                       std::span<const Segment> surface, const ContactGrid& grid,
                                       const Directions* directions) {
  if (std::holds_alternative<PartialContact>(model.correction)) {
    if (!directions) return partial_contact_theory(grid, 1);
    const Rings& mean = directions->mean();
    return partial_contact_theory(grid, partial_contact::crossed_edges(mean.along[0], mean.across[0]));
  }
  return std::make_unique<PerssonTheory>(model, spectrum, surface, grid);
}

}  // namespace asperity
