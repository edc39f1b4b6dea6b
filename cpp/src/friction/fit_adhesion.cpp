// The adhesion law of Eq. 23, tau_f = tau_f0 exp(-c (log10 v / v0)^2), from measured friction: the hysteresis and the
// contact area are computed, mu - mu_H = tau_f (A / A0) / sigma0 is fitted robustly (robust_fit.hpp), and points that
// do not determine the parameters are refused.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "asperity/friction.hpp"
#include "contact/conditions.hpp"
#include "friction/robust_fit.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

using Eigen::Index;
using std::numbers::ln10;

namespace {

// Limits beyond which a parameter counts as not determined.
constexpr double uncertain_share = 0.5;  // standard error of tau_f0, and of c, over their values
constexpr double uncertain_decades = 1;  // standard error of log10 v0
constexpr double uncertain_width = 0.3;  // ... of c about a v0 that is held: a third of mu_A a decade away
constexpr double many_outliers = 0.25;   // share of the points
constexpr double large_scatter = 0.2;    // of ln mu: repeated measurements differ by less
constexpr Index few_spare = 20;          // below it robust errors are not yet those of many points
constexpr double edge_errors = 3;        // standard errors by which c may lie below 0 and be taken as 0

std::size_t count_free(const FixedAdhesion& fixed) {
  return 3U - (fixed.shear_stress ? 1U : 0U) - (fixed.reference_velocity ? 1U : 0U) - (fixed.width ? 1U : 0U);
}

void check(const FixedAdhesion& fixed) {
  if (fixed.shear_stress) require_positive("fixed: shear_stress", *fixed.shear_stress);
  if (fixed.reference_velocity) require_positive("fixed: reference_velocity", *fixed.reference_velocity);
  if (fixed.width) require_not_negative("fixed: width", *fixed.width);
  if (count_free(fixed) == 0)
    throw InvalidInput(argument("fixed") + ": " + argument("shear_stress") + ", " + argument("reference_velocity") +
                       " and " + argument("width") + must(": must leave ") + "one of them to be fitted");
  if (fixed.width && *fixed.width == 0 && !fixed.reference_velocity)
    throw InvalidInput(argument("fixed: width") + " = " + word("0") + must_be() + "positive where " +
                       argument("reference_velocity") + ", without effect then, is fitted");
}

void check(std::span<const double> velocity, std::span<const double> mu, const FixedAdhesion& fixed) {
  require_same_size("mu", mu.size(), "velocity", velocity.size());
  require_each_positive("mu", mu);
  const std::size_t free = count_free(fixed), distinct = std::set<double>(velocity.begin(), velocity.end()).size();
  if (distinct <= free)
    throw InvalidInput(
        argument("velocity") + ": different values: " + std::to_string(distinct) + must(", must be ") +
        std::to_string(free + 1) + " or more to fit " + std::to_string(free) +
        (free == 1 ? Sentence{" parameter"} : " parameters; " + advice("hold-some", "fixed = {...} holds some")));
}

/// Friction without adhesion, each pair of pressure and velocity computed once, and the entry of each point in it.
struct Contact {
  Friction friction;
  std::vector<std::size_t> entry;
};

Contact contact(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                std::span<const double> pressure, std::span<const double> velocity) {
  std::map<std::pair<double, double>, std::size_t> seen;
  std::vector<double> p, v;
  Contact result;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const auto [at, added] = seen.try_emplace({pressure[i], velocity[i]}, p.size());
    if (added) {
      p.push_back(pressure[i]);
      v.push_back(velocity[i]);
    }
    result.entry.push_back(at->second);
  }
  result.friction = friction(spectrum, rubber, model, std::nullopt, p, v);
  return result;
}

AdhesionPoints logarithms(const Contact& contact, std::span<const double> pressure, std::span<const double> velocity,
                          std::span<const double> mu, double rtol) {
  const auto n = static_cast<Index>(mu.size());
  AdhesionPoints points{Eigen::ArrayXd(n), Eigen::ArrayXd(n), Eigen::ArrayXd(n), Eigen::ArrayXd(n),
                        std::fmax(rtol, 1e-10)};
  for (Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k), entry = contact.entry[i];
    const double area = contact.friction.contact_area[entry];
    if (!(area > 0))
      throw InvalidInput(argument("mu") + ("[" + std::to_string(i) + "] = ") + value(mu[i]) + " at " +
                             argument("pressure") + " = " + value(pressure[i]) + ", " + argument("velocity") + " = " +
                             value(velocity[i]) + must_be() + "left out, there is no contact by the model",
                         "no-contact");
    points.x[k] = std::log10(velocity[i]);
    points.log_mu[k] = std::log(mu[i]);
    points.log_hysteresis[k] = std::log(contact.friction.hysteresis[entry]);
    points.log_share[k] = std::log(area / pressure[i]);
  }
  return points;
}

