// Real contact area A / A0 = P(G) at every magnification, mean contact pressure sigma0 A0 / A (Eq. 1), the correction
// factor of Section 6.1 and the distribution of pressure in contact (Eqs 2-7). G itself comes from contact/solver.
// B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "asperity/contact.hpp"
#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/correction.hpp"
#include "contact/model_error.hpp"
#include "contact/scan_ratio.hpp"
#include "contact/solver/solver.hpp"
#include "contact/validity.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

std::vector<double> wavenumbers_or_end(const Spectrum& spectrum, std::span<const double> wavenumber) {
  const auto [q0, q1] = band(spectrum);
  if (wavenumber.empty()) return {q1};
  for (const double q : wavenumber) {
    require_positive("wavenumber", q);
    if (q >= q0 && q <= q1) continue;
    const ShownRange known(q0, q1);
    throw OutOfRange(argument("wavenumber") + " = " + known.value(q) + ": the spectrum's band is " + known.text() +
                     " 1/m");
  }
  return {wavenumber.begin(), wavenumber.end()};
}

/// The surface as far as the highest of the wavenumbers: the rest has no part in G there. With a rule of its own all of
/// it, with the one kappa of the whole band: G grows with q, so the area never rises with magnification; with the kappa
/// of the surface cut at each wavenumber it did, by up to 6 % from ring to ring (docs/explanation/partial_contact.md
/// compares both with exact contacts).
std::vector<Segment> surface_up_to(const ContactModel& model, const Spectrum& spectrum,
                                   std::span<const double> wavenumber) {
  std::vector<Segment> surface = segments(spectrum);
  if (has_own_rule(model.correction)) return surface;
  const double highest = std::ranges::max(wavenumber);
  while (surface.size() > 1 && surface.back().a >= highest) surface.pop_back();
  Segment& last = surface.back();
  if (last.a < highest && highest < last.b) {
    last.at_b = last.density(highest);
    last.b = highest;
  }
  return surface;
}

/// Calls visit(index of point, index of wavenumber, solver, shift) for every combination; where there is no contact at
/// all the solver has nothing of the point.
template <class Visit>
void visit_points(const Spectrum& spectrum, std::span<const Segment> surface, const Rubber& rubber,
                  const ContactModel& model, std::span<const double> pressure, std::span<const double> velocity,
                  std::span<const double> wavenumber, bool parts, Visit visit) {
  check_contact(model, pressure, velocity);
  check_frequencies(spectrum, rubber, velocity);
  Solver solver(spectrum, surface, rubber, model, {.hysteresis = false, .parts = parts});
  for (const std::size_t i : by_velocity(velocity)) {
    heed();
    const Shift shift = affine_shift(model.correction, spectrum, rubber, pressure[i], velocity[i], model.poisson_ratio);
    at_point(pressure[i], velocity[i], [&] {
      if (shift.state != ContactState::no_contact) solver.solve(pressure[i], velocity[i], shift.p);
      for (std::size_t j = 0; j < wavenumber.size(); ++j) {
        heed_at(j);
        visit(i, j, solver, shift);
      }
    });
  }
}

/// The G with which Eq. 7 has the area at one of the wavenumbers, and that area, of points that touch.
class Areas {
 public:
  Areas(const Spectrum& spectrum, const ContactModel& model, std::span<const Segment> surface,
        std::span<const double> wavenumber)
      : model_(model), own_rule_(has_own_rule(model.correction)), q1_(band(spectrum)[1]), wavenumber_(wavenumber) {
    for (const double q : wavenumber) {
      heed();
      if (!own_rule_) by_s_.emplace_back(model, spectrum, surface, q);
    }
  }
  double g(const Solver& solver, std::size_t j) {
    const double g = solver.g(wavenumber_[j]);
    return own_rule_ ? solver.kappa() * g : by_s_[j](g);
  }
  double operator()(const Solver& solver, std::size_t j) {
    return own_rule_ && wavenumber_[j] == q1_ ? solver.partial_area() : contact_share(g(solver, j), model_.form);
  }
  /// Whether G is asked for inside the band.
  [[nodiscard]] bool parts() const {
    return std::ranges::any_of(wavenumber_, [&](double q) { return q != q1_; });
  }

