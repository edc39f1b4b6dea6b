// From slopes over the roughness, I1 and I2 of each node to those over all that these are made of.
#include "friction/gradient_chain.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "contact/theory/s_factor.hpp"
#include "numerics/differences.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

Eigen::Map<const VectorXd> column(const std::vector<double>& values, std::size_t n) {
  return {values.data(), static_cast<Index>(n)};
}

VectorXd one(double value) { return VectorXd::Constant(1, value); }

}  // namespace

GradientChain::GradientChain(const GradientScene& scene, const ContactGrid& grid)
    : scene_(scene),
      grid_(grid),
      roughness_(grid),
      rows_(scene.surface, !scene.law, grid, scene.rows, scene.law ? nullptr : scene.waves.directions(),
            scene.harmonics),
      known_(known_range(scene.rubber)) {
  if (const Directions* const directions = scene.waves.directions(); directions && scene.harmonics > 0)
    rings_.emplace(*directions, grid, scene.harmonics);
  if (scene.law && rings_)
    take_directional_law();
  else if (scene.law)
    take_law();
  if (std::holds_alternative<NayakSFactor>(scene.model.correction)) take_nayak();
  const std::vector<std::string> numbers = correction_arguments(scene.model.correction);
  if (std::ranges::any_of(numbers, [](const std::string& name) { return name.ends_with("gamma"); }))
    gamma_.emplace(scene.model, scene.spectrum, scene.surface, grid);
  if (scene.model.strain_factors) strain_.emplace(*scene.model.strain_factors, scene.surface, grid);
  integrals_.parted = strain_.has_value();
}

/// alpha = 1.5 m0 m4 / m2^2 of m_n = int q^(n + 1) C dq.
void GradientChain::take_nayak() {
  const VectorXd &c = grid_.weight(), q = column(grid_.wavenumber(), grid_.band_size());
  const VectorXd m0 = c.cwiseQuotient(q.cwiseAbs2()), m4 = c.cwiseProduct(q.cwiseAbs2());
  nayak_ = m0 / m0.sum() + m4 / m4.sum() - 2 * c / c.sum();
  const double alpha = nayak_parameter(scene_.spectrum);
  for (const double factor : {1 - difference_step, 1 + difference_step})
    inside_.emplace_back(nayak_s(alpha * factor), scene_.model.form);
}

/// Over ln C of the nodes, by p_T and by Nayak's parameter too.
VectorXd GradientChain::by_roughness(const MuSlopes& mu, double by_end, const ShiftGradient& shift) {
  VectorXd result = roughness_(mu.of, by_end);
  const auto n = static_cast<Index>(grid_.band_size());
  const VectorXd q = column(grid_.wavenumber(), grid_.band_size());
  if (shift.rms_height != 0) {
    const VectorXd square = grid_.weight().cwiseQuotient(q.cwiseAbs2());
    result.head(n) += (-2 * mu.of.scale * shift.rms_height / (2 * square.sum())) * square;
  }
  if (!inside_.empty() && mu.by_area != 0 && mu.g > 0) {
    result.head(n) +=
        mu.by_area *
        (contact_share(inside_[1](mu.g), scene_.model.form) - contact_share(inside_[0](mu.g), scene_.model.form)) /
        (2 * difference_step) * nayak_;
  }
  return result;
}

