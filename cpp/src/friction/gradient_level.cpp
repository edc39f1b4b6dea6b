// mu_H = 4 (1 - nu^2) sigma0 times the sum of parts that know G at the scale 1 / (sigma0 p_T)^2, and mu_A is in
// proportion to A / A0 / sigma0: slopes by the chain rule, backwards from mu over the roughness, I1 and I2 of each
// node.
#include "friction/gradient_level.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "contact/theory/s_factor.hpp"
#include "friction/before_heating.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

ContactGridOptions grid_options(const GradientScene& scene, std::size_t number, const RoughnessWindow& window) {
  ContactGridOptions result;
  result.poisson_ratio = scene.model.poisson_ratio;
  result.level = number;
  result.tabulated = std::holds_alternative<MasterCurve>(scene.rubber);
  if (std::holds_alternative<PartialContact>(scene.model.correction)) result.window = &window;
  const auto* const table = std::get_if<TabulatedSpectrum>(&scene.spectrum);
  constexpr std::size_t few = 8;
  if (table && table->wavenumber().size() >= few)
    result.pieces = &roughness_pieces(*table, number);
  else
    result.stops = scene.rows;
  return result;
}

Eigen::Map<const VectorXd> column(const std::vector<double>& values, std::size_t n) {
  return {values.data(), static_cast<Index>(n)};
}

}  // namespace

std::vector<std::string> law_arguments(const SelfAffineSpectrum& law) {
  std::vector<std::string> result{"rms_height", "hurst", "q0", "q1"};
  if (law.rolloff) result.emplace_back("rolloff");
  return result;
}

SelfAffineSpectrum changed_law(const SelfAffineSpectrum& law, std::size_t argument, double factor) {
  SelfAffineSpectrum result = law;
  double* const numbers[] = {&result.rms_height, &result.hurst, &result.q0, &result.q1,
                             result.rolloff ? &*result.rolloff : nullptr};
  *numbers[argument] *= factor;
  return result;
}

GradientLevel::GradientLevel(const GradientScene& scene, std::size_t number)
    : scene_(scene),
      number_(number),
      window_(scene.surface),
      grid_(scene.surface, grid_options(scene, number, window_)),
      theory_(contact_theory(scene.model, scene.spectrum, scene.surface, grid_)),
      roughness_(grid_),
      rows_(scene.surface, std::holds_alternative<TabulatedSpectrum>(scene.spectrum), grid_, scene.rows),
      angular_(scene.rubber),
      known_(known_range(scene.rubber)) {
  take_law();
  if (std::holds_alternative<NayakSFactor>(scene.model.correction)) take_nayak();
}

/// By central differences of ln C.
void GradientLevel::take_law() {
  const auto* const law = std::get_if<SelfAffineSpectrum>(&scene_.spectrum);
  if (!law) return;
  constexpr double step = 1e-6;
  for (std::size_t k = 0; k < law_arguments(*law).size(); ++k) {
    const SelfAffineSpectrum less = changed_law(*law, k, 1 - step), more = changed_law(*law, k, 1 + step);
    VectorXd slope(static_cast<Index>(grid_.band_size()));
    for (Index j = 0; j < slope.size(); ++j) {
      const double q = std::clamp(grid_.wavenumber()[static_cast<std::size_t>(j)], law->q0 * (1 + 2 * step),
                                  law->q1 * (1 - 2 * step));
      slope[j] = std::log(density(more, q) / density(less, q)) / (2 * step);
    }
    law_.push_back(std::move(slope));
  }
}

/// alpha = 1.5 m0 m4 / m2^2 of m_n = int q^(n + 1) C dq.
void GradientLevel::take_nayak() {
  const VectorXd &c = grid_.weight(), q = column(grid_.wavenumber(), grid_.band_size());
  const VectorXd m0 = c.cwiseQuotient(q.cwiseAbs2()), m4 = c.cwiseProduct(q.cwiseAbs2());
  nayak_ = m0 / m0.sum() + m4 / m4.sum() - 2 * c / c.sum();
  const double alpha = nayak_parameter(scene_.spectrum);
  constexpr double step = 1e-4;
  for (const double factor : {1 - step, 1 + step}) inside_.emplace_back(nayak_s(alpha * factor), scene_.model.form);
}

