// Relative errors of mu, rms, on 146 exact sliding contacts of random-phase self-affine surfaces that no correction was
// fitted to (tests/reference/exact_sliding.csv, sets judge and curve): q1 / q0 from 8 to 128, H from 0.35 to 0.95,
// loads p* = sigma0 / (E* h') = 1 / sqrt(8 G(q1)) from 0.0015 to 0.6. 33 more (exact_sliding_ends.csv, set narrow) say
// that they hold from q1 / q0 = 5 on, and 42 of them what takes their place from 3 to 5, where too few were slow. Above
// 128, to 16384, there are too few to tell loads apart (exact_sliding_wide.csv, 24 that slide, 16 of them nested).
#include "contact/model_error.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "contact/grid/directions.hpp"
#include "contact/heights.hpp"
#include "contact/theory/s_factor.hpp"
#include "numerics/rounding.hpp"
#include "rubber/loss_part.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// p* up to 0.02, 0.06, 0.2 and above; a row each for slow, constant and fast.
using Errors = double[3][4];
using BySpeed = double[3];
struct Tables {
  Errors wide, narrow;
  BySpeed road;
};
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr Tables no_correction{
    {{0.131, 0.155, 0.111, 0.068}, {0.467, 0.388, 0.262, 0.162}, {0.961, 0.697, 0.476, 0.199}},
    {{unknown, unknown, unknown, unknown}, {unknown, 0.529, 0.410, 0.174}, {1.360, 0.898, 0.531, 0.249}},
    {0.207, 0.494, 0.427}};
constexpr Tables s_of_0_4{
    {{0.604, 0.595, 0.503, 0.243}, {0.417, 0.386, 0.343, 0.154}, {0.211, 0.245, 0.182, 0.080}},
    {{unknown, unknown, unknown, unknown}, {unknown, 0.327, 0.270, 0.149}, {0.077, 0.146, 0.187, 0.118}},
    {0.498, 0.275, 0.185}};
constexpr Tables s_of_0_5{
    {{0.508, 0.503, 0.416, 0.195}, {0.285, 0.268, 0.248, 0.102}, {0.135, 0.135, 0.105, 0.045}},
    {{unknown, unknown, unknown, unknown}, {unknown, 0.191, 0.157, 0.099}, {0.238, 0.089, 0.088, 0.058}},
    {0.391, 0.174, 0.093}};
constexpr Tables partial_contact{
    {{0.048, 0.046, 0.030, 0.012}, {0.068, 0.038, 0.035, 0.031}, {0.112, 0.056, 0.027, 0.022}},
    {{unknown, unknown, unknown, unknown}, {unknown, 0.014, 0.065, 0.035}, {0.147, 0.112, 0.021, 0.017}},
    {0.120, 0.066, 0.083}};
/// Over ridges, mu rms of 264 exact contacts (tests/reference/exact_direction.csv, sets judge and far): axis ratios 1.5
/// to 6 in all directions, q1 / q0 from 4 to 16, p* from 0.02 to 0.27. Wider bands are taken to be no better than
/// these.
constexpr BySpeed ridges_without_correction{0.161, 0.528, 0.831}, ridges_partial_contact{0.057, 0.068, 0.045};
constexpr double strongest = 0.923;    // |<exp 2 i phi>| of the slope variance, axis ratio 6
constexpr double faintest = 5.0 / 13;  // axis ratio 1.5: of less the contacts without ridges tell the range
constexpr double lightest_on_ridges = 0.02, heaviest_on_ridges = 0.3, narrowest_on_ridges = 4;
constexpr double loads[] = {0.02, 0.06, 0.2}, lightest = 0.0015, lightest_of_narrow = 0.009, heaviest = 0.6;
constexpr double lightest_on_road = 0.005, heaviest_on_road = 0.3;
constexpr double narrowest = 3, wide = 5, road = 128, widest = 16384;  // q1 / q0

