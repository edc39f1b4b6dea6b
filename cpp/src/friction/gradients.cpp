// The points of a call, on two levels of nodes each (friction/gradient_level.hpp): what the finer one changes is the
// error.
#include "asperity/gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "contact/theory/partial_contact_rule.hpp"
#include "friction/gradient_level.hpp"
#include "friction/scan_friction.hpp"
#include "numerics/parallel_for.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double rows_per_unit = 2;  // of ln q, of a law

std::vector<double> rows_of(const Spectrum& spectrum) {
  if (const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum)) return table->wavenumber();
  const auto& law = std::get<SelfAffineSpectrum>(spectrum);
  std::vector<double> ends{law.q0};
  if (law.rolloff) ends.push_back(*law.rolloff);
  ends.push_back(law.q1);
  std::vector<double> result{law.q0};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double ratio = ends[i + 1] / ends[i], n = std::ceil(rows_per_unit * std::log(ratio));
    for (double k = 1; k <= n; ++k) result.push_back(k == n ? ends[i + 1] : ends[i] * std::pow(ratio, k / n));
  }
  return result;
}

/// Weights of the trapezoid rule over the logarithm of rows.
VectorXd weights_of(const std::vector<double>& rows) {
  VectorXd result = VectorXd::Zero(static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const double half = std::log(rows[k + 1] / rows[k]) / 2;
    result[static_cast<Index>(k)] += half;
    result[static_cast<Index>(k) + 1] += half;
  }
  return result;
}

ShiftGradient shift_gradient(const GradientScene& scene, const GradientPoint& point) {
  const auto shift = [&](const Spectrum& spectrum, double pressure) {
    return affine_shift(scene.model.correction, spectrum, scene.rubber, pressure, point.velocity * point.a_T,
                        scene.model.poisson_ratio)
        .p;
  };
  ShiftGradient result;
  result.p = shift(scene.spectrum, point.pressure);
  const std::optional<double> macro = asperity_wavenumber(scene.model.correction, scene.spectrum);
  if (!macro || !std::isfinite(result.p)) return result;
  result.macro_wavenumber = *macro;
  constexpr double step = 1e-5;
  const auto slope = [](double less, double more) { return std::log(more / less) / (2 * step); };
  result.pressure =
      slope(shift(scene.spectrum, point.pressure * (1 - step)), shift(scene.spectrum, point.pressure * (1 + step)));
  const auto higher = [&](double factor) { return scaled(scene.spectrum, factor * factor); };
  result.rms_height = slope(shift(higher(1 - step), point.pressure), shift(higher(1 + step), point.pressure));
  if (const auto* const law = std::get_if<SelfAffineSpectrum>(&scene.spectrum))
    for (std::size_t k = 0; k < law_arguments(*law).size(); ++k)
      result.law.push_back(slope(shift(changed_law(*law, k, 1 - step), point.pressure),
                                 shift(changed_law(*law, k, 1 + step), point.pressure)));
  return result;
}

/// How far two levels are apart at most, of a density in its integral, from which all other slopes follow.
double apart(const PointGradient& a, const PointGradient& b) {
  double most = std::fmax(b.missed, std::fmax(std::fabs(a.pressure - b.pressure), std::fabs(a.velocity - b.velocity)));
  for (const auto density : {&PointGradient::spectrum, &PointGradient::storage, &PointGradient::loss})
    most = std::fmax(most, (a.*density - b.*density).cwiseAbs().sum());
  return most;
}

void check(const Spectrum& spectrum, const ContactModel& model, const std::optional<Adhesion>& adhesion,
           std::span<const double> pressure, std::span<const double> velocity, unsigned threads) {
  check_contact(model, pressure, velocity);
  validate(spectrum);
  if (adhesion) validate(*adhesion);
  if (threads == 0) throw InvalidInput(argument("threads") + " = " + word("0") + must_be() + "1 or more");
  check_gauss(model.method, "with gradients, which GSL's methods do not give");
  refuse_directions(spectrum, "gradient");
  if (model.strain_factors)
    throw InvalidInput(argument("strain_factors") + " = " + word("StrainFactors") + must_be() +
                       "None with gradients, which do not know how the strain follows the roughness");
}

