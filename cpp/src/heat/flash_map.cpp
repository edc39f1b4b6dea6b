// Friction leaves the power sigma0 v dmu in the macro-asperity contacts, the share P_m of the surface, as deep as the
// roughness deforms it. The rise that roughness q feels is
//   theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q') + chi (mu_A sigma0 v / (rho c_v P_m)) 2 q t N,
// with dmu_H = 4 (1 - nu^2) sigma0 R dF of Eq. 22, R = I1 / I2 at v q a_T(T0 + theta(q)) and F(G) = int_0^G P S dG, and
// G of Eq. 7 at the same frequencies. By parts on each panel dF is a measure of the nodes, so that the front of F is
// met exactly. All derivatives are closed. B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006).
#include "heat/flash_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

using Eigen::Index;
using std::numbers::pi;

namespace {

constexpr double hottest = 1000;  // [K], to which a search for a temperature may go

double p_slope(double g, Form form) {
  if (g <= 0) return 0;
  if (form == Form::exact) return -std::exp(-0.25 / g) * std::numbers::inv_sqrtpi / (2 * g * std::sqrt(g));
  const double x = pi * g, root = std::sqrt(x);
  return -0.5 * pi * root * std::pow(1 + x * root, -4.0 / 3);
}

double p_of(double g, Form form) { return g <= 0 ? 1 : contact_share(g, form); }

/// The shift at a temperature, held where it ends: whether a result lies there is checked at the end.
ShiftValue held_shift(const TemperatureShift& shift, double temperature) {
  double at = std::fmin(temperature, hottest);
  if (const auto* table = std::get_if<ShiftTable>(&shift))
    at = std::clamp(at, table->temperature().front(), table->temperature().back());
  ShiftValue value = shift_at(shift, at);
  if (at != temperature) value.slope = 0;
  return value;
}

}  // namespace

FlashMap::FlashMap(const HeatScene& scene, const HeatGrid& grid)
    : scene_(scene),
      grid_(grid),
      contact_(scene.model.form, scene.factor),
      angular_(scene.rubber),
      area_g_(scene.model, scene.spectrum, scene.surface, scene.surface.back().b),
      inside_(s_inside(scene.model.correction, scene.spectrum, scene.surface, scene.surface.back().b)),
      macro_panels_(grid.panels_below(scene.macro_wavenumber)) {
  const auto n = static_cast<Index>(grid.size());
  reduced_.resize(grid.size());
  for (auto* column : {&temperature_, &rate_, &ratio_, &dg_, &g_, &f_, &share_, &measure_}) column->setZero(n);
}

void FlashMap::start(const HeatPoint& point) {
  const bool moved = point.velocity != point_.velocity;
  point_ = point;
  const double stiffening = 1 / (1 - scene_.model.poisson_ratio * scene_.model.poisson_ratio);
  scale_ = 1 / (point.pressure * point.shift_factor) / (point.pressure * point.shift_factor);
  mu_factor_ = 4 * point.pressure / stiffening;
  per_flux_ = point.velocity * point.pressure / (scene_.heating.density * scene_.heating.heat_capacity);
  if (!moved) return;
  const HeatKernel kernel(scene_.heating, point.velocity);
  const std::vector<double>&points = grid_.temperature_points(), &nodes = grid_.wavenumber();
  kernel_.setOnes(static_cast<Index>(points.size()) + 1, static_cast<Index>(nodes.size()));
  surface_.resize(static_cast<Index>(points.size()));
  std::vector<HeatKernel::Place> felt;
  for (const double q : points) felt.push_back(kernel.at(q));
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const HeatKernel::Place heated = kernel.at(nodes[j]);
    for (std::size_t i = 0; i < points.size(); ++i)
      kernel_(static_cast<Index>(i), static_cast<Index>(j)) = nodes[j] * kernel(felt[i], heated);
  }
  for (std::size_t i = 0; i < points.size(); ++i) surface_[static_cast<Index>(i)] = kernel.from_surface(felt[i]);
}

double FlashMap::reduced_frequency(double wavenumber, double temperature) const {
  return point_.velocity * wavenumber * std::pow(10.0, held_shift(scene_.shift, temperature).log10_a_T);
}