/// None where no contact was solved for it: of S those gammas are known that were tried.
const Tables* tables_of(const Correction& correction) {
  const auto of_gamma = [](double gamma) -> const Tables* {
    return gamma == 1 ? &no_correction : gamma == 0.4 ? &s_of_0_4 : gamma == 0.5 ? &s_of_0_5 : nullptr;
  };
  if (std::holds_alternative<NoCorrection>(correction)) return &no_correction;
  if (std::holds_alternative<PartialContact>(correction)) return &partial_contact;
  const bool by_s = std::visit(
      [](const auto& s) {
        return requires { s.gamma; }
        || requires { s.friction_gamma; };
      },
      correction);
  if (!by_s) return nullptr;
  const auto s = s_in_integrand(correction);
  return of_gamma(s ? s->gamma : 1);
}

}  // namespace

SpeedRegime speed_regime(double n) {
  return n > 0.3 ? SpeedRegime::slow : n < -0.3 ? SpeedRegime::fast : SpeedRegime::constant;
}

ModelError::ModelError(const Correction& correction, const Spectrum& spectrum, const Rubber& rubber) : rubber_(rubber) {
  const auto [q0, q1] = band(spectrum);
  q0_ = q0;
  q1_ = q1;
  if (note_on_heights(spectrum).has_value()) return;  // those of the contacts were Gaussian
  const double bandwidth = q1 / q0;
  if (!is_within(bandwidth, narrowest, widest)) return;
  const Tables* const tables = tables_of(correction);
  if (!tables) return;
  bool ridges = false;
  if (const TabulatedSpectrum* const directional = harmonics_of(spectrum)) {
    const Rings mean = Directions(*directional, 0).mean();
    const double strength = std::hypot(mean.along[0], mean.across[0]);
    const bool partial = std::holds_alternative<PartialContact>(correction);
    if (!(partial || tables == &no_correction) || strength > strongest) return;
    ridges = !is_below(strength, faintest);
    if (ridges && !is_within(bandwidth, narrowest_on_ridges, road)) return;
    at_least_ = partial ? ridges_partial_contact : ridges_without_correction;
  }
  if (is_above(bandwidth, road)) {
    by_speed_ = tables->road;
    lightest_ = lightest_on_road;
    heaviest_ = heaviest_on_road;
  } else {
    const bool is_wide = !is_below(bandwidth, wide);
    by_load_ = is_wide ? tables->wide : tables->narrow;
    lightest_ = is_wide ? lightest : lightest_of_narrow;
    heaviest_ = heaviest;
  }
  if (ridges) {
    lightest_ = lightest_on_ridges;
    heaviest_ = heaviest_on_ridges;
  }
  unlimited_ = unlimited(rubber);
}

void ModelError::start(double velocity) {
  known_ = false;
  if (!by_load_ && !by_speed_) return;
  // four, as the loops take them
  const std::array w{velocity * q0_, velocity * q1_, velocity * q0_, velocity * q1_};
  std::array<double, 4> i1{}, i2{}, outside{};
  (void)angular_integrals(unlimited_ ? *unlimited_ : rubber_, w, i1, i2, outside);
  if (!(i1[0] > 0 && i1[1] > 0)) return;  // no friction
  known_ = true;
  regime_ = speed_regime(std::log(i1[1] / i2[1] * (i2[0] / i1[0])) / std::log(q1_ / q0_));
}

double ModelError::operator()(double g) const {
  const double load = 1 / std::sqrt(8 * g);
  if (!known_ || !(load >= lightest_ && load <= heaviest_)) return unknown;
  const auto row = static_cast<std::size_t>(regime_);
  const std::size_t column = load < loads[0] ? 0 : load < loads[1] ? 1 : load < loads[2] ? 2 : 3;
  const double without = by_speed_ ? by_speed_[row] : by_load_[row][column];
  return at_least_ ? std::fmax(without, at_least_[row]) : without;
}

}  // namespace asperity