 private:
  const ContactModel& model_;
  bool own_rule_;
  double q1_;
  std::span<const double> wavenumber_;
  std::vector<AreaG> by_s_;
};

/// By the contacts of a scan, filtered at each wavenumber.
std::vector<double> scan_area(const ScanContact& scan, const Spectrum& spectrum, const Rubber& rubber,
                              ContactModel model, std::span<const double> pressure, std::span<const double> velocity,
                              std::span<const double> wavenumber) {
  check_contact(model, pressure, velocity);
  model.correction = PartialContact{};
  const double q0 = band(spectrum)[0], longest = std::max(q0, known_band(scan.map()).q0);
  std::vector<double> result(pressure.size() * wavenumber.size(), 1.0);
  for (std::size_t j = 0; j < wavenumber.size(); ++j) {
    if (wavenumber[j] <= q0) continue;
    const Spectrum cut = truncated(spectrum, std::nullopt, wavenumber[j]);
    std::optional<ScanRatios> ratios;
    if (wavenumber[j] > longest) ratios.emplace(scan, cut, rubber, model);
    const std::vector<double> area =
        contact_area(ratios ? ratios->spectrum() : cut, rubber, model, pressure, velocity, {});
    const std::vector<ScanRatio> ratio =
        ratios ? (*ratios)(pressure, velocity, 1) : std::vector<ScanRatio>(pressure.size());
    for (std::size_t i = 0; i < pressure.size(); ++i) result[i * wavenumber.size() + j] = ratio[i].area * area[i];
  }
  return result;
}

const ScanContact* scan_of(const ContactModel& model) { return std::get_if<ScanContact>(&model.correction); }

void refuse_scan(const ContactModel& model, const char* what) {
  if (scan_of(model))
    throw InvalidInput(argument("correction") + " = " + word("ScanContact") + ": knows no " + what +
                       ", must be another one; validation.slide gives the pressure at every point");
}

}  // namespace

std::vector<double> contact_area(const Spectrum& given, const Rubber& rubber, const ContactModel& model,
                                 std::span<const double> pressure, std::span<const double> velocity,
                                 std::span<const double> wavenumber) {
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  const std::vector<double> q = wavenumbers_or_end(spectrum, wavenumber);
  if (const auto* const scan = scan_of(model)) return scan_area(*scan, spectrum, rubber, model, pressure, velocity, q);
  std::vector<double> result(pressure.size() * q.size());
  const std::vector<Segment> surface = surface_up_to(model, spectrum, q);
  Areas area(spectrum, model, surface, q);
  visit_points(spectrum, surface, rubber, model, pressure, velocity, q, area.parts(),
               [&](std::size_t i, std::size_t j, const Solver& solver, const Shift& shift) {
                 if (shift.state != ContactState::no_contact) result[i * q.size() + j] = area(solver, j);
               });
  return result;
}

std::vector<Diagnostic> contact_notes(const Spectrum& given, const Rubber& rubber, const ContactModel& model,
                                      std::span<const double> pressure, std::span<const double> velocity) {
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  check_contact(model, pressure, velocity);
  Notes notes(spectrum, rubber, model.correction);
  if (std::holds_alternative<NoCorrection>(model.correction) || scan_of(model)) {
    for (const double v : velocity) notes.add({}, v, {});
    return notes.texts();
  }
  const std::vector<Segment> surface = segments(spectrum);
  const double q1 = band(spectrum)[1];
  ValidityRange validity(surface, model.form, q1);
  ModelError model_error(model.correction, spectrum, rubber);
  double last = 0;
  ContactModel persson = model;  // by whose G the regimes of PartialContact are told
  if (has_own_rule(model.correction)) persson.correction = NoCorrection{};
  visit_points(spectrum, surface, rubber, persson, pressure, velocity, {&q1, 1}, false,
               [&](std::size_t i, std::size_t, const Solver& solver, const Shift& shift) {
                 ValidityFlags flags;
                 if (velocity[i] != last) model_error.start(last = velocity[i]);
                 if (shift.state != ContactState::no_contact) {
                   const double g = solver.g(q1);
                   flags = validity(g, shift.p);
                   if (!std::isnan(model_error(g))) flags.regime = model_error.regime();
                 }
                 notes.add(shift, velocity[i], flags);
               });
  return notes.texts();
}

