// F(G) = int_0^G P S dG of Eq. 22 with G of Eq. 7. By parts on each panel dF is a measure of the nodes, so that the
// front of F is met exactly; on pieces of rings, P S dG at their two nodes, of which the sum is made that of F.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/theory/theory.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using std::numbers::pi;

void Theory::add_up(const NodeModulus& modulus, double scale) {
  scale_ = scale;
  i2_ = modulus.i2;
  ratio_ = modulus.ratio;
  const auto& cells = grid_.cells();
  const auto n = static_cast<Index>(grid_.band_size());
  g_.resize(n);
  g_edge_.assign(cells.size() + 1, 0.0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const auto i2 = i2_.segment(first, count);
    g_.segment(first, count).noalias() = scale * (cells[c].to_g * i2);
    g_.segment(first, count).array() += g_edge_[c];
    g_edge_[c + 1] = g_edge_[c] + scale * grid_.weight().segment(first, count).dot(i2);
  }
  g_macro_ = scale * grid_.macro_weight().dot(i2_);
}

void Theory::add_up(const ModulusSlopes& along, GSlopes& slopes) const {
  const auto& cells = grid_.cells();
  const Index directions = along.i2.cols();
  slopes.node.resize(g_.size(), directions);
  slopes.edge.setZero(static_cast<Index>(cells.size()) + 1, directions);
  const MatrixXd di2 = scale_ * (i2_.asDiagonal() * along.i2);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const auto edge = static_cast<Index>(c);
    const auto here = di2.middleRows(first, count);
    slopes.node.middleRows(first, count).noalias() = cells[c].to_g * here;
    slopes.node.middleRows(first, count).rowwise() += slopes.edge.row(edge);
    slopes.edge.row(edge + 1) = slopes.edge.row(edge) + grid_.weight().segment(first, count).transpose() * here;
  }
  slopes.macro = grid_.macro_weight().transpose() * di2;
  if (along.scale.isZero(0)) return;
  slopes.node += g_ * along.scale;
  for (std::size_t c = 0; c < g_edge_.size(); ++c) slopes.edge.row(static_cast<Index>(c)) += g_edge_[c] * along.scale;
  slopes.macro += g_macro_ * along.scale;
}

double Theory::g_on(std::size_t panel, double u) const {
  const ContactGrid::Cell& cell = grid_.cells()[panel];
  double weights[LegendreRule::most], sum = g_edge_[panel];
  integrals_to(*cell.rule, u, weights);
  for (std::size_t j = 0; j < cell.count; ++j) {
    const auto at = static_cast<Index>(cell.first + j);
    sum += weights[j] * scale_ * grid_.weight()[at] / cell.rule->weight[j] * i2_[at];
  }
  return std::fmax(sum, 0);
}

namespace {

double p_slope(double g, Form form) {
  if (g <= 0) return 0;
  if (form == Form::exact) return -std::exp(-0.25 / g) * std::numbers::inv_sqrtpi / (2 * g * std::sqrt(g));
  const double x = pi * g, root = std::sqrt(x);
  return -0.5 * pi * root * std::pow(1 + x * root, -4.0 / 3);
}

double p_of(double g, Form form) { return g <= 0 ? 1 : contact_share(g, form); }

class PerssonTheory final : public Theory {
 public:
  PerssonTheory(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface,
                const ContactGrid& grid)
      : Theory(grid),
        form_(model.form),
        factor_(s_in_integrand(model.correction)),
        inside_(s_inside(model.correction, spectrum, surface, surface.back().b)),
        contact_(model.form, factor_),
        area_g_(model, spectrum, surface, surface.back().b) {}

  void evaluate(const NodeModulus& modulus, double scale, std::optional<double> log_kappa) override;
  void differentiate(const ModulusSlopes& along, ContactSlopes& result) override;
  [[nodiscard]] double density(std::size_t panel, double u, double wavenumber, double i1, double i2,
                               double rate) const override;

 private:
  [[nodiscard]] double p_s(double g) const {
    const double p = p_of(g, form_);
    return factor_ ? p * (*factor_)(p) : p;
  }
  [[nodiscard]] double p_s_slope(double g) const {
    constexpr double step = 1e-5;  // relative
    return g <= 0 ? 0 : (p_s(g * (1 + step)) - p_s(g * (1 - step))) / (2 * step * g);
  }
  void integral_of(const double* g, Index n, double* f) const;