void FlashMap::frequencies(const Eigen::VectorXd& theta) {
  temperature_.noalias() = grid_.to_nodes() * theta;
  temperature_.array() += point_.temperature;
  for (std::size_t j = 0; j < reduced_.size(); ++j) {
    const auto at = static_cast<Index>(j);
    const ShiftValue shift = held_shift(scene_.shift, temperature_[at]);
    reduced_[j] = point_.velocity * grid_.wavenumber()[j] * std::exp(std::numbers::ln10 * shift.log10_a_T);
    rate_[at] = std::numbers::ln10 * shift.slope;
  }
}

/// G and F at the nodes and at the ends of panels.
void FlashMap::contact() {
  const auto& panels = grid_.panels();
  const Form form = scene_.model.form;
  const auto p_s = [&](double g) {
    const double p = p_of(g, form);
    return scene_.factor ? p * (*scene_.factor)(p) : p;
  };
  g_edge_.assign(panels.size() + 1, 0.0);
  double edges[4] = {1, 1, 1, 1}, f_edges[4];
  f_edge_.assign(panels.size() + 1, 0.0);
  share_edge_.assign(panels.size() + 1, 1.0);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const LegendreRule& rule = *panels[p].rule;
    const auto first = static_cast<Index>(panels[p].first);
    const auto& columns = panels[p].lower == 0 ? rule.cumulative_linear : rule.cumulative;
    double sum = 0;
    for (std::size_t i = 0; i < rule.n; ++i) g_[first + static_cast<Index>(i)] = g_edge_[p];
    for (std::size_t j = 0; j < rule.n; ++j) {
      const double dg = dg_[first + static_cast<Index>(j)];
      sum += rule.weight[j] * dg;
      for (std::size_t i = 0; i < rule.n; ++i) g_[first + static_cast<Index>(i)] += columns[j][i] * dg;
    }
    g_edge_[p + 1] = g_edge_[p] + sum;
    kernels().contact_integral(contact_.table, &g_[first], rule.n, &f_[first], nullptr);
    edges[0] = g_edge_[p + 1];
    kernels().contact_integral(contact_.table, edges, 4, f_edges, nullptr);
    f_edge_[p + 1] = edges[0] < contact_.whole ? edges[0] : f_edges[0];
    share_edge_[p + 1] = p_s(edges[0]);
    for (std::size_t i = 0; i < rule.n; ++i) {
      const Index at = first + static_cast<Index>(i);
      if (g_[at] < contact_.whole) f_[at] = g_[at];
      share_[at] = p_s(g_[at]);
    }
  }
}

/// int f dF over a panel is sum f_j m_j: f F at the ends less the integral of F f'.
void FlashMap::measure() {
  for (std::size_t p = 0; p < grid_.panels().size(); ++p) {
    const HeatGrid::Panel& panel = grid_.panels()[p];
    const LegendreRule& rule = *panel.rule;
    const auto first = static_cast<Index>(panel.first);
    const double rise = f_edge_[p + 1] - f_edge_[p];
    for (std::size_t j = 0; j < rule.n; ++j) {
      double sum = rise * rule.at_upper[j];
      for (std::size_t i = 0; i < rule.n; ++i)
        sum -= rule.slope[j][i] * (f_[first + static_cast<Index>(i)] - f_edge_[p]);
      measure_[first + static_cast<Index>(j)] = sum;
    }
  }
}

void FlashMap::operator()(const Eigen::VectorXd& theta) {
  frequencies(theta);
  angular_(reduced_, columns_);
  for (Index j = 0; j < dg_.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    dg_[j] = scale_ * grid_.roughness()[at] * columns_.i2[at];
    ratio_[j] = columns_.i1[at] / columns_.i2[at];
  }
  contact();
  measure();
  heat();
}

