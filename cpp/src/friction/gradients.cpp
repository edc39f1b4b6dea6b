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
#include "friction/before_heating.hpp"
#include "friction/gradient_level.hpp"
#include "friction/hot_gradient.hpp"
#include "friction/scan_friction.hpp"
#include "numerics/parallel_for.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double rows_per_unit = 2;  // of ln q, of a law
/// Two levels may agree by chance: by the change alone one slope in a thousand was above its estimate, most of them by
/// less than 1e-4 of mu (tests/stability/random_gradients.py).
constexpr double of_change = 2, least_error = 2e-4;

/// A spectrum as it is asked for: a law, or the rows of a table.
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

/// The largest sum over rows that follow each other.
double most_in_a_row(const VectorXd& values) {
  double sum = 0, highest = 0, lowest = 0;
  for (const double value : values) {
    sum += value;
    highest = std::fmax(highest, sum);
    lowest = std::fmin(lowest, sum);
  }
  return highest - lowest;
}

/// How far two levels are apart at most, of a density in its integral over any range.
double apart(const PointGradient& a, const PointGradient& b) {
  double most = std::fmax(b.missed, std::fmax(std::fabs(a.pressure - b.pressure), std::fabs(a.velocity - b.velocity)));
  for (const auto density : {&PointGradient::spectrum, &PointGradient::storage, &PointGradient::loss})
    most = std::fmax(most, most_in_a_row(a.*density - b.*density));
  for (std::size_t k = 0; k < a.arguments.size(); ++k)
    most = std::fmax(most, (a.arguments[k] - b.arguments[k]).lpNorm<Eigen::Infinity>());
  return most;
}

void check(const Spectrum& spectrum, const ContactModel& model, const std::optional<Adhesion>& adhesion,
           std::span<const double> pressure, std::span<const double> velocity, unsigned threads) {
  check_points(model, adhesion, pressure, velocity, threads);
  validate(spectrum);
  check_gauss(model.method, "with gradients, which GSL's methods do not give");
}

/// The results of all points.
class Table {
 public:
  Table(const Spectrum& given, const Rubber& rubber, const ContactModel& model, const std::optional<Adhesion>& adhesion,
        double slowest, double fastest)
      : solved_(given, model),
        surface_(solved_.get()),
        rows_(rows_of(given)),
        lowest_(slowest * band(given)[0]),
        highest_(fastest * band(given)[1] * (has_own_rule(model.correction) ? partial_contact::tail_end : 1)),
        waves_(rubber, model, surface_.get(), harmonics_of(solved_.get())),
        harmonics_(waves_.directions() ? std::max<std::size_t>(waves_.needed(felt(), of_harmonics).count, 1) : 0),
        modulus_(rubber, lowest_, highest_, harmonics_),
        scene_{solved_.get(),
               std::get_if<SelfAffineSpectrum>(&given),
               rubber,
               model,
               adhesion,
               surface_.get(),
               waves_,
               harmonics_,
               waves_.shares(felt()),
               rows_,
               modulus_,
               terms_},
        of_rows_(weights_of(rows_)),
        of_modulus_(weights_of(modulus_.rows())) {
    if (scene_.law) add(law_arguments(*scene_.law));
    if (scene_.law && harmonics_ > 0) scene_.of_top = slopes_of_top(*scene_.law);
    if (harmonics_ > 0) add({"direction"});
    if (const auto* const series = std::get_if<PronySeries>(&rubber)) {
      terms_.emplace(*series, modulus_.nodes());
      add({"equilibrium_modulus"});
      add({"moduli", "relaxation_times"}, series->moduli().size());
    }
    if (model.strain_factors) {
      add({"strain_per_slope"});
      add({"storage_factors", "loss_factors"}, model.strain_factors->strain().size());
    }
    add({"poisson_ratio"});
    add(correction_arguments(model.correction));
    if (adhesion) add({"shear_stress", "reference_velocity", "width"});
  }