[[noreturn]] void refuse_hysteresis(const AdhesionPoints& points, const ContactModel& model) {
  const Index below = (points.log_mu <= points.log_hysteresis).count();
  throw InvalidInput(argument("mu") + ": leaves nothing for the adhesion, the hysteresis alone exceeds it at " +
                         std::to_string(below) + " of " + std::to_string(points.size()) + " points (mean ratio " +
                         show(std::exp((points.log_hysteresis - points.log_mu).mean()), 3) + ")" + must_be() +
                         "above it; " +
                         (std::holds_alternative<NoCorrection>(model.correction)
                              ? "plain Persson overestimates the hysteresis of partial contact, see correction"
                              : "the spectrum may reach too far, the modulus or the correction may be wrong"),
                     "no-adhesion-left");
}

/// The parameters that the points leave open, in words; empty where they settle all. `curve` is none where it ran away.
Sentence open_parameters(const std::optional<AdhesionCurve>& curve, const FixedAdhesion& fixed) {
  Sentence open;
  const auto add = [&](std::string_view name, const std::string& range) {
    open = std::move(open) + (open.empty() ? "" : ", ") + argument(name) + range;
  };
  if (!curve) {
    if (!fixed.shear_stress) add("shear_stress", "");
    if (!fixed.reference_velocity) add("reference_velocity", "");
    if (!fixed.width) add("width", "");
    return open;
  }
  const auto error = [&](Index k) { return std::sqrt(curve->covariance(k, k)); };
  const double v0 = std::pow(10, curve->at[1]), tau = std::exp(curve->at[0]), c = curve->at[2];
  if (!fixed.shear_stress && !(error(0) <= uncertain_share))
    add("shear_stress", " (" + show(tau, 3) + " +- " + show(tau * error(0), 2) + " Pa)");
  if (!fixed.reference_velocity && !(error(1) <= uncertain_decades))
    add("reference_velocity", " (" + show(v0, 3) + " m/s, uncertain by " + show(error(1), 2) + " decades)");
  const double allowed = std::max(uncertain_share * c, fixed.reference_velocity ? uncertain_width : 0);
  if (!fixed.width && !(error(2) <= allowed)) add("width", " (" + show(c, 2) + " +- " + show(error(2), 2) + ")");
  return open;
}

[[noreturn]] void refuse_open(const Sentence& open, const FixedAdhesion& fixed) {
  Sentence held;
  if (!fixed.width)
    held = ", or hold what is known, as by " + advice("hold-width", "fixed = {\"width\": 0.1}");
  else if (!fixed.reference_velocity)
    held = ", or hold what is known, as by " + advice("hold-velocity", "fixed = {\"reference_velocity\": 6e-3}");
  throw InvalidInput(argument("velocity") + ", " + argument("mu") + ": do not determine " + open +
                         must(": must show ") +
                         "the maximum of Eq. 23 above the hysteresis and above their own scatter; take more points or "
                         "decades of velocity" +
                         held,
                     "undetermined");
}

/// Whether neighbours in velocity are off to the same side by more than chance (J. von Neumann, Ann. Math. Stat. 12,
/// 367 (1941)): the mean square of their differences is twice that of white noise itself, known to 1 / sqrt(n).
bool systematic(const AdhesionCurve& curve, const AdhesionPoints& points) {
  std::map<double, std::pair<double, double>> at;  // sum and count of the residuals at each velocity
  for (Index i = 0; i < points.size(); ++i)
    if (curve.weight[i] > 0) {
      auto& [sum, count] = at[points.x[i]];
      sum += curve.residual[i];
      count += 1;
    }
  double last = 0, squares = 0, differences = 0;
  for (const auto& [x, group] : at) {
    const double off = group.first / std::sqrt(group.second);
    if (x > at.begin()->first) differences += (off - last) * (off - last);
    squares += off * off;
    last = off;
  }
  return differences < 2 * squares * (1 - 3 / std::sqrt(static_cast<double>(at.size())));
}