/// Over ln C of the nodes, by p_T and by Nayak's parameter too.
VectorXd GradientLevel::by_roughness(const ContactGradient& of, double by_end, double by_area,
                                     const ShiftGradient& shift) {
  VectorXd result = roughness_(of, by_end);
  const VectorXd q = column(grid_.wavenumber(), grid_.band_size());
  if (shift.rms_height != 0) {
    const VectorXd square = grid_.weight().cwiseQuotient(q.cwiseAbs2());
    result += (-2 * of.scale * shift.rms_height / (2 * square.sum())) * square;
  }
  if (!inside_.empty() && by_area != 0 && theory_->g() > 0) {
    const double g = theory_->g();
    constexpr double apart = 2e-4;  // of ln alpha
    result += by_area *
              (contact_share(inside_[1](g), scene_.model.form) - contact_share(inside_[0](g), scene_.model.form)) /
              apart * nayak_;
  }
  return result;
}

/// d mu over ln q of an end of the band that moves outwards, C going on: what a node there has, over its d ln q.
double GradientLevel::at_end(const VectorXd& by_node, bool upper) const {
  const ContactGrid::Cell& cell = upper ? grid_.cells().back() : grid_.cells().front();
  const LegendreRule& rule = *cell.rule;
  const double half = (cell.upper - cell.lower) / 2, *const shape = upper ? rule.at_upper : rule.at_lower;
  double result = 0;
  for (std::size_t j = 0; j < rule.n; ++j) {
    const double t = cell.lower + half * (1 + rule.node[j]);
    const double length = half * rule.weight[j] * 2 * t;
    result += shape[j] * by_node[static_cast<Index>(cell.first + j)] / length;
  }
  return result;
}

PointGradient GradientLevel::operator()(const GradientPoint& point, const ShiftGradient& shift) {
  const std::size_t n = grid_.size(), band = grid_.band_size();
  reduced_.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    reduced_[j] = point.velocity * point.a_T * grid_.wavenumber()[j];
    // beyond the band the modulus keeps the value that it has at the last frequency that is known
    if (known_) reduced_[j] = std::fmin(reduced_[j], known_->highest);
  }
  angular_(reduced_, columns_);
  theory_->start({});
  theory_->take({{columns_.i1.data(), n}, {columns_.i2.data(), n}});
  const double root = 1 / (point.pressure * shift.p);
  theory_->evaluate(root * root, {});

  const double nu = scene_.model.poisson_ratio, by_part = 4 * (1 - nu * nu) * point.pressure;
  const double by_area = scene_.adhesion ? adhesion_per_share(*scene_.adhesion, point.pressure, point.velocity) : 0;
  ContactGradient of;
  theory_->gradient(by_part, by_area, of);
  const double hysteresis = by_part * theory_->part().sum(), adhesion = by_area * theory_->area();

  // over ln w of all nodes, and of those beyond the band, which move with its end
  double by_frequency = 0, by_end = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double i1 = columns_.i1[j], i2 = columns_.i2[j];
    if (!(i1 > 0) && of.ratio[static_cast<Index>(j)] != 0) continue;
    const double slope2 = columns_.slope2[j] / i2, slope1 = i1 > 0 ? columns_.slope1[j] / i1 : slope2;
    const bool held = known_ && reduced_[j] >= known_->highest && j >= band;
    const double part =
        held ? 0 : of.i2[static_cast<Index>(j)] * slope2 + of.ratio[static_cast<Index>(j)] * (slope1 - slope2);
    by_frequency += part;
    if (j >= band) by_end += part;
  }
  PointGradient result;
  const VectorXd by_node = by_roughness(of, by_end, by_area, shift);
  result.spectrum = rows_(by_node);
  result.pressure = hysteresis - adhesion - 2 * of.scale * (1 + shift.pressure);
  add_law(of, shift, by_node, result);
  result.by_a_T = by_frequency;
  add_modulus(point, of, shift, result);
  result.velocity = result.by_a_T;
  if (scene_.adhesion) {
    const Adhesion& a = *scene_.adhesion;
    const double decades = std::log10(point.velocity / a.reference_velocity),
                 slope = -2 * a.width * decades / std::numbers::ln10;
    result.velocity += slope * adhesion;
    for (const double one : {adhesion, -slope * adhesion, -a.width * decades * decades * adhesion})
      result.arguments.push_back(VectorXd::Constant(1, one));
  }
  return result;
}