  [[nodiscard]] const GradientScene& scene() const { return scene_; }
  void add(const std::vector<std::string>& names, std::size_t count = 1) {
    for (const std::string& name : names) g_.arguments.push_back({name, count, {}});
  }
  void begin(std::size_t size, bool with_temperature) {
    g_.wavenumber = rows_;
    g_.angular_frequency = modulus_.rows();
    g_.spectrum.assign(size * rows_.size(), 0);
    for (auto* const density : {&g_.storage, &g_.loss}) density->assign(size * g_.angular_frequency.size(), 0);
    for (auto* const column : {&g_.pressure, &g_.velocity, &g_.error_estimate}) column->assign(size, 0);
    if (with_temperature) g_.temperature.assign(size, 0);
    for (Gradients::OfArgument& one : g_.arguments) one.values.assign(size * one.count, 0);
  }
  void put(std::size_t i, const PointGradient& coarse, const PointGradient& fine) {
    const auto density = [&](const VectorXd& of, const VectorXd& weights, std::vector<double>& to) {
      const auto n = static_cast<std::size_t>(weights.size());
      VectorXd::Map(to.data() + i * n, weights.size()) = of.cwiseQuotient(weights);
    };
    density(fine.spectrum, of_rows_, g_.spectrum);
    density(fine.storage, of_modulus_, g_.storage);
    density(fine.loss, of_modulus_, g_.loss);
    g_.pressure[i] = fine.pressure;
    g_.velocity[i] = fine.velocity;
    if (!g_.temperature.empty()) g_.temperature[i] = fine.temperature;
    for (std::size_t k = 0; k < g_.arguments.size(); ++k)
      std::ranges::copy(fine.arguments[k], g_.arguments[k].values.data() + i * g_.arguments[k].count);
    const double whole = fine.spectrum.cwiseAbs().sum() + fine.loss.cwiseAbs().sum();
    g_.error_estimate[i] = of_change * apart(coarse, fine) + least_error * whole;
  }
  [[nodiscard]] Gradients take() { return std::move(g_); }

 private:
  /// Frequencies that the rubber knows.
  [[nodiscard]] FrequencyRange felt() const {
    const std::optional<FrequencyRange> known = known_range(waves_.rubber());
    const auto held = [&](double w) { return known ? std::clamp(w, known->lowest, known->highest) : w; };
    return {held(lowest_), held(highest_)};
  }

  AsSolved solved_;
  SurfaceSegments surface_;
  std::vector<double> rows_;
  double lowest_, highest_;  // [rad/s]
  Excitation waves_;
  std::size_t harmonics_;
  ModulusGradient modulus_;
  std::optional<SeriesSlopes> terms_;
  GradientScene scene_;
  VectorXd of_rows_, of_modulus_;
  Gradients g_;
};

/// `point_of` has the pressure, velocity and a_T of each point.
template <class PointOf>
Gradients solve(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                const std::optional<Adhesion>& adhesion, std::size_t size, PointOf point_of, unsigned threads) {
  double slowest = HUGE_VAL, fastest = 0;
  bool with_temperature = false;
  for (std::size_t i = 0; i < size; ++i) {
    const GradientPoint point = point_of(i);
    slowest = std::fmin(slowest, point.velocity * point.a_T);
    fastest = std::fmax(fastest, point.velocity * point.a_T);
    with_temperature |= point.shift_rate.has_value();
  }
  Table table(spectrum, rubber, model, adhesion, slowest, fastest);
  table.begin(size, with_temperature);
  const unsigned workers = workers_for(size, threads);
  std::vector<std::deque<GradientLevel>> levels(workers);
  in_blocks(
      workers, size, workers == 1 ? size : points_a_block, [&](unsigned worker, std::size_t begin, std::size_t end) {
        if (levels[worker].empty())
          for (const auto number : {std::size_t{0}, std::size_t{1}}) levels[worker].emplace_back(table.scene(), number);
        for (std::size_t i = begin; i < end; ++i) {
          heed();
          const GradientPoint point = point_of(i);
          const ShiftGradient shift =
              shift_gradient(table.scene(), point.pressure, point.velocity * point.a_T, point.shift_rate.value_or(0));
          if (!std::isfinite(shift.p)) continue;  // without contact
          at_point(point.pressure, point.velocity,
                   [&] { table.put(i, levels[worker][0](point, shift), levels[worker][1](point, shift)); });
        }
      });
  return table.take();
}