/// `point_of` has the pressure, velocity and a_T of each point.
template <class PointOf>
Gradients solve(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                const std::optional<Adhesion>& adhesion, std::size_t size, PointOf point_of, unsigned threads) {
  const SurfaceSegments surface(spectrum);
  const auto [q0, q1] = band(spectrum);
  double slowest = HUGE_VAL, fastest = 0;
  bool with_temperature = false;
  for (std::size_t i = 0; i < size; ++i) {
    const GradientPoint point = point_of(i);
    slowest = std::fmin(slowest, point.velocity * point.a_T);
    fastest = std::fmax(fastest, point.velocity * point.a_T);
    with_temperature |= point.shift_rate.has_value();
  }
  const bool edges = std::holds_alternative<PartialContact>(model.correction);
  const std::vector<double> rows = rows_of(spectrum);
  const ModulusGradient modulus(rubber, slowest * q0, fastest * q1 * (edges ? partial_contact::tail_end : 1));
  GradientScene scene{spectrum, rubber, model, adhesion, surface.get(), rows, modulus, {}, {}};
  if (const auto* const law = std::get_if<SelfAffineSpectrum>(&spectrum)) scene.names = law_arguments(*law);
  scene.counts.assign(scene.names.size(), 1);
  const auto add = [&](const char* name, std::size_t count) {
    scene.names.emplace_back(name);
    scene.counts.push_back(count);
  };
  if (const auto* const series = std::get_if<PronySeries>(&rubber)) {
    add("equilibrium_modulus", 1);
    add("moduli", series->moduli().size());
    add("relaxation_times", series->moduli().size());
  }
  if (adhesion)
    for (const char* const name : {"shear_stress", "reference_velocity", "width"}) add(name, 1);

  Gradients g;
  g.wavenumber = rows;
  g.angular_frequency = modulus.angular_frequency();
  const std::size_t n = rows.size(), m = g.angular_frequency.size();
  g.spectrum.assign(size * n, 0);
  for (auto* const density : {&g.storage, &g.loss}) density->assign(size * m, 0);
  for (auto* const column : {&g.pressure, &g.velocity, &g.error_estimate}) column->assign(size, 0);
  if (with_temperature) g.temperature.assign(size, 0);
  for (std::size_t k = 0; k < scene.names.size(); ++k)
    g.arguments.push_back({scene.names[k], scene.counts[k], std::vector<double>(size * scene.counts[k], 0)});
  const VectorXd of_rows = weights_of(rows), of_modulus = weights_of(g.angular_frequency);

  constexpr std::size_t block = 20;
  const auto workers = static_cast<unsigned>(std::clamp<std::size_t>(size / block, 1, threads));
  std::vector<std::deque<GradientLevel>> levels(workers);
  in_blocks(workers, size, workers == 1 ? size : block, [&](unsigned worker, std::size_t begin, std::size_t end) {
    if (levels[worker].empty())
      for (const auto number : {std::size_t{0}, std::size_t{1}}) levels[worker].emplace_back(scene, number);
    for (std::size_t i = begin; i < end; ++i) {
      heed();
      const GradientPoint point = point_of(i);
      const ShiftGradient shift = shift_gradient(scene, point);
      if (!std::isfinite(shift.p)) continue;  // without contact
      at_point(point.pressure, point.velocity, [&] {
        const PointGradient coarse = levels[worker][0](point, shift), fine = levels[worker][1](point, shift);
        VectorXd::Map(&g.spectrum[i * n], static_cast<Index>(n)) = fine.spectrum.cwiseQuotient(of_rows);
        VectorXd::Map(&g.storage[i * m], static_cast<Index>(m)) = fine.storage.cwiseQuotient(of_modulus);
        VectorXd::Map(&g.loss[i * m], static_cast<Index>(m)) = fine.loss.cwiseQuotient(of_modulus);
        g.pressure[i] = fine.pressure;
        g.velocity[i] = fine.velocity;
        if (point.shift_rate) g.temperature[i] = fine.by_a_T * *point.shift_rate;
        for (std::size_t k = 0; k < g.arguments.size(); ++k)
          std::ranges::copy(fine.arguments[k], &g.arguments[k].values[i * g.arguments[k].count]);
        g.error_estimate[i] = apart(coarse, fine);
      });
    }
  });
  return g;
}

std::vector<double> times(std::span<const double> values, double log_factor) {
  std::vector<double> result(values.begin(), values.end());
  for (double& one : result) one *= std::exp(log_factor);
  return result;
}

/// All vectors that have numbers of points, and how many of each.
template <class Visit>
void visit_slopes(Gradients& g, Visit visit) {
  for (auto* const row :
       {&g.spectrum, &g.storage, &g.loss, &g.pressure, &g.velocity, &g.temperature, &g.error_estimate})
    visit(*row);
  for (Gradients::OfArgument& one : g.arguments) visit(one.values);
}

