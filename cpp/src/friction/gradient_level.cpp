// mu_H = 4 (1 - nu^2) sigma0 times the sum of parts that know G at the scale 1 / (sigma0 p_T)^2, and mu_A is in
// proportion to A / A0 / sigma0.
#include "friction/gradient_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "contact/correction.hpp"
#include "friction/before_heating.hpp"
#include "numerics/differences.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

ContactGridOptions grid_options(const GradientScene& scene, std::size_t number, const RoughnessWindow& window,
                                std::unique_ptr<const RoughnessPieces>& cut) {
  ContactGridOptions result;
  result.poisson_ratio = scene.model.poisson_ratio;
  result.level = number;
  result.tabulated = std::holds_alternative<MasterCurve>(scene.rubber);
  if (result.tabulated) result.halvings = number;
  if (has_own_rule(scene.model.correction)) result.window = &window;
  const Excitation& waves = scene.waves;
  result.about_nodes = waves.directions() != nullptr;
  const auto* const table = std::get_if<TabulatedSpectrum>(&scene.spectrum);
  if (table && table->wavenumber().size() >= RoughnessPieces::least_rows) {
    if (!waves.kinks().empty())
      cut = std::make_unique<RoughnessPieces>(scene.surface, number, waves.kinks(), harmonics_of(scene.spectrum));
    result.pieces = cut ? cut.get() : &roughness_pieces(*table, number);
    return result;
  }
  result.stops = waves.stops();
  if (result.window) result.stops.push_back(window.last_from());  // where what moves q_e begins
  return result;
}

}  // namespace

ShiftGradient shift_gradient(const GradientScene& scene, double pressure, double velocity, double rate, double along) {
  const Correction& correction = scene.model.correction;
  const std::optional<double> macro = asperity_wavenumber(correction, scene.spectrum);
  const auto shift = [&](const Correction& with, double p) {
    const double moved = macro && along != 0 ? *asperity_wavenumber(with, scene.spectrum) / *macro : 1;
    return affine_shift(with, scene.spectrum, scene.rubber, p, velocity * std::pow(moved, along),
                        scene.model.poisson_ratio)
        .p;
  };
  ShiftGradient result;
  result.p = shift(correction, pressure);
  result.velocity = velocity;
  result.rate = rate;
  if (!shifts(correction) || !std::isfinite(result.p)) return result;
  const Correction whole = with_numbers_of(scene.spectrum, correction);
  const std::vector<std::string> names = correction_arguments(whole), own = correction_arguments(correction);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto changed = [&](double factor) {  // upwards, as z_max may be that of a peak
      return std::log(shift(changed_correction(whole, k, factor), pressure) / result.p);
    };
    const double slope = (4 * changed(1 + difference_step) - changed(1 + 2 * difference_step)) / (2 * difference_step);
    if (std::ranges::find(own, names[k]) != own.end())
      result.correction.push_back(slope);
    else
      (names[k].ends_with("rms_height") ? result.rms_height : result.wavenumber) = slope;
  }
  if (!macro) return result;
  result.macro_wavenumber = *macro;
  result.along = along;
  result.pressure = slope_at_0([&](double t) { return std::log(shift(correction, pressure * (1 + t))); });
  return result;
}

void add_conditions(const GradientScene& scene, const GradientPoint& point, const ShiftGradient& shift,
                    double hysteresis, double adhesion, double by_scale, PointGradient& result) {
  result.pressure = hysteresis - adhesion - 2 * by_scale * (1 + shift.pressure);
  result.velocity = result.by_frequency;
  result.temperature = result.by_temperature;
  if (!scene.adhesion) return;
  const Adhesion& a = *scene.adhesion;
  const double decades = std::log10(point.velocity / a.reference_velocity),
               slope = -2 * a.width * decades / std::numbers::ln10;
  result.velocity += slope * adhesion;
  for (const double one : {adhesion, -slope * adhesion, -a.width * decades * decades * adhesion})
    result.arguments.push_back(VectorXd::Constant(1, one));
}

GradientLevel::GradientLevel(const GradientScene& scene, std::size_t number)
    : scene_(scene),
      window_(scene.surface),
      grid_(scene.surface, grid_options(scene, number, window_, cut_)),
      theory_(contact_theory(scene.model, scene.spectrum, scene.surface, grid_, scene.waves.directions())),
      chain_(scene, grid_),
      angular_(scene.rubber, scene.model, scene.surface, scene.waves, grid_),
      known_(known_range(scene.rubber)) {
  if (scene.harmonics > 0) angular_.take_harmonics(scene.shares, of_harmonics, scene.harmonics);
  if (std::holds_alternative<MasterCurve>(scene.rubber))
    panels_.emplace(grid_);
  else if (grid_.pieces() && grid_.size() == grid_.band_size() && scene.harmonics == 0 && !scene.model.strain_factors)
    cells_ = &grid_.pieces()->cells();
}

/// Where I1, I2 and their slopes are analytic cells take far fewer frequencies.
void GradientLevel::take_moduli(double velocity) {
  if (!cells_) return angular_(mu_.felt, panels_ ? &*panels_ : nullptr, velocity);
  AngularColumns &points = at_points_.columns, &nodes = mu_.felt.columns;
  at_points_.frequency.resize(cells_->wavenumber().size());
  std::ranges::transform(cells_->wavenumber(), at_points_.frequency.begin(), [&](double q) { return velocity * q; });
  angular_(at_points_, nullptr, velocity);
  nodes.resize(grid_.size() + RoughnessCells::excess);
  cells_->at_nodes(points.i1.data(), points.i2.data(), nodes.i1.data(), nodes.i2.data());
  cells_->at_nodes(points.slope1.data(), points.slope2.data(), nodes.slope1.data(), nodes.slope2.data());
}

PointGradient GradientLevel::operator()(const GradientPoint& point, const ShiftGradient& shift) {
  const std::size_t n = grid_.size();
  FeltModulus& felt = mu_.felt;
  felt.frequency.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    felt.frequency[j] = point.velocity * point.a_T * grid_.wavenumber()[j];
    // beyond the band the modulus keeps the value that it has at the last frequency that is known
    if (known_ && !panels_) felt.frequency[j] = std::fmin(felt.frequency[j], known_->highest);
  }
  felt.rate = VectorXd::Constant(static_cast<Index>(n), point.shift_rate.value_or(0));
  felt.along = VectorXd::Ones(static_cast<Index>(n));
  take_moduli(point.velocity * point.a_T);
  theory_->start({});
  theory_->take({{felt.columns.i1.data(), n}, {felt.columns.i2.data(), n}});
  const double root = 1 / (point.pressure * shift.p);
  theory_->evaluate(root * root, {});

  const double nu = scene_.model.poisson_ratio, by_part = 4 * (1 - nu * nu) * point.pressure * point.hysteresis;
  mu_.by_area = scene_.adhesion ? point.area * adhesion_per_share(*scene_.adhesion, point.pressure, point.velocity) : 0;
  mu_.g = theory_->g();
  theory_->gradient({VectorXd::Constant(static_cast<Index>(n), by_part), mu_.by_area, 0}, mu_.of);
  PointGradient result = chain_(mu_, shift);
  add_conditions(scene_, point, shift, by_part * theory_->part().sum(), mu_.by_area * theory_->area(), mu_.of.scale,
                 result);
  return result;
}

}  // namespace asperity