std::vector<double> times(std::span<const double> values, double log_factor) {
  std::vector<double> result(values.begin(), values.end());
  for (double& one : result) one *= std::exp(log_factor);
  return result;
}

/// By which p and v move in the logarithm, and T [K], to tell the slopes of a scan.
struct Steps {
  double pressure, velocity, temperature;
};
constexpr Steps between_contacts{0.1, 1e-3, 0.01}, of_contacts{0.1, 0.1, 1};

/// Slopes over p, v and T of what was interpolated, or with heat of contacts that are solved there: `friction_at` is
/// `friction` with them moved.
template <class FrictionAt>
void take_differences(Gradients& g, FrictionAt friction_at, const Steps& steps) {
  const auto slope = [&](double step, const Friction& less, const Friction& more, std::vector<double>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = (more.mu[i] - less.mu[i]) / (2 * step);
  };
  const auto& [p, v, t] = steps;
  slope(p, friction_at(-p, 0, 0), friction_at(p, 0, 0), g.pressure);
  slope(v, friction_at(0, -v, 0), friction_at(0, v, 0), g.velocity);
  if (!g.temperature.empty()) slope(t, friction_at(0, 0, -t), friction_at(0, 0, t), g.temperature);
}

/// Of points of one temperature each. The contacts of a scan have the slopes of PartialContact's mu_H and A times their
/// ratios, but for those over p, v and T. `friction_of` is `friction` of a surface and a model with these moved.
template <class PointOf, class FrictionOf>
Gradients solve_or_scan(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                        const std::optional<Adhesion>& adhesion, std::size_t points, PointOf point_of,
                        FrictionOf friction_of, unsigned threads) {
  const ScanFriction engine(spectrum, rubber, model);
  if (!engine.of_scan()) return solve(spectrum, rubber, model, adhesion, points, point_of, threads);
  const Friction rule = friction_of(engine.spectrum(), engine.model(), 0, 0, 0),
                 scan = friction_of(spectrum, model, 0, 0, 0);
  const auto with_ratios = [&](std::size_t i) {
    GradientPoint point = point_of(i);
    if (rule.hysteresis[i] > 0) point.hysteresis = scan.hysteresis[i] / rule.hysteresis[i];
    point.area = scan.contact_area[i] / rule.contact_area[i];
    return point;
  };
  Gradients g = solve(engine.spectrum(), rubber, engine.model(), adhesion, points, with_ratios, threads);
  take_differences(
      g, [&](double p, double v, double t) { return friction_of(spectrum, model, p, v, t); }, between_contacts);
  return g;
}

std::vector<double> plus(std::span<const double> values, double more) {
  std::vector<double> result(values.begin(), values.end());
  for (double& one : result) one += more;
  return result;
}

}  // namespace

Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                    const std::optional<Adhesion>& adhesion, std::span<const double> pressure,
                    std::span<const double> velocity, unsigned threads) {
  check(spectrum, model, adhesion, pressure, velocity, threads);
  check_frequencies(spectrum, rubber, velocity);
  return solve_or_scan(
      spectrum, rubber, model, adhesion, pressure.size(),
      [&](std::size_t i) {
        return GradientPoint{pressure[i], velocity[i]};
      },
      [&](const Spectrum& road, const ContactModel& contact, double log_p, double log_v, double) {
        return friction(road, rubber, contact, adhesion, times(pressure, log_p), times(velocity, log_v), false,
                        threads);
      },
      threads);
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
  return solve_or_scan(
      spectrum, rubber, model, adhesion, pressure.size(),
      [&](std::size_t i) {
        return GradientPoint{pressure[i], velocity[i], a_T(i), at[i].slope * std::numbers::ln10};
      },
      [&](const Spectrum& road, const ContactModel& contact, double log_p, double log_v, double more) {
        return friction(road, rubber, shift, contact, adhesion, times(pressure, log_p), times(velocity, log_v),
                        plus(temperature, more), false, threads);
      },
      threads);
}