std::vector<Diagnostic> notes_on(const AdhesionCurve& curve, const AdhesionPoints& points, const FixedAdhesion& fixed,
                                 bool edge, double rtol) {
  std::vector<Diagnostic> notes;
  const Index aside = (curve.weight == 0).count();
  if (aside > 0)
    notes.push_back(
        note("points-aside", std::to_string(aside) + " of " + std::to_string(points.size()) +
                                 " points were put aside, see " + argument("outliers") +
                                 (static_cast<double>(aside) > many_outliers * static_cast<double>(points.size())
                                      ? ": so many that the model may be what is wrong"
                                      : "")));
  if (!fixed.reference_velocity && (curve.at[1] < points.x.minCoeff() || curve.at[1] > points.x.maxCoeff()))
    notes.push_back(warning("maximum-extrapolated",
                            argument("reference_velocity") + " = " + value(std::pow(10, curve.at[1]), 3, "m/s") +
                                " m/s lies outside of the measured velocities, " +
                                show(std::pow(10, points.x.minCoeff()), 3) + " to " +
                                show(std::pow(10, points.x.maxCoeff()), 3) + " m/s: it is extrapolated",
                            {"measure at velocities about the maximum"}));
  if (curve.scale > rtol && systematic(curve, points))
    notes.push_back(warning(
        "systematic-misfit",
        {"neighbours in velocity are off the fit to the same side, by more than chance: the hysteresis (spectrum, "
         "modulus, correction), what was held or Eq. 23 does not fit these points; errors are larger than stated"},
        {"check spectrum, modulus and correction against the points"}));
  const Index spare = points.size() - static_cast<Index>(count_free(fixed));
  if (curve.scale > rtol && spare < few_spare)
    notes.push_back(warning(
        "few-points",
        {"only " + std::to_string(spare) +
         " points more than parameters: standard errors are too small, of 17 by a third and of 3 by four times in "
         "simulations"},
        {"measure more points"}));
  if (curve.scale > large_scatter)
    notes.push_back(warning("large-scatter",
                            "the points scatter by " + value(100 * curve.scale, 2, "%") +
                                " % about the fit: their unit of velocity, the hysteresis or Eq. 23 may be wrong",
                            {"check the unit of the velocities"}));
  if (edge)
    notes.push_back(note("width-at-zero", argument("width") +
                                              " was taken as 0: the points leave it there or, within their scatter, "
                                              "below"));
  return notes;
}

}  // namespace

AdhesionFit fit_adhesion(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                         std::span<const double> pressure, std::span<const double> velocity, std::span<const double> mu,
                         const FixedAdhesion& fixed) {
  check_contact(model, pressure, velocity);
  check(fixed);
  check(velocity, mu, fixed);
  const Contact known = contact(spectrum, rubber, model, pressure, velocity);
  const AdhesionPoints points = logarithms(known, pressure, velocity, mu, model.rtol);
  if ((points.log_mu <= points.log_hysteresis).all()) refuse_hysteresis(points, model);

  HeldParameters held;
  if (fixed.shear_stress) held[0] = std::log(*fixed.shear_stress);
  if (fixed.reference_velocity) held[1] = std::log10(*fixed.reference_velocity);
  held[2] = fixed.width;
  std::optional<AdhesionCurve> curve = fit_adhesion_curve(points, held);
  // about a v0 that is held, c = 0 is an adhesion without a maximum, which is as good as any
  const bool edge = curve && fixed.reference_velocity && !fixed.width && curve->at[2] < 0 &&
                    curve->at[2] > -edge_errors * std::sqrt(curve->covariance(2, 2));
  if (edge) {
    const Eigen::Matrix3d covariance = curve->covariance;
    held[2] = 0;
    curve = fit_adhesion_curve(points, held);
    if (curve) curve->covariance = covariance;
  }
  if (const Sentence open = open_parameters(curve, fixed); !curve || !open.empty()) {
    if (2 * (points.log_mu <= points.log_hysteresis).count() >= points.size()) refuse_hysteresis(points, model);
    refuse_open(open, fixed);
  }
  if (curve->at[2] < 0)
    throw InvalidInput(argument("fixed: reference_velocity") + " = " + value(*fixed.reference_velocity) + must_be() +
                       "near the maximum of the adhesion, which has its minimum there by the points (" +
                       argument("width") + " = " + value(curve->at[2], 3) + ")");

  AdhesionFit fit{{fixed.shear_stress.value_or(std::exp(curve->at[0])),
                   fixed.reference_velocity.value_or(std::pow(10, curve->at[1])), curve->at[2]},
                  {},
                  curve->scale,
                  {},
                  known.friction.notes};
  const Eigen::Vector3d slope{fit.adhesion.shear_stress, ln10 * fit.adhesion.reference_velocity, 1};
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j)
      fit.covariance[static_cast<std::size_t>(3 * i + j)] = slope[i] * slope[j] * curve->covariance(i, j);
  for (const double weight : curve->weight) fit.outliers.push_back(weight == 0);
  for (Diagnostic& found : notes_on(*curve, points, fixed, edge, model.rtol)) fit.notes.push_back(std::move(found));
  return fit;
}

}  // namespace asperity
