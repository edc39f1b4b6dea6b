#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "asperity/dma.hpp"
#include "dma/time_temperature_shift.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

using std::numbers::ln10;

namespace {

/// In rising temperature; those of one temperature as one.
std::vector<Isotherm> sorted(std::span<const Isotherm> isotherms, std::vector<std::string>& notes) {
  std::vector<Isotherm> result(isotherms.begin(), isotherms.end());
  std::ranges::stable_sort(result, {}, &Isotherm::temperature);
  for (std::size_t i = 0; i + 1 < result.size();) {
    constexpr double same = 0.25;  // [K]
    if (result[i + 1].temperature() - result[i].temperature() > same) {
      ++i;
      continue;
    }
    const auto both = [&](auto member) {
      auto all = (result[i].*member)();
      const auto& other = (result[i + 1].*member)();
      all.insert(all.end(), other.begin(), other.end());
      return all;
    };
    notes.push_back("two isotherms at " + kelvin(result[i]) + " were taken as one");
    result[i] = Isotherm(result[i].temperature(), both(&Isotherm::angular_frequency), both(&Isotherm::storage_modulus),
                         both(&Isotherm::loss_modulus));
    result.erase(result.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return result;
}

/// b_T = T / T_ref.
std::vector<double> temperature_ratios(const std::vector<Isotherm>& isotherms, double reference) {
  std::vector<double> b_T;
  for (const Isotherm& i : isotherms) b_T.push_back(i.temperature() / reference);
  return b_T;
}

std::vector<double> vertical_shifts(const std::vector<Isotherm>& isotherms, const MasterCurveOptions& options) {
  if (options.vertical_shift == VerticalShift::temperature_ratio)
    return temperature_ratios(isotherms, options.reference_temperature);
  if (options.vertical_shift == VerticalShift::none) return std::vector<double>(isotherms.size(), 1.0);
  require_same_size("vertical_shift", options.b_T.size(), "isotherms", isotherms.size());
  require_each_positive("vertical_shift", options.b_T);
  return options.b_T;
}

/// Neighbours that share less than they should once shifted.
void note_overlaps(const std::vector<Isotherm>& isotherms, const std::vector<double>& log10_a_T,
                   std::vector<std::string>& notes) {
  for (std::size_t i = 1; i < isotherms.size(); ++i) {
    const auto ends = [&](std::size_t k) {
      const auto& w = isotherms[k].angular_frequency();
      return std::pair{std::log10(w.front()) + log10_a_T[k], std::log10(w.back()) + log10_a_T[k]};
    };
    const auto [a, b] = ends(i - 1);
    const auto [c, d] = ends(i);
    const double shared = std::min(b, d) - std::max(a, c);
    if (shared < least_overlap * (1 + 1e-6))
      notes.push_back("isotherms at " + kelvin(isotherms[i - 1]) + " and " + kelvin(isotherms[i]) + " overlap by " +
                      show(std::max(0.0, shared), 2) + " decades, less than " + show(least_overlap) +
                      ": the shift between them is uncertain");
  }
}

void note_undetermined(const std::vector<Isotherm>& isotherms, const std::vector<double>& deviation,
                       std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    if (deviation[i] > 0.3)
      notes.push_back("the shift at " + kelvin(isotherms[i]) +
                      " is undetermined, its moduli are too flat to tell: standard deviation " + show(deviation[i], 3) +
                      " decades");
}

/// Points that lie farther from the spline than chance would have it: beyond 6 times the median deviation.
void note_outliers(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, const MasterSpline& spline,
                   std::vector<std::string>& notes) {
  struct Miss {
    std::size_t isotherm, row;
    double storage, loss;
  };
  std::vector<Miss> misses;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    for (std::size_t k = 0; k < isotherms[i].angular_frequency().size(); ++k) {
      const Eigen::Vector2d there =
          spline.at(std::log(isotherms[i].angular_frequency()[k]) + spline.shift[static_cast<Eigen::Index>(i)]);
      misses.push_back({i, k, std::log(isotherms[i].storage_modulus()[k] / b_T[i]) - there[0],
                        std::log(isotherms[i].loss_modulus()[k] / b_T[i]) - there[1]});
      sizes.push_back(std::fabs(misses.back().storage));
      sizes.push_back(std::fabs(misses.back().loss));
    }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double limit = std::max(1.4826 * 6 * *middle, 0.02);  // 6 standard deviations, and 2 %
  const auto size = [](const Miss& m) { return std::max(std::fabs(m.storage), std::fabs(m.loss)); };
  std::erase_if(misses, [&](const Miss& m) { return size(m) <= limit; });
  if (misses.size() > 5 + sizes.size() / 100) {
    notes.push_back(std::to_string(misses.size()) + " of " + std::to_string(sizes.size() / 2) +
                    " points lie off the master curve by more than " + show(100 * std::expm1(limit), 2) +
                    " %: these isotherms do not superpose (a vertical shift may be needed, or the rubber is not "
                    "thermorheologically simple)");
    return;
  }
  for (const Miss& m : misses)
    notes.push_back("isotherm at " + kelvin(isotherms[m.isotherm]) + ": row " + std::to_string(m.row) + " at " +
                    show(isotherms[m.isotherm].angular_frequency()[m.row], 4) + " rad/s lies " +
                    show(100 * std::expm1(size(m)), 3) + " % off the master curve");
}

double residual_of(const MasterSpline& spline) {
  return std::hypot(spline.storage_residual, spline.loss_residual) / std::sqrt(2);
}

/// What the vertical shift b_T = T / T_ref would have done, where it matters; nothing where neighbours do not even meet
/// with it.
std::string compared(const std::vector<Isotherm>& isotherms, const Shifted& first, double reference) {
  const std::vector<double> ratio_b_T = temperature_ratios(isotherms, reference);
  for (std::size_t i = 1; i < isotherms.size(); ++i)
    if (!meet(isotherms[i - 1], isotherms[i], ratio_b_T[i - 1], ratio_b_T[i])) return {};
  const Shifted ratio = joint_shifts(isotherms, ratio_b_T, reference, first);
  std::vector<double> temperature;
  for (const Isotherm& i : isotherms) temperature.push_back(i.temperature());
  const double here = Steffen(temperature, first.log10_a_T)(reference);
  const double there = Steffen(temperature, ratio.log10_a_T)(reference);
  double worst = 0;
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    worst = std::max(worst, std::fabs((ratio.log10_a_T[i] - there) - (first.log10_a_T[i] - here)));
  if (!(worst > 0.1)) return {};
  return "vertical shift: none; with b_T = T / T_ref the shift factors would differ by up to " + show(worst, 2) +
         " decades, and the residual be " + show(residual_of(ratio.spline), 2) + " instead of " +
         show(residual_of(first.spline), 2);
}

std::vector<MasterPoint> reduced_points(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T,
                                        const std::vector<double>& log10_a_T) {
  std::vector<MasterPoint> points;
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    for (std::size_t k = 0; k < isotherms[i].angular_frequency().size(); ++k)
      points.push_back({isotherms[i].angular_frequency()[k] * std::pow(10, log10_a_T[i]),
                        isotherms[i].storage_modulus()[k] / b_T[i], isotherms[i].loss_modulus()[k] / b_T[i], i});
  std::ranges::stable_sort(points, {}, &MasterPoint::angular_frequency);
  return points;
}

/// The points, those within a share of a decade as their mean in the logarithm: a curve needs rising frequencies.
MasterCurve merged(const std::vector<MasterPoint>& points, std::optional<Extrapolation> extrapolation) {
  constexpr double together = 0.02;  // decades
  std::vector<double> w, storage, loss;
  for (std::size_t first = 0; first < points.size();) {
    std::size_t last = first;
    double x = 0, s = 0, l = 0;
    for (; last < points.size() &&
           points[last].angular_frequency <= points[first].angular_frequency * std::pow(10, together);
         ++last) {
      x += std::log(points[last].angular_frequency);
      s += std::log(points[last].storage_modulus);
      l += std::log(points[last].loss_modulus);
    }
    const auto n = static_cast<double>(last - first);
    w.push_back(std::exp(x / n));
    storage.push_back(std::exp(s / n));
    loss.push_back(std::exp(l / n));
    first = last;
  }
  return {std::move(w), std::move(storage), std::move(loss), extrapolation};
}

/// The spline at ten frequencies a decade; `shift` moves its frequencies to the reference.
MasterCurve smoothed(const MasterSpline& spline, double shift, std::optional<Extrapolation> extrapolation) {
  const double lower = spline.lower, upper = spline.upper();
  const int steps = std::max(2, static_cast<int>(std::ceil(10 * (upper - lower) / ln10)));
  std::vector<double> w, storage, loss;
  for (int i = 0; i <= steps; ++i) {
    const double x = lower + (upper - lower) * i / steps;
    const Eigen::Vector2d value = spline.at(x);
    w.push_back(std::exp(x + shift));
    storage.push_back(std::exp(value[0]));
    loss.push_back(std::exp(value[1]));
  }
  return {std::move(w), std::move(storage), std::move(loss), extrapolation};
}

}  // namespace

MasterCurveBuild build_master_curve(std::span<const Isotherm> given, const MasterCurveOptions& options) {
  require_positive("reference_temperature", options.reference_temperature);
  std::vector<std::string> notes;
  for (const Isotherm& isotherm : given) notes.insert(notes.end(), isotherm.notes().begin(), isotherm.notes().end());
  const std::vector<Isotherm> isotherms = sorted(given, notes);
  if (isotherms.size() < 2)
    throw InvalidInput("isotherms at " + std::to_string(isotherms.size()) +
                       " temperature(s): must be at 2 or more to shift; one isotherm is a MasterCurve as it stands");
  const std::vector<double> b_T = vertical_shifts(isotherms, options);
  std::vector<double> temperature;
  for (const Isotherm& i : isotherms) temperature.push_back(i.temperature());
  const double reference = options.reference_temperature;
  if (!options.shift_table && !(reference >= temperature.front() && reference <= temperature.back()))
    throw OutOfRange("reference_temperature = " + show(reference, 6) + ": isotherms were measured in [" +
                     show(temperature.front(), 6) + ", " + show(temperature.back(), 6) + "] K");

  std::vector<double> log10_a_T, deviation;
  MasterSpline spline;
  double to_reference = 0;  // log10 a_T of the reference, in the spline's own frequencies
  if (options.shift_table) {
    Eigen::VectorXd shift(static_cast<Eigen::Index>(isotherms.size()));
    const double at_reference = std::log10(options.shift_table->shift_factor(reference));
    for (std::size_t i = 0; i < isotherms.size(); ++i) {
      log10_a_T.push_back(std::log10(options.shift_table->shift_factor(temperature[i])) - at_reference);
      shift[static_cast<Eigen::Index>(i)] = ln10 * log10_a_T[i];
    }
    spline = master_spline_at(gather(isotherms, b_T), shift);
    deviation.assign(isotherms.size(), 0.0);
  } else {
    const Shifted shifted = joint_shifts(isotherms, b_T, reference);
    if (options.vertical_shift == VerticalShift::none)
      if (std::string note = compared(isotherms, shifted, reference); !note.empty()) notes.push_back(std::move(note));
    log10_a_T = shifted.log10_a_T;
    deviation = shifted.deviation;
    spline = shifted.spline;
    to_reference = Steffen(temperature, log10_a_T)(reference);
    for (double& a : log10_a_T) a -= to_reference;
    note_undetermined(isotherms, deviation, notes);
  }
  note_overlaps(isotherms, log10_a_T, notes);
  note_outliers(isotherms, b_T, spline, notes);
  std::vector<MasterPoint> points = reduced_points(isotherms, b_T, log10_a_T);
  const double residual = residual_of(spline);
  MasterCurve curve = options.smooth ? smoothed(spline, -ln10 * to_reference, options.extrapolation)
                                     : merged(points, options.extrapolation);
  ShiftTable shifts(reference, temperature, log10_a_T, deviation);
  curve = curve.with_shifts(std::make_shared<const ShiftTable>(shifts));
  return {std::move(curve), std::move(shifts), b_T, std::move(points), residual, std::move(notes)};
}

}  // namespace asperity