/// d mu over ln q of the upper end of the band as it moves outwards, C going on: what a node there has, over its d ln
/// q.
double GradientChain::at_end(const VectorXd& by_node) const {
  constexpr double same = 1e-12;
  if (const RoughnessPieces* const pieces = grid_.pieces()) {  // of the last one, a straight line through its nodes
    const auto last = static_cast<Index>(2 * pieces->nodes().end.size()) - 1;
    const std::vector<double>& q = grid_.wavenumber();
    const auto per_weight = [&](Index j) { return by_node[j] / grid_.weight()[j]; };
    const auto at = [&](Index j) { return std::log(q[static_cast<std::size_t>(j)]); };
    const double end = scene_.surface.back().b, rise = (std::log(end) - at(last)) / (at(last) - at(last - 1));
    const double square = end * end, softening = 1 - scene_.model.poisson_ratio * scene_.model.poisson_ratio;
    const double rate = square * square * scene_.surface.back().at_b / (8 * softening * softening);
    double result = per_weight(last) + rise * (per_weight(last) - per_weight(last - 1));
    if (by_node.size() <= grid_.weight().size() || grid_.macro_stretches().empty()) return rate * result;
    const ContactGrid::Stretch& stretch = grid_.macro_stretches().back();
    if (stretch.upper < end * (1 - same)) return rate * result;  // q_m is below the end
    for (std::size_t j = stretch.first; j < stretch.first + stretch.count; ++j) {
      double part = by_node[static_cast<Index>(j)] / grid_.macro_weight()[static_cast<Index>(j)];
      for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i)
        if (i != j) part *= std::log(end / q[i]) / std::log(q[j] / q[i]);
      result += part;
    }
    return rate * result;
  }
  const ContactGrid::Cell& cell = grid_.cells().back();
  const LegendreRule& rule = *cell.rule;
  const double half = (cell.upper - cell.lower) / 2;
  double result = 0;
  for (std::size_t j = 0; j < rule.n; ++j) {
    const double t = cell.lower + half * (1 + rule.node[j]);
    const double length = half * rule.weight[j] * 2 * t;
    result += rule.at_upper[j] * by_node[static_cast<Index>(cell.first + j)] / length;
  }
  return result;
}

PointGradient GradientChain::operator()(const MuSlopes& mu, const ShiftGradient& shift) {
  const std::size_t n = grid_.size(), band = grid_.band_size();
  const ContactGrid::Beyond& beyond = grid_.beyond();
  const std::size_t edges_end = beyond.end ? beyond.first + beyond.count + 1 : band;
  static constexpr double alone = 1;
  integrals_.waves.clear();
  integrals_.mean = {&alone, 1};
  if (rings_) rings_->clear();
  PointGradient result;
  VectorXd by_f = VectorXd::Zero(static_cast<Index>(strain_ ? n : 0)), by_g = by_f;
  double by_end = mu.end, homogeneous = 0, beside = 0;
  VectorXd linear(mu.of.i2.size()), storage = linear, loss = linear;
  const auto add = [&](const FeltModulus& felt, const VectorXd& of_i1, const VectorXd& of_i2, bool moves) {
    const VectorXd log_w = column(felt.frequency, n).array().log();
    if (rings_) integrals_.mean = rings_->take(felt.blocks);
    linear.setZero();
    storage.setZero();
    loss.setZero();
    for (std::size_t j = 0; j < n; ++j) {
      const auto at = static_cast<Index>(j);
      const double i1 = felt.columns.i1[j], i2 = felt.columns.i2[j], by_i1 = i1 > 0 ? of_i1[at] : 0, by_i2 = of_i2[at];
      if (by_i1 == 0 && by_i2 == 0) continue;
      const double per_i1 = i1 > 0 ? by_i1 / i1 : 0, per_i2 = by_i2 / i2;
      const bool held = known_ && j >= band && felt.frequency[j] == known_->highest;  // by its user
      if (!held) {
        const double part = per_i2 * felt.columns.slope2[j] + per_i1 * felt.columns.slope1[j];
        result.by_frequency += part;
        result.by_temperature += part * felt.rate[at];
        if (!felt.beside.i1.empty()) beside += per_i2 * felt.beside.slope2[j] + per_i1 * felt.beside.slope1[j] - part;
        if (moves && j >= band && j < edges_end) by_end += part * felt.along[at];
      }
      homogeneous += by_i1 + 2 * by_i2;
      const auto [f, g] = strain_ ? strain_->factors()[j] : ModulusFactors{};
      linear[at] = g * per_i1;
      storage[at] = f * f * per_i2;
      loss[at] = g * g * per_i2;
      if (strain_) {
        const double by_loss = 2 * loss[at] * felt.loss_part[j];
        by_f[at] += 2 * by_i2 - by_loss;
        by_g[at] += by_loss + by_i1;
      }
      integrals_.waves.push_back({felt.frequency[j], log_w[at], linear[at], storage[at], loss[at],
                                  rings_ ? rings_->of(j) : std::span<const double>{}});
    }
    if (rings_) rings_->add(felt, linear, storage, loss);
  };
  add(mu.felt, mu.of.ratio, mu.of.i2 - mu.of.ratio, true);
  if (mu.of.cold_i2.size() != 0) add(mu.cold, VectorXd::Zero(mu.of.cold_i2.size()), mu.of.cold_i2, true);

  StrainGradient::Slopes strain;
  VectorXd by_strain = VectorXd::Zero(static_cast<Index>(band));
  if (strain_) strain = (*strain_)(by_f, by_g, by_strain);
  VectorXd by_node = by_roughness(mu, by_end + strain.end, shift);
  if (rings_) rings_->spread(mu.of.edges, by_node);
  const double at_q1 = law_.empty() ? 0 : at_end(by_node) + strain.beyond * at_end(grid_.weight());
  by_node.head(by_strain.size()) += by_strain;
  static const Eigen::MatrixXd none;
  result.spectrum = rows_(by_node, rings_ ? rings_->slopes() : none);
  add_law(mu, shift, by_node, at_q1, result);
  if (rings_) result.arguments.push_back(one(rings_->turned()));
  // over the nodes of the modulus; I1 is linear in E and I2 a square
  scene_.modulus(integrals_, result.storage, result.loss);
  result.missed = std::fmax(std::fabs(result.storage.sum() + result.loss.sum() - homogeneous), std::fabs(beside));
  add_modulus(mu, shift, result);
  if (strain_) {
    result.arguments.push_back(one(strain.per_slope));
    result.arguments.push_back(std::move(strain.storage));
    result.arguments.push_back(std::move(strain.loss));
  }
  // all that knows Poisson's ratio has E / (1 - nu^2)
  const double nu = scene_.model.poisson_ratio;
  result.arguments.push_back(one(2 * nu * nu / (1 - nu * nu) * (homogeneous + 2 * mu.of.scale * shift.pressure)));
  if (gamma_)
    result.arguments.push_back(
        one((*gamma_)({{mu.felt.columns.i1.data(), n}, {mu.felt.columns.i2.data(), n}}, mu.of, mu.by_area, mu.g)));
  for (const double slope : shift.correction) result.arguments.push_back(one(-2 * mu.of.scale * slope));
  return result;
}