void GradientLevel::add_law(const ContactGradient& of, const ShiftGradient& shift, const VectorXd& by_node,
                            PointGradient& result) const {
  for (std::size_t k = 0; k < law_.size(); ++k) {
    double slope = by_node.dot(law_[k]);
    if (k == 2) slope -= at_end(by_node, false);
    if (k == 3) slope += at_end(by_node, true);
    // the rms height is in the slope over ln C already
    if (k > 0 && !shift.law.empty()) slope -= 2 * of.scale * shift.law[k];
    result.arguments.push_back(VectorXd::Constant(1, slope));
  }
}

/// Over the rows of the modulus and the terms of a series. A p_T that knows |E| has it at one frequency.
void GradientLevel::add_modulus(const GradientPoint& point, const ContactGradient& of, const ShiftGradient& shift,
                                PointGradient& result) {
  const std::size_t n = grid_.size();
  by_i1_.assign(n, 0);
  by_i2_.assign(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    const double by_ratio = of.ratio[static_cast<Index>(j)];
    if (columns_.i1[j] > 0) by_i1_[j] = by_ratio / columns_.i1[j];
    by_i2_[j] = (of.i2[static_cast<Index>(j)] - by_ratio) / columns_.i2[j];
  }
  scene_.modulus(reduced_, by_i1_, by_i2_, result.storage, result.loss);
  // I1 is linear in E and I2 a square
  result.missed = std::fabs(result.storage.sum() + result.loss.sum() - (2 * of.i2 - of.ratio).sum());
  // the error of its slopes is that of those over the rows
  const auto* const series = number_ > 0 ? std::get_if<PronySeries>(&scene_.rubber) : nullptr;
  SeriesGradient terms;
  if (series) terms = series_gradient(*series, reduced_, by_i1_, by_i2_);
  if (shift.macro_wavenumber > 0) {
    const double by_modulus = 2 * of.scale * shift.pressure;  // d mu / d ln |E|
    const double w = point.velocity * point.a_T * shift.macro_wavenumber;
    const std::complex<double> e = modulus(scene_.rubber, w);
    const double square = std::norm(e);
    scene_.modulus.add_at(w, by_modulus * e.real() * e.real() / square, by_modulus * e.imag() * e.imag() / square,
                          result.storage, result.loss);
    constexpr double step = 1e-5;
    const auto size = [&](double at) { return std::abs(modulus(scene_.rubber, at)); };
    const double lower = known_ ? std::fmax(w * (1 - step), known_->lowest) : w * (1 - step),
                 upper = known_ ? std::fmin(w * (1 + step), known_->highest) : w * (1 + step);
    result.by_a_T += by_modulus * std::log(size(upper) / size(lower)) / std::log(upper / lower);
    if (series) {
      terms.equilibrium_modulus += by_modulus * series->equilibrium_modulus() * e.real() / square;
      for (std::size_t k = 0; k < series->moduli().size(); ++k) {
        const std::complex<double> x(0, w * series->relaxation_times()[k]), part = x / (1.0 + x);
        const double modulus = series->moduli()[k];
        terms.moduli[static_cast<Index>(k)] += by_modulus * modulus * (std::conj(e) * part).real() / square;
        terms.relaxation_times[static_cast<Index>(k)] +=
            by_modulus * modulus * (std::conj(e) * part / (1.0 + x)).real() / square;
      }
    }
  }
  if (!series) return;
  result.arguments.push_back(VectorXd::Constant(1, terms.equilibrium_modulus));
  result.arguments.push_back(std::move(terms.moduli));
  result.arguments.push_back(std::move(terms.relaxation_times));
}

}  // namespace asperity
