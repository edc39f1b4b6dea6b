#include "friction/correction_gradient.hpp"

#include "contact/correction.hpp"
#include "numerics/differences.hpp"

namespace asperity {

namespace {

/// visit(name, number) for each number that the correction was made with.
template <class C, class Visit>
void visit_numbers(C& correction, Visit visit) {
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.gamma; }) visit("gamma", s.gamma);
        if constexpr (requires { s.friction_gamma; }) visit("friction_gamma", s.friction_gamma);
        if constexpr (requires { s.p; }) visit("p", s.p);
        if constexpr (requires { s.heights; }) {
          if (s.z_max) visit("z_max", *s.z_max);
        }
        if constexpr (requires { s.z_min; }) {
          visit("z_max", s.z_max);
          visit("z_min", s.z_min);
          if (s.rms_height) visit("correction_rms_height", *s.rms_height);
          if (s.q0) visit("correction_q0", *s.q0);
        }
      },
      correction);
}

ContactModel with_gamma(const ContactModel& model, double factor) {
  ContactModel result = model;
  result.correction = changed_correction(model.correction, 0, factor);
  return result;
}

}  // namespace

std::vector<std::string> correction_arguments(const Correction& correction) {
  std::vector<std::string> result;
  visit_numbers(correction, [&](const char* name, double) { result.emplace_back(name); });
  return result;
}

bool shifts(const Correction& correction) {
  return std::visit(
      [](const auto& s) {
        return requires { s.p; }
        || requires { s.heights; }
        || requires { s.z_min; };
      },
      correction);
}

Correction with_numbers_of(const Spectrum& spectrum, const Correction& correction) {
  Correction result = correction;
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.z_min; }) {
          s.q0 = asperity_wavenumber(correction, spectrum);
          if (!s.rms_height) s.rms_height = rms_height(spectrum);
        }
      },
      result);
  return result;
}

Correction changed_correction(const Correction& correction, std::size_t argument, double factor) {
  Correction result = correction;
  std::size_t k = 0;
  visit_numbers(result, [&](const char*, double& number) {
    if (k++ == argument) number *= factor;
  });
  if (auto* const both = std::get_if<PeaksThenGreenwoodWilliamson>(&result); both && argument == 0 && both->peaks.z_max)
    *both->peaks.z_max *= factor;
  return result;
}

GammaGradient::GammaGradient(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface,
                             const ContactGrid& grid)
    : form_(model.form),
      less_(with_gamma(model, 1 - difference_step), spectrum, surface, surface.back().b),
      more_(with_gamma(model, 1 + difference_step), spectrum, surface, surface.back().b) {
  if (s_in_integrand(model.correction))
    without_ = contact_theory(with_gamma(model, 0), spectrum, surface, grid, nullptr);
}

double GammaGradient::operator()(const NodeModulus& modulus, const ContactGradient& of, double by_area, double g) {
  double result = 0;
  if (by_area != 0 && g > 0)
    result = by_area * (contact_share(more_(g), form_) - contact_share(less_(g), form_)) / (2 * difference_step);
  if (!without_) return result;
  without_->start({});
  without_->take(modulus);
  if (!(without_->unit_g() > 0)) return result;
  without_->evaluate(g / without_->unit_g(), {});
  return result + of.ratio.sum() - of.by_part.dot(without_->part());
}

}  // namespace asperity