  Form form_;
  std::optional<SFunction> factor_, inside_;
  ContactIntegral contact_;
  AreaG area_g_;
  VectorXd f_, measure_;
  std::vector<double> f_edge_;
};

/// F at values of G; their number is a multiple of `lanes`.
void PerssonTheory::integral_of(const double* g, Index n, double* f) const {
  kernels().contact_integral(contact_.table, g, static_cast<std::size_t>(n), f, nullptr);
  for (Index i = 0; i < n; ++i)
    if (g[i] < contact_.whole) f[i] = g[i];
}

void PerssonTheory::evaluate(const NodeModulus& modulus, double scale, std::optional<double> /*log_kappa*/) {
  add_up(modulus, scale);
  const auto& cells = grid_.cells();
  const Index n = g_.size();
  f_.resize(n);
  measure_.resize(n);
  std::vector<double> g = g_edge_;
  g.resize((g.size() + lanes - 1) / lanes * lanes, 1.0);
  f_edge_.resize(g.size());
  integral_of(g.data(), static_cast<Index>(g.size()), f_edge_.data());
  const bool panels = !cells.empty() && cells.front().rule != nullptr;
  if (panels) integral_of(g_.data(), n, f_.data());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto first = static_cast<Index>(cells[c].first), count = static_cast<Index>(cells[c].count);
    const double lower = f_edge_[c], rise = f_edge_[c + 1] - lower;
    if (panels) {
      const LegendreRule& rule = *cells[c].rule;
      for (std::size_t j = 0; j < rule.n; ++j) {
        double sum = rise * rule.at_upper[j];
        for (std::size_t i = 0; i < rule.n; ++i) sum -= rule.slope[j][i] * (f_[first + static_cast<Index>(i)] - lower);
        measure_[first + static_cast<Index>(j)] = sum;
      }
      continue;
    }
    double sum = 0;
    for (Index i = first; i < first + count; ++i) sum += measure_[i] = scale_ * grid_.weight()[i] * i2_[i] * p_s(g_[i]);
    if (sum > 0) measure_.segment(first, count) *= rise / sum;
  }
  part_.setZero(i2_.size());
  part_.head(n) = ratio_.head(n).cwiseProduct(measure_);
  area_ = p_of(area_g_(g_edge_.back()), form_);
  macro_ = p_of(g_macro_, form_);
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
      using Columns = Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>;
      const Columns slope(&rule.slope[0][0], count, count, Eigen::OuterStride<>(LegendreRule::most));
      const Eigen::Map<const VectorXd> at_lower(rule.at_lower, count), at_upper(rule.at_upper, count);
      VectorXd share(count);
      for (Index i = 0; i < count; ++i) share[i] = p_s(g_[first + i]);
      const MatrixXd df = share.asDiagonal() * slopes.node.middleRows(first, count);
      part.noalias() = -(slope.transpose() * df);
      part += at_upper * (p_s(g_edge_[c + 1]) * slopes.edge.row(edge + 1)) -
              at_lower * (p_s(g_edge_[c]) * slopes.edge.row(edge));
      part = ratio_.segment(first, count).asDiagonal() * part;
    } else {
      for (Index i = 0; i < count; ++i) {
        const Index at = first + i;
        const double share = p_s(g_[at]);
        if (!(share > 0)) continue;
        part.row(i) = part_[at] * (along.i2.row(at) + along.scale + (p_s_slope(g_[at]) / share) * slopes.node.row(at));
      }
    }
  }
  result.part.topRows(n) += part_.head(n).asDiagonal() * along.ratio.topRows(n);
  const double area_g = area_g_(g_edge_.back());
  const double area_slope = p_slope(area_g, form_) * (inside_ ? (*inside_)(area_) : 1);  // dG = S dG(uncorrected)
  result.area = area_slope * slopes.edge.bottomRows(1);
  result.macro = p_slope(g_macro_, form_) * slopes.macro;
}

double PerssonTheory::density(std::size_t panel, double u, double, double i1, double i2, double rate) const {
  return rate * (i1 / i2) * p_s(g_on(panel, u));
}

}  // namespace

std::unique_ptr<Theory> contact_theory(const ContactModel& model, const Spectrum& spectrum,
                                       std::span<const Segment> surface, const ContactGrid& grid) {
  if (std::holds_alternative<PartialContact>(model.correction)) return partial_contact_theory(grid);
  return std::make_unique<PerssonTheory>(model, spectrum, surface, grid);
}

}  // namespace asperity
