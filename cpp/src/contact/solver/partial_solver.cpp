// The choice of the method for PartialContact, and what the methods share.
#include "contact/solver/partial_solver.hpp"

#include <cmath>

#include "contact/solver/gsl_partial_solver.hpp"
#include "contact/solver/partial_panel_solver.hpp"
#include "contact/theory/partial_contact_rule.hpp"

namespace asperity {

std::unique_ptr<PartialProfileSolver> partial_profile_solver(std::span<const Segment> surface, const Rubber& rubber,
                                                             const ContactModel& model, std::span<const double> stops) {
  if (model.method == Method::gauss) return std::make_unique<PartialPanelSolver>(surface, rubber, model, stops);
  return std::make_unique<GslPartialSolver>(surface, rubber, model, stops);
}

std::vector<std::array<double, 2>> tail_stretches(double q_e, std::span<const double> stops) {
  const double end = q_e * partial_contact::tail_end;
  std::vector<std::array<double, 2>> result;
  double from = q_e;
  for (const double q : stops) {
    if (!(q > from && q < end)) continue;
    result.push_back({from, q});
    from = q;
  }
  result.push_back({from, end});
  return result;
}

double partial_stress(const ContactSums& root, double g, double steepness) {
  const double share = g > 0 ? std::erf(0.5 / std::sqrt(root.kappa * g)) : 1;
  return partial_contact::stress(share, root.obstacle * share * share * steepness);
}

double partial_edges(const ContactSums& root, const Rubber& rubber, double frequency, double x) {
  if (!(x >= 1 && x <= partial_contact::tail_end)) return 0;
  double w = frequency * x, end = frequency;
  if (const auto known = known_range(rubber)) {
    w = std::fmin(w, known->highest);
    end = std::fmin(end, known->highest);
  }
  const AngularIntegrals here = angular_integrals(rubber, w);
  return root.edges * here.i1 * std::pow(here.i2 / angular_integrals(rubber, end).i2, partial_contact::tail_excess) *
         std::pow(x, -partial_contact::tail_power);
}

}  // namespace asperity