/// The contacts of a scan have the slopes of PartialContact's mu_H and A times their ratios, but for those over p, v
/// and T, which are differences of what was interpolated. `friction_at` is `friction` with the logarithms of p and v
/// and T moved, `without` the slopes of mu_H alone.
template <class FrictionAt>
void take_scan(const Friction& rule, Gradients& without, Gradients& g, FrictionAt friction_at) {
  const Friction scan = friction_at(0, 0, 0);
  const std::size_t points = scan.mu.size();
  std::vector<std::vector<double>*> of_hysteresis;
  visit_slopes(without, [&](std::vector<double>& row) { of_hysteresis.push_back(&row); });
  std::size_t index = 0;
  visit_slopes(g, [&](std::vector<double>& row) {
    const bool of_both = index < of_hysteresis.size();  // the numbers of the adhesion stand last
    const std::size_t n = points == 0 ? 0 : row.size() / points;
    for (std::size_t i = 0; i < points; ++i) {
      const double by_mu = rule.hysteresis[i] > 0 ? scan.hysteresis[i] / rule.hysteresis[i] : 1,
                   by_area = scan.contact_area[i] / rule.contact_area[i];
      for (std::size_t k = i * n; k < (i + 1) * n; ++k) {
        const double hysteresis = of_both ? (*of_hysteresis[index])[k] : 0;
        row[k] = by_mu * hysteresis + by_area * (row[k] - hysteresis);
      }
    }
    ++index;
  });
  const auto slope = [&](double step, const Friction& less, const Friction& more, std::vector<double>& row) {
    for (std::size_t i = 0; i < points; ++i) row[i] = (more.mu[i] - less.mu[i]) / (2 * step);
  };
  constexpr double in_pressure = 0.1, in_velocity = 1e-3, in_temperature = 0.01;
  slope(in_pressure, friction_at(-in_pressure, 0, 0), friction_at(in_pressure, 0, 0), g.pressure);
  slope(in_velocity, friction_at(0, -in_velocity, 0), friction_at(0, in_velocity, 0), g.velocity);
  if (!g.temperature.empty())
    slope(in_temperature, friction_at(0, 0, -in_temperature), friction_at(0, 0, in_temperature), g.temperature);
}

}  // namespace

Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                    const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                    std::span<const double> velocity, unsigned threads) {
  check(spectrum, model, adhesion, pressure, velocity, threads);
  check_frequencies(spectrum, rubber, velocity);
  const ScanFriction scan(spectrum, rubber, model);
  const auto of = [&](const std::optional<Adhesion>& with) {
    const auto point = [&](std::size_t i) { return GradientPoint{pressure[i], velocity[i]}; };
    return solve(scan.spectrum(), rubber, scan.model(), with, pressure.size(), point, threads);
  };
  Gradients g = of(adhesion);
  if (!scan.of_scan()) return g;
  Gradients without = of(std::nullopt);
  const auto friction_at = [&](double log_p, double log_v, double) {
    return friction(spectrum, rubber, model, adhesion, times(pressure, log_p), times(velocity, log_v), false, threads);
  };
  take_scan(friction(scan.spectrum(), rubber, scan.model(), adhesion, pressure, velocity, false, threads), without, g,
            friction_at);
  return g;
}

Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                    const ContactModel& model, const std::optional<Adhesion>& adhesion,
                    std::span<const double> pressure, std::span<const double> velocity,
                    std::span<const double> temperature, unsigned threads) {
  check(spectrum, model, adhesion, pressure, velocity, threads);
  require_same_size("temperature", temperature.size(), "velocity", velocity.size());
  std::vector<ShiftValue> at;
  for (const double one : temperature) at.push_back(shift_at(shift, one));
  const auto a_T = [&](std::size_t i) { return std::pow(10, at[i].log10_a_T); };
  for (std::size_t i = 0; i < velocity.size(); ++i)
    at_temperature(temperature[i], [&] { check_frequencies(spectrum, rubber, std::array{velocity[i] * a_T(i)}); });
  const ScanFriction scan(spectrum, rubber, model);
  const auto of = [&](const std::optional<Adhesion>& with) {
    const auto point = [&](std::size_t i) {
      return GradientPoint{pressure[i], velocity[i], a_T(i), at[i].slope * std::numbers::ln10};
    };
    return solve(scan.spectrum(), rubber, scan.model(), with, pressure.size(), point, threads);
  };
  Gradients g = of(adhesion);
  if (!scan.of_scan()) return g;
  Gradients without = of(std::nullopt);
  const auto friction_at = [&](double log_p, double log_v, double more) {
    std::vector<double> moved(temperature.begin(), temperature.end());
    for (double& one : moved) one += more;
    return friction(spectrum, rubber, shift, model, adhesion, times(pressure, log_p), times(velocity, log_v), moved,
                    false, threads);
  };
  take_scan(
      friction(scan.spectrum(), rubber, shift, scan.model(), adhesion, pressure, velocity, temperature, false, threads),
      without, g, friction_at);
  return g;
}

}  // namespace asperity
