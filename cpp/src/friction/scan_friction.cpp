#include "friction/scan_friction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "contact/conditions.hpp"

namespace asperity {

ScanFriction::ScanFriction(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model)
    : spectrum_(spectrum), model_(model), rule_(model) {
  const auto* const scan = std::get_if<ScanContact>(&model.correction);
  if (!scan) return;
  check_gauss(model.method, "with ScanContact, whose ratios are of its results");
  rule_.correction = PartialContact{};
  ratios_.emplace(*scan, spectrum, rubber, model);
}

void ScanFriction::apply(Friction& f, std::span<const double> a_T, unsigned threads) {
  if (!ratios_) return;
  std::vector<double> velocity = f.velocity;
  for (std::size_t i = 0; i < a_T.size(); ++i) velocity[i] *= a_T[i];
  const std::vector<ScanRatio> ratios = (*ratios_)(f.pressure, velocity, threads);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const ScanRatio& r = ratios[i];
    f.error_estimate[i] *= r.error_factor(f.adhesion[i]);
    f.hysteresis[i] *= r.hysteresis;
    f.lateral[i] = r.across * f.hysteresis[i];
    f.adhesion[i] *= r.area;
    f.contact_area[i] *= r.area;
    f.mu[i] = f.hysteresis[i] + f.adhesion[i];
    f.model_error[i] = r.model_error();
    if (!f.contributions) continue;
    Contributions& c = *f.contributions;
    const std::size_t n = c.wavenumber.size();
    for (std::size_t j = 0; j < n; ++j) c.dmu_dlnq[i * n + j] *= r.hysteresis;
  }
  std::ranges::move(ratios_->notes(), std::back_inserter(f.notes));
}

}  // namespace asperity