/// Over the frequency at which p_T knows |E|.
double GradientChain::by_frequency_of(const MuSlopes& mu, const ShiftGradient& shift) const {
  const double w = shift.velocity * shift.macro_wavenumber;
  const auto size = [&](double at) { return std::abs(modulus(scene_.rubber, at)); };
  const auto held = [&](double at) { return known_ ? std::clamp(at, known_->lowest, known_->highest) : at; };
  const double lower = held(w * (1 - difference_step)), upper = held(w * (1 + difference_step));
  return 2 * mu.of.scale * shift.pressure * std::log(size(upper) / size(lower)) / std::log(upper / lower);
}

/// Over the rows of the modulus and the numbers of a series. A p_T that knows |E| has it at one frequency.
void GradientChain::add_modulus(const MuSlopes& mu, const ShiftGradient& shift, PointGradient& result) const {
  const bool series = scene_.terms.has_value();
  VectorXd terms;
  if (series) terms = (*scene_.terms)(result.storage, result.loss);
  if (shift.macro_wavenumber > 0) {
    const double w = shift.velocity * shift.macro_wavenumber;
    const std::complex<double> e = modulus(scene_.rubber, w);
    const Eigen::Vector2d parts =
        2 * mu.of.scale * shift.pressure / std::norm(e) * Eigen::Vector2d(e.real() * e.real(), e.imag() * e.imag());
    scene_.modulus.add_at(w, parts[0], parts[1], result.storage, result.loss);
    if (series) terms += scene_.terms->at(w) * parts;
    const double part = by_frequency_of(mu, shift);
    result.by_frequency += part;
    result.by_temperature += part * shift.rate;
  }
  for (VectorXd* const of : {&result.storage, &result.loss}) *of = scene_.modulus.over_rows(*of);
  if (!series) return;
  const Index n = terms.size() / 2;
  result.arguments.insert(result.arguments.end(), {terms.head(1), terms.segment(1, n), terms.tail(n)});
}

}  // namespace asperity