Gradients gradients(const Spectrum& spectrum, const Rubber& rubber, const TemperatureShift& shift,
                    const Heating& heating, const ContactModel& model, const std::optional<Adhesion>& adhesion,
                    std::span<const double> pressure, std::span<const double> velocity,
                    std::span<const double> temperature, Branch branch, unsigned threads) {
  check(spectrum, model, adhesion, pressure, velocity, threads);
  require_same_size("temperature", temperature.size(), "velocity", velocity.size());
  check_heating(heating, shift, adhesion);
  const ScanFriction scan(spectrum, rubber, model);
  const auto friction_of = [&](const Spectrum& road, const ContactModel& contact, double log_p, double log_v,
                               double more) {
    return friction(road, rubber, shift, heating, contact, adhesion, times(pressure, log_p), times(velocity, log_v),
                    plus(temperature, more), branch, false, threads)
        .hot;
  };
  if (scan.of_scan()) {  // mu of its rule has the slopes, times the ratio of both; T(q) is that of the rule
    Gradients g = gradients(scan.spectrum(), rubber, shift, heating, scan.model(), adhesion, pressure, velocity,
                            temperature, branch, threads);
    const auto scan_at = [&](double log_p, double log_v, double more) {
      return friction_of(spectrum, model, log_p, log_v, more);
    };
    const Friction of_scan = scan_at(0, 0, 0), rule = friction_of(scan.spectrum(), scan.model(), 0, 0, 0);
    std::vector<std::vector<double>*> all{&g.spectrum, &g.storage, &g.loss, &g.error_estimate};
    for (Gradients::OfArgument& one : g.arguments) all.push_back(&one.values);
    for (auto* const of : all)
      for (std::size_t k = 0, n = of->size() / rule.mu.size(); k < of->size(); ++k)
        if (rule.mu[k / n] > 0) (*of)[k] *= of_scan.mu[k / n] / rule.mu[k / n];
    take_differences(g, scan_at, of_contacts);
    return g;
  }
  // the modulus is asked for at temperatures up to the hottest
  ContactModel roughly = model;
  roughly.rtol = std::fmax(model.rtol, 1e-3);
  const FlashFriction before = friction(spectrum, rubber, shift, heating, roughly, adhesion, pressure, velocity,
                                        temperature, branch, false, threads);
  double slowest = HUGE_VAL, fastest = 0;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const auto at = [&](double one) { return velocity[i] * std::pow(10, held_shift(shift, one).log10_a_T); };
    slowest = std::fmin(slowest, at(before.hot.temperature[i]));
    fastest = std::fmax(fastest, at(temperature[i]));
  }
  Table table(spectrum, rubber, model, adhesion, slowest, fastest);
  table.add(heating_arguments(heating, adhesion.has_value()));
  table.begin(velocity.size(), true);
  const Spectrum& solved = table.scene().spectrum;
  const HeatScene heat{solved, table.scene().surface, rubber, shift, heating, model, macro_wavenumber(heating, solved)};
  const std::vector<std::size_t> order = by_curve(pressure, velocity, temperature);
  const unsigned workers = workers_for(order.size(), threads);
  std::vector<std::optional<HotGradient>> solvers(workers);
  in_blocks(workers, order.size(), points_a_block, [&](unsigned worker, std::size_t begin, std::size_t end) {
    if (!solvers[worker]) solvers[worker].emplace(table.scene(), heat, branch);
    for (std::size_t k = begin; k < end; ++k) {
      heed();
      const std::size_t i = order[k];
      if (k == begin || begins(order, k, pressure, temperature)) solvers[worker]->forget();
      at_point(pressure[i], velocity[i], temperature[i], [&] {
        const auto found = (*solvers[worker])({pressure[i], velocity[i], 1, {}, temperature[i]});
        if (found) table.put(i, (*found)[0], (*found)[1]);
      });
    }
  });
  return table.take();
}

}  // namespace asperity
