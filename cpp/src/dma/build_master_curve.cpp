// Isotherms become one master curve: shifts fitted or given, points reduced, E(w; T) = b_T E(a_T w; T_ref) (J. D.
// Ferry, Viscoelastic Properties of Polymers, Wiley 1980, chapter 11).
#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/dma.hpp"
#include "dma/time_temperature_shift.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

/// In rising temperature; those of one temperature as one.
std::vector<Isotherm> sorted(std::span<const Isotherm> isotherms, std::vector<Diagnostic>& notes) {
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
    notes.push_back(note("isotherms-merged", "two isotherms at " + kelvin(result[i]) + " were taken as one"));
    result[i] = Isotherm(result[i].temperature(), both(&Isotherm::angular_frequency), both(&Isotherm::storage_modulus),
                         both(&Isotherm::loss_modulus));
    result.erase(result.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return result;
}

std::vector<double> vertical_shifts(const std::vector<Isotherm>& isotherms, const MasterCurveOptions& options) {
  if (options.vertical_shift == VerticalShift::temperature_ratio)
    return temperature_ratios(isotherms, options.reference_temperature);
  if (options.vertical_shift == VerticalShift::none) return std::vector<double>(isotherms.size(), 1.0);
  require_same_size("vertical_shift", options.b_T.size(), "isotherms", isotherms.size());
  require_each_positive("vertical_shift", options.b_T);
  return options.b_T;
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

void require_meeting(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T) {
  for (std::size_t i = 1; i < isotherms.size(); ++i)
    if (!meet(isotherms[i - 1], isotherms[i], b_T[i - 1], b_T[i]))
      throw InvalidInput(argument("isotherms") + " at " + kelvin(isotherms[i - 1]) + " and " + kelvin(isotherms[i]) +
                         ": have no storage modulus in common, neighbours" + must(" must ") +
                         "overlap (a smaller step of temperature, isotherms on one side of the gap alone, or a shift "
                         "table from outside)");
}

std::size_t nearest(const std::vector<double>& temperature, double reference) {
  const auto distance = [&](double t) { return std::fabs(t - reference); };
  return static_cast<std::size_t>(std::ranges::min_element(temperature, {}, distance) - temperature.begin());
}

}  // namespace

MasterCurve merged_points(const std::vector<MasterPoint>& points, std::optional<Extrapolation> extrapolation) {
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

MasterCurveBuild build_master_curve(std::span<const Isotherm> given, const MasterCurveOptions& options) {
  require_positive("reference_temperature", options.reference_temperature);
  std::vector<Diagnostic> notes;
  for (const Isotherm& isotherm : given) notes.insert(notes.end(), isotherm.notes().begin(), isotherm.notes().end());
  const std::vector<Isotherm> isotherms = sorted(given, notes);
  if (isotherms.size() < 2)
    throw InvalidInput(argument("isotherms") + " at " + count(isotherms.size()) + " temperature(s)" + must_be() +
                       "at 2 or more to shift; one isotherm is a MasterCurve as it stands");
  const std::vector<double> b_T = vertical_shifts(isotherms, options);
  std::vector<double> temperature;
  temperature.reserve(isotherms.size());
  for (const Isotherm& i : isotherms) temperature.push_back(i.temperature());
  const double reference = options.reference_temperature;
  if (!options.shift_table && !(reference >= temperature.front() && reference <= temperature.back()))
    throw OutOfRange(argument("reference_temperature") + " = " + in_kelvin(reference) +
                         ": isotherms were measured in [" + in_kelvin(temperature.front()) + ", " +
                         in_kelvin(temperature.back()) + "]" + unit("K"),
                     "unknown-shift");

  const SweepPoints points = gather(isotherms, b_T);
  const std::size_t n = isotherms.size();
  std::vector<double> log10_a_T, shift, deviation(n, 0.0),
      covariance(n * n, 0.0);  // shift: in the spline's frequencies
  MasterSpline spline;
  if (options.shift_table) {
    const double at_reference = std::log10(options.shift_table->shift_factor(reference));
    for (const double t : temperature)
      log10_a_T.push_back(std::log10(options.shift_table->shift_factor(t)) - at_reference);
    shift = log10_a_T;
    spline = master_spline_at(points, shift);
  } else {
    require_meeting(isotherms, b_T);
    const std::size_t fixed = nearest(temperature, reference);
    const Shifted shifted = joint_shifts(points, fixed);
    shift = shifted.log10_a_T;
    spline = shifted.spline;
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = shifted.covariance.row(static_cast<Eigen::Index>(i));
      std::ranges::copy(row, covariance.begin() + static_cast<std::ptrdiff_t>(i * n));
      deviation[i] = std::sqrt(covariance[i * n + i]);
    }
    if (options.vertical_shift == VerticalShift::none) note_vertical_shift(isotherms, shifted, fixed, reference, notes);
    note_misfit(points, shifted, b_T, notes);
    note_undetermined(isotherms, deviation, notes);
    note_disagreement(isotherms, moduli_apart(points, fixed, shifted, undetermined_shift), fixed, notes);
    log10_a_T = shift;
    const double at_reference = Steffen(temperature, shift)(reference);
    for (double& a : log10_a_T) a -= at_reference;
  }
  note_overlaps(isotherms, log10_a_T, notes);
  note_outliers(isotherms, b_T, spline, shift, notes);
  std::vector<MasterPoint> reduced = reduced_points(isotherms, b_T, log10_a_T);
  const double residual = residual_of(spline);
  MasterCurve curve = options.smooth ? spline.sampled(log10_a_T[0] - shift[0], options.extrapolation)
                                     : merged_points(reduced, options.extrapolation);
  try {  // nobody asks for the series, only whether E' and E'' can be of one material
    const std::vector<Diagnostic> contradictions =
        fit_prony(curve.angular_frequency(), curve.storage_modulus(), curve.loss_modulus(), {}).notes;
    notes.insert(notes.end(), contradictions.begin(), contradictions.end());
  } catch (const Error&) {
    // rows without a series contradict nothing
  }
  ShiftTable shifts(reference, temperature, log10_a_T, deviation);
  curve = curve.with_shifts(std::make_shared<const ShiftTable>(shifts));
  return {std::move(curve),      std::move(shifts), b_T, std::move(reduced), residual,
          std::move(covariance), std::move(notes)};
}

}  // namespace asperity