std::vector<double> mean_pressure(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                  std::span<const double> pressure, std::span<const double> velocity,
                                  std::span<const double> wavenumber) {
  std::vector<double> result = contact_area(spectrum, rubber, model, pressure, velocity, wavenumber);
  const std::size_t columns = pressure.empty() ? 0 : result.size() / pressure.size();
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = result[i] > 0 ? pressure[i / columns] / result[i] : std::numeric_limits<double>::infinity();
  return result;
}

std::vector<double> correction_factor(const Spectrum& given, const Rubber& rubber, const ContactModel& model,
                                      std::span<const double> pressure, std::span<const double> velocity,
                                      std::span<const double> wavenumber) {
  refuse_scan(model, "correction factor");
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  const std::vector<double> q = wavenumbers_or_end(spectrum, wavenumber);
  const std::vector<Segment> surface = surface_up_to(model, spectrum, q);
  std::vector<double> result(pressure.size() * q.size());
  const bool own_rule = has_own_rule(model.correction);
  const std::optional<SFunction> s = s_in_integrand(model.correction);
  Areas area(spectrum, model, surface, q);
  visit_points(spectrum, surface, rubber, model, pressure, velocity, q, own_rule || area.parts(),
               [&](std::size_t i, std::size_t j, const Solver& solver, const Shift& shift) {
                 if (shift.state == ContactState::no_contact) return;
                 double& factor = result[i * q.size() + j];
                 if (own_rule) {
                   factor = solver.stress(q[j]);
                 } else if (s) {
                   const double share = contact_share(solver.g(q[j]), model.form);
                   factor = share * (*s)(share);
                 } else {
                   factor = area(solver, j) / (shift.p * shift.p);
                 }
               });
  return result;
}

std::vector<double> pressure_distribution(const Spectrum& given, const Rubber& rubber, const ContactModel& model,
                                          std::span<const double> stress, std::span<const double> pressure,
                                          std::span<const double> velocity, double wavenumber) {
  require_same_size("stress", stress.size(), "pressure", pressure.size());
  refuse_scan(model, "distribution of pressure");
  const AsSolved as_solved(given, model);
  const Spectrum& spectrum = as_solved.get();
  if (model.form != Form::exact)
    throw InvalidInput(argument("form") + " = " + word("interpolated") + must_be() +
                       "exact, Eq. 7 has no distribution");
  for (const double sigma : stress) require_not_negative("stress", sigma);
  const std::vector<double> q = wavenumbers_or_end(spectrum, std::span(&wavenumber, 1));
  std::vector<double> result(pressure.size());
  const auto at_g = [&](std::size_t i, double g) {
    const double x = stress[i] / pressure[i], from_nominal = (stress[i] - pressure[i]) / pressure[i];
    if (g == 0)
      throw InvalidInput(argument("wavenumber") + " = " + value(wavenumber) + must_be() +
                         "above q0, where the pressure is a delta at its nominal value");
    // exp(-(x-1)^2 / 4G) - exp(-(x+1)^2 / 4G), the difference taken out as 1 - exp(-x / G)
    const double bell = std::exp(-from_nominal * from_nominal / (4 * g)) / std::sqrt(4 * pi * g);
    result[i] = -bell * std::expm1(-x / g) / pressure[i];
  };
  const std::vector<Segment> surface = surface_up_to(model, spectrum, q);
  Areas area(spectrum, model, surface, q);
  visit_points(spectrum, surface, rubber, model, pressure, velocity, q, area.parts(),
               [&](std::size_t i, std::size_t j, const Solver& solver, const Shift& shift) {
                 if (shift.state != ContactState::no_contact) at_g(i, area.g(solver, j));
               });
  return result;
}

}  // namespace asperity
