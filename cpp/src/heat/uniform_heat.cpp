// eps = tau / F(tau) with tau from 0 to twice the highest temperature that rubber stands. F is that of the march, but
// for the profile. B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006).
#include "heat/uniform_heat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/watch.hpp"
#include "heat/march.hpp"

namespace asperity {

namespace {

constexpr double step = std::numbers::ln10 / 4;  // of ln(v a_T), over which no term of a rubber comes and goes
constexpr double most_growth = 0.5;              // of d ln F / d ln tau, which is below 1 where eps rises

}  // namespace

void UniformHeat::forget() {
  steps_.clear();
  contacts_.clear();
}

void UniformHeat::take_steps(double background) {
  const double highest = 2 * std::fmax(highest_rubber_temperature - background, 1);
  constexpr double longest = 40;  // [K]
  for (double tau = 0; tau < highest;) {
    const ShiftValue shift = held_shift(scene_.shift, background + tau);
    const double rate = std::numbers::ln10 * shift.slope;
    steps_.push_back({std::numbers::ln10 * shift.log10_a_T, tau * rate});
    tau += std::fmin(longest, 0.5 * step / std::fabs(rate));
  }
}

bool UniformHeat::one_state(FlashMap& map, const HeatPoint& point) {
  if (steps_.empty()) take_steps(point.temperature);
  const auto [least, most] = std::ranges::minmax_element(steps_, {}, &Step::log_a);
  const double log_v = std::log(point.velocity);
  const auto place = [&](double log_a) { return static_cast<long>(std::floor((log_v + log_a) / step)); };
  const long first = place(least->log_a);
  std::vector<double> log_rise;
  for (long k = first; k <= place(most->log_a) + 1; ++k) {
    auto found = contacts_.find(k);
    if (found == contacts_.end()) {
      heed();
      map.at_one_shift(static_cast<double>(k) * step - log_v);
      found = contacts_.emplace(k, map.contact_heat()).first;
    }
    log_rise.push_back(std::log(map.last_rise(found->second)));
  }
  return std::ranges::all_of(steps_, [&](const Step& at) {
    const auto k = static_cast<std::size_t>(place(at.log_a) - first);
    return at.growth == 0 || (log_rise[k + 1] - log_rise[k]) / step * at.growth < most_growth;
  });
}

}  // namespace asperity
