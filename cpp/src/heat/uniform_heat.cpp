// eps = tau / F(tau) with tau from 0 to twice the highest rise that rubber stands. F is that of the march, but for the
// profile. B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "heat/fixed_point.hpp"
#include "heat/flash_solver.hpp"

namespace asperity {

namespace {

/// What the profile may do: change eps by the factor `off`, and d ln F / d ln tau, which is below 1 where eps rises,
/// from `most_growth` to that; beyond `most_growth_far`, wherever it is, it may do more. Measured, not derived:
/// docs/explanation/heat.md.
constexpr double off = 5, most_growth = 0.3, most_growth_far = 2;

}  // namespace

void UniformHeat::forget() {
  steps_.clear();
  contacts_.clear();
}

void UniformHeat::take_steps(double background) {
  constexpr double longest = 40, shortest = 0.01;  // [K]
  const double highest = 2 * std::fmax(highest_rubber_temperature - background, 1);
  const auto log_a = [&](double tau) {
    return std::numbers::ln10 * held_shift(scene_.shift, background + tau).log10_a_T;
  };
  steps_.push_back({0, -HUGE_VAL, log_a(0)});
  for (double length = longest; steps_.back().rise < highest; length = std::fmin(2 * length, longest)) {
    const Step last = steps_.back();
    const auto after = [&](double more) {
      const double tau = std::fmin(last.rise + more, highest);
      return Step{tau, std::log(tau), log_a(tau)};
    };
    // where rows of a table have the slope 0 only the next values tell
    while (length > shortest && std::fabs(after(length).log_a - last.log_a) > 0.5 * term_step) length /= 2;
    steps_.push_back(after(length));
  }
}

std::optional<double> UniformHeat::only_rise(FlashMap& map, const HeatPoint& point) {
  if (steps_.empty()) take_steps(point.temperature);
  const auto [least, most] = std::ranges::minmax_element(steps_, {}, &Step::log_a);
  const double log_v = std::log(point.velocity);
  const auto place = [&](double log_a) { return static_cast<long>(std::floor((log_v + log_a) / term_step)); };
  const long first = place(least->log_a);
  std::vector<double> log_heat, log_macro;
  for (long k = first; k <= place(most->log_a) + 1; ++k) {
    auto found = contacts_.find(k);
    if (found == contacts_.end()) {
      heed();
      map.at_one_shift(static_cast<double>(k) * term_step - log_v);
      found = contacts_.emplace(k, map.contact_heat()).first;
    }
    log_heat.push_back(std::log(map.last_heat(found->second)));
    log_macro.push_back(std::log(found->second.macro_area));
  }
  const auto at = [&](const std::vector<double>& column, double log_a) {
    const double last = static_cast<double>(column.size() - 1);
    const double steps_up = std::clamp((log_v + log_a) / term_step - static_cast<double>(first), 0.0, last);
    const auto k = std::min(static_cast<std::size_t>(steps_up), column.size() - 2);
    return column[k] + (steps_up - static_cast<double>(k)) * (column[k + 1] - column[k]);
  };
  const FlashMap::ContactHeat& cold = contacts_.at(place(steps_.front().log_a));
  if (!(map.last_heat(cold) > 0)) return {};
  const double share = map.macro_share(cold), highest = steps_.back().rise;
  // from far below 1 over where it may be 1, and rises, to far above, and never back
  enum { below, near, above } before = below;
  std::optional<double> result;
  double log_eps = 0;
  for (std::size_t i = 1; i < steps_.size(); ++i) {
    const Step& here = steps_[i];
    const double macro_rise = std::clamp(share * here.rise, 0.0, highest);
    const double log_a_macro = std::numbers::ln10 * held_shift(scene_.shift, point.temperature + macro_rise).log10_a_T;
    const double eps_before = log_eps;
    log_eps = here.log_rise - at(log_heat, here.log_a) + at(log_macro, log_a_macro);
    const double growth = i == 1 ? 0 : 1 - (log_eps - eps_before) / (here.log_rise - steps_[i - 1].log_rise);
    const auto now = log_eps < -std::log(off) ? below : log_eps > std::log(off) ? above : near;
    if (now < before || !(growth < (now == near ? most_growth : most_growth_far))) return {};
    before = now;
    if (!result && log_eps >= 0) result = here.rise * std::exp(-log_eps / std::fmax(1 - growth, 1 - most_growth));
  }
  if (before != above) return {};
  return result;
}

}  // namespace asperity