void FlashMap::heat() {
  const auto& panels = grid_.panels();
  const Form form = scene_.model.form;
  const Index n = dg_.size(), points = kernel_.rows() - 1;
  const Eigen::VectorXd part = ratio_.cwiseProduct(measure_);
  const Eigen::VectorXd integrals = kernel_ * part;
  hysteresis_ = mu_factor_ * integrals[points];
  const double g_macro = g_edge_[macro_panels_], g_end = g_edge_.back();
  macro_area_ = scene_.heating.macro_area.value_or(p_of(g_macro, form));
  const double area_g = area_g_(g_end);
  area_ = p_of(area_g, form);
  const double area_slope = p_slope(area_g, form) * (inside_ ? (*inside_)(area_) : 1);  // dG = S dG(uncorrected)
  const double by_depth = 2 * per_flux_ * mu_factor_ / macro_area_;
  const double by_surface = scene_.heating.interface_share * per_flux_ * point_.adhesion_per_area / macro_area_;
  hysteresis_rise_ = by_depth * integrals.head(points);
  rise_ = hysteresis_rise_ + by_surface * area_ * surface_;

  // d(integrals) = [kernel R'(T) m + kernel R dm] dT; dm by dF = P S dG, dG by the integral of dG/du up to the node
  Eigen::MatrixXd by_node(points + 1, n);
  Eigen::VectorXd after = Eigen::VectorXd::Zero(points + 1);  // what a constant added to G does from a panel on
  Eigen::RowVectorXd g_rate(n), macro_rate = Eigen::RowVectorXd::Zero(n);
  for (std::size_t p = panels.size(); p-- > 0;) {
    const LegendreRule& rule = *panels[p].rule;
    const auto first = static_cast<Index>(panels[p].first), count = static_cast<Index>(rule.n);
    using Columns = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    const Columns slope(&rule.slope[0][0], count, count, Eigen::OuterStride<>(LegendreRule::most));
    const Columns up_to(panels[p].lower == 0 ? &rule.cumulative_linear[0][0] : &rule.cumulative[0][0], count, count,
                        Eigen::OuterStride<>(LegendreRule::most));
    const Eigen::Map<const Eigen::VectorXd> weight(rule.weight, count), lower(rule.at_lower, count),
        upper(rule.at_upper, count);
    const Eigen::MatrixXd with_ratio = kernel_.middleCols(first, count) * ratio_.segment(first, count).asDiagonal();
    const Eigen::MatrixXd by_g = -(with_ratio * slope.transpose()) * share_.segment(first, count).asDiagonal();
    const Eigen::VectorXd at_end = with_ratio * upper * share_edge_[p + 1];
    const Eigen::VectorXd at_start = -(with_ratio * lower) * share_edge_[p];
    by_node.middleCols(first, count).noalias() = by_g * up_to + (at_end + after) * weight.transpose();
    after += by_g.rowwise().sum() + at_end + at_start;
    g_rate.segment(first, count) = weight.transpose();
    if (p < macro_panels_) macro_rate.segment(first, count) = weight.transpose();
  }
  for (Index j = 0; j < n; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const double ln_i2 = columns_.slope2[at] / columns_.i2[at], dg = dg_[j] * ln_i2 * rate_[j];
    const double ratio = (columns_.slope1[at] - ratio_[j] * columns_.slope2[at]) / columns_.i2[at] * rate_[j];
    by_node.col(j) = by_node.col(j) * dg + kernel_.col(j) * (measure_[j] * ratio);
    g_rate[j] *= dg;
    macro_rate[j] *= dg;
  }
  const Eigen::MatrixXd by_theta = by_node * grid_.to_nodes();
  const Eigen::RowVectorXd area_rate = area_slope * (g_rate * grid_.to_nodes());
  jacobian_ = by_depth * by_theta.topRows(points) + by_surface * surface_ * area_rate;
  if (!scene_.heating.macro_area && g_macro > 0)
    jacobian_ -= rise_ * (p_slope(g_macro, form) / macro_area_ * (macro_rate * grid_.to_nodes()));
  slope_of_mu_ = mu_factor_ * by_theta.row(points) + point_.adhesion_per_area * area_rate;
}

Eigen::VectorXd FlashMap::heat_of_nodes() const {
  const Eigen::Map<const Eigen::VectorXd> q(grid_.wavenumber().data(), ratio_.size());
  return 2 * per_flux_ * mu_factor_ / macro_area_ * q.cwiseProduct(ratio_).cwiseProduct(measure_);
}

double FlashMap::heat_of_surface() const {
  return scene_.heating.interface_share * per_flux_ * adhesion() / macro_area_;
}

std::vector<double> FlashMap::contributions() const {
  std::vector<double> part(grid_.size());
  for (std::size_t j = 0; j < part.size(); ++j) {
    const auto at = static_cast<Index>(j);
    part[j] = mu_factor_ * ratio_[at] * measure_[at];
  }
  return part;
}

double FlashMap::g_on(std::size_t panel, double u) const {
  const HeatGrid::Panel& p = grid_.panels()[panel];
  double weights[LegendreRule::most], sum = g_edge_[panel];
  integrals_to(*p.rule, u, weights);
  for (std::size_t j = 0; j < p.rule->n; ++j) sum += weights[j] * dg_[static_cast<Index>(p.first + j)];
  return std::fmax(sum, 0);
}

}  // namespace asperity
