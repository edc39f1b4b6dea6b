// Samples of a map in its coordinates x = ln v and z = ln p - s(x). With s = ln E* of a Greenwood-Williamson correction
// the kinks of p_T, which depends on p / E* alone, lie at constant z: the map is cut there.
#include "friction_map/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "contact/correction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

/// An error of s(x) moves the kink at a cut by as much as s is off.
constexpr double offset_share = 0.01;
constexpr std::size_t most_intervals = 16384;

/// States of the Greenwood-Williamson correction: none, beyond the theory's range, within it, full.
int state_of(const Shift& shift) {
  if (shift.state == ContactState::no_contact) return 0;
  if (shift.state == ContactState::full) return 3;
  return shift.separation_over_rms > 3 ? 1 : 2;
}

/// Weights of the derivative at point k of five points a unit apart (exact for polynomials of degree 4).
std::array<double, 5> derivative_weights(std::size_t k) {
  constexpr double w[3][5] = {{-25, 48, -36, 16, -3}, {-3, -10, 18, -6, 1}, {1, -8, 0, 8, -1}};
  std::array<double, 5> result;
  for (std::size_t i = 0; i < 5; ++i) result[i] = k <= 2 ? w[k][i] / 12 : -w[4 - k][4 - i] / 12;
  return result;
}

}  // namespace

MapFrame::MapFrame(const Spectrum& spectrum, const Rubber& rubber, ContactModel model, const MapRequest& request,
                   std::optional<MapHeat> heat)
    : spectrum_(spectrum),
      rubber_(rubber),
      model_(std::move(model)),
      rtol_(request.rtol),
      velocity_(request.velocity),
      heat_(std::move(heat)) {
  model_.rtol = std::clamp(request.rtol * 1e-2, 1e-12, 1e-6);
  x_lo_ = std::log(velocity_[0]);
  x_hi_ = std::log(velocity_[1]);
  y_lo_ = std::log(request.pressure[0]);
  y_hi_ = std::log(request.pressure[1]);
  unshifted_ = model_;
  if (macro_modulus(model_.correction, spectrum_, rubber_, velocity_[0], model_.poisson_ratio)) {
    make_log_modulus_offset(offset_share * request.rtol);
    cut_bands();
    unshifted_.correction = NoCorrection{};
    const double s = log_modulus(x_lo_);
    const auto exact = [&](double z) {
      const Shift found =
          affine_shift(model_.correction, spectrum_, rubber_, std::exp(z + s), velocity_[0], model_.poisson_ratio);
      return LoadShift::Sample{std::log(found.p), found.relative_error};
    };
    load_shift_ = LoadShift(exact, cuts_, model_.rtol / 10);
  } else {
    cuts_ = {y_lo_, y_hi_};
  }
  const auto* prony = std::get_if<PronySeries>(&rubber_);
  hysteresis_ = prony == nullptr || !prony->moduli().empty();
}

ValueAndSlope MapFrame::spline(double x) const {
  if (offset_.empty()) return {0, 0};
  const std::size_t intervals = offset_.size() / 2 - 1;
  const double h = (x_hi_ - x_lo_) / static_cast<double>(intervals), at = (x - x_lo_) / h;
  const auto i = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(intervals - 1)));
  const double* const s = &offset_[2 * i];
  return hermite(s[0], s[1], s[2], s[3], h, at - static_cast<double>(i));
}

std::optional<double> MapFrame::least_smooth(double from, double to) const {
  if (offset_.empty()) return {};
  const double h = (x_hi_ - x_lo_) / (static_cast<double>(offset_.size()) / 2 - 1);
  const ValueAndSlope a = spline(from), b = spline(to);
  std::optional<double> result;
  double most = 0;
  for (auto i = static_cast<std::size_t>((from - x_lo_) / h) + 1; 2 * i < offset_.size(); ++i) {
    const double x = x_lo_ + static_cast<double>(i) * h;
    if (x >= to) break;
    const double cubic = hermite(a.value, a.slope, b.value, b.slope, to - from, (x - from) / (to - from)).value;
    const double off = std::fabs(offset_[2 * i] - cubic);
    if (off > most) {
      most = off;
      result = x;
    }
  }
  return result;
}

double MapFrame::log_modulus(double x) const {
  const double v = std::clamp(std::exp(x), velocity_[0], velocity_[1]);
  const auto found = macro_modulus(model_.correction, spectrum_, rubber_, v, model_.poisson_ratio);
  return found ? std::log(*found) : 0;
}

bool MapFrame::touches_box(const MapPlace& corner, const MapPlace& size) const {
  if (offset_.empty()) return true;
  constexpr double margin = 1e-9;
  constexpr int steps = 16;
  double lowest = log_modulus_offset(corner.x), highest = lowest;
  for (int i = 1; i <= steps; ++i) {
    const double s = log_modulus_offset(corner.x + i * (size.x / steps));
    lowest = std::fmin(lowest, s);
    highest = std::fmax(highest, s);
  }
  const double slack = (highest - lowest) / steps + margin;
  return corner.z + size.z + highest >= y_lo_ - slack && corner.z + lowest <= y_hi_ + slack;
}

void MapFrame::make_log_modulus_offset(double tolerance) {
  const auto exact = [&](double x) { return log_modulus(x); };
  for (std::size_t intervals = 16;; intervals *= 2) {
    const double h = (x_hi_ - x_lo_) / static_cast<double>(intervals), step = h / 8;
    offset_.clear();
    for (std::size_t i = 0; i <= intervals; ++i) {
      const double x = x_lo_ + static_cast<double>(i) * h;
      const std::size_t k = i == 0 ? 0 : i == intervals ? 4 : 2;
      const std::array<double, 5> weights = derivative_weights(k);
      double slope = 0;
      for (std::size_t j = 0; j < 5; ++j)
        slope += weights[j] * exact(x + (static_cast<double>(j) - static_cast<double>(k)) * step) / step;
      offset_.insert(offset_.end(), {exact(x), slope});
    }
    double error = 0;
    for (std::size_t i = 0; i < 4 * intervals; ++i) {
      const double x = x_lo_ + (static_cast<double>(i) + 0.5) * h / 4;
      error = std::fmax(error, std::fabs(log_modulus_offset(x) - exact(x)));
    }
    if (error <= tolerance || intervals == most_intervals) return;
  }
}

std::array<double, 2> MapFrame::offsets() const {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < offset_.size(); i += 2)
    range = {std::fmin(range[0], offset_[i]), std::fmax(range[1], offset_[i])};
  return range;
}

void MapFrame::cut_bands() {
  const auto [lowest, highest] = offsets();
  const double bottom = y_lo_ - highest, top = y_hi_ - lowest;
  const auto state = [&](double z) {
    return state_of(affine_shift(model_.correction, spectrum_, rubber_, std::exp(z + log_modulus_offset(x_lo_)),
                                 velocity_[0], model_.poisson_ratio));
  };
  constexpr double step = 0.02;
  const auto steps = static_cast<std::size_t>(std::ceil((top - bottom) / step));
  cuts_ = {bottom};
  int before = state(bottom);
  const auto refuse_no_contact = [&](double z) {
    const std::size_t last = offset_.size() / 2 - 1;
    const double apart = (x_hi_ - x_lo_) / static_cast<double>(last);
    std::size_t node = 0;  // one where z is in the box, or nearly
    while (node < last && (z + offset_[2 * node] < y_lo_ || z + offset_[2 * node] > y_hi_)) ++node;
    const double y = std::clamp(z + offset_[2 * node], y_lo_, y_hi_);
    throw InvalidInput("pressure = (" + show(std::exp(y_lo_)) + ", " + show(std::exp(y_hi_)) + "): at " +
                       show(std::exp(y), 6) + " Pa and " +
                       show(std::exp(x_lo_ + static_cast<double>(node) * apart), 6) +
                       " m/s the Greenwood-Williamson correction finds no contact (d~ >= z_max): must be such that "
                       "there is contact everywhere");
  };
  if (before == 0) refuse_no_contact(bottom);
  for (std::size_t i = 1; i <= steps; ++i) {
    double a = cuts_.front() + static_cast<double>(i - 1) * step, b = i == steps ? top : a + step;
    int after = state(b);
    if (after == 0) refuse_no_contact(b);
    if (after != before) {
      for (int k = 0; k < 50 && b - a > 1e-14; ++k) {
        const double middle = a + (b - a) / 2;
        (state(middle) == before ? a : b) = middle;
      }
      cuts_.push_back(b);
      before = after;
    }
  }
  cuts_.push_back(top);
}

namespace {

template <class Solve>
auto solved(double rtol, const Solve& solve) {
  try {
    return solve();
  } catch (const NotConverged& error) {
    throw NotConverged("rtol = " + show(rtol) + " of the map: the solver, asked for a part of it, found " +
                       error.what());
  }
}

}  // namespace

std::vector<double> MapFrame::velocities_of(std::span<const MapPlace> places) const {
  std::vector<double> velocity;
  for (const MapPlace& place : places) velocity.push_back(std::clamp(std::exp(place.x), velocity_[0], velocity_[1]));
  return velocity;
}

std::vector<MapSample> MapFrame::sample(std::span<const MapPlace> places, unsigned threads) const {
  std::vector<double> pressure;
  for (const MapPlace& place : places) pressure.push_back(std::exp(place.z + log_modulus_offset(place.x)));
  return sample(model_, pressure, places, threads);
}

std::vector<MapSample> MapFrame::sample_unshifted(std::span<const MapPlace> places, unsigned threads) const {
  std::vector<double> pressure;
  for (const MapPlace& place : places) pressure.push_back(std::exp(place.z));
  return sample(unshifted_, pressure, places, threads);
}

std::vector<MapSample> MapFrame::sample(const ContactModel& model, const std::vector<double>& pressure,
                                        std::span<const MapPlace> places, unsigned threads) const {
  if (places.empty()) return {};
  const std::vector<double> velocity = velocities_of(places);
  if (heat_) return with_heat(pressure, velocity, std::vector<double>(places.size(), heat_->temperature), threads);
  return samples_of(
      solved(rtol_, [&] { return friction(spectrum_, rubber_, model, {}, pressure, velocity, false, threads); }));
}

std::vector<MapSample> MapFrame::sample_at(std::span<const MapPlace> places, std::span<const double> temperature,
                                           unsigned threads) const {
  std::vector<double> pressure;
  for (const MapPlace& place : places) pressure.push_back(std::exp(place.z));
  return with_heat(pressure, velocities_of(places), temperature, threads);
}

void refuse_folds(const FlashFriction& f) {
  const auto fold = std::ranges::find_if(f.branches, [](int n) { return n > 1; });
  if (fold == f.branches.end()) return;
  const auto i = static_cast<std::size_t>(fold - f.branches.begin());
  throw InvalidInput("temperature = " + show(f.cold.temperature[i], 6) +
                     ": at velocity = " + show(f.cold.velocity[i], 6) +
                     " and pressure = " + show(f.cold.pressure[i], 6) + " the heat has " + std::to_string(*fold) +
                     " steady states, between which mu jumps: the map must leave out where it "
                     "does");
}

std::vector<MapSample> MapFrame::with_heat(std::span<const double> pressure, std::span<const double> velocity,
                                           std::span<const double> temperature, unsigned threads) const {
  const FlashFriction f = solved(rtol_, [&] {
    return friction(spectrum_, rubber_, *heat_->shift, *heat_->heating, model_, heat_->adhesion, pressure, velocity,
                    temperature, Branch::coldest, false, threads);
  });
  refuse_folds(f);
  return samples_of(f.hot);
}

std::vector<MapSample> MapFrame::samples_of(const Friction& f) const {
  std::vector<MapSample> result;
  for (std::size_t i = 0; i < f.mu.size(); ++i) {
    const double h = f.hysteresis[i], a = f.contact_area[i];
    for (const auto& [name, value] : {std::pair{"A/A0", a}, std::pair{"mu_H", hysteresis_ ? h : 1}})
      if (!std::isnormal(value))
        throw InvalidInput("pressure = " + show(f.pressure[i]) + " at velocity = " + show(f.velocity[i]) + ": " + name +
                           " = " + show(value) + ", whose logarithm cannot be mapped");
    result.push_back({{hysteresis_ ? std::log(h) : 0, std::log(a)}, h > 0 ? f.error_estimate[i] / h : model_.rtol});
  }
  return result;
}

std::vector<double> MapFrame::temperature_cuts() const {
  const auto [lowest, highest] = heat_->range;
  std::vector<double> cuts{lowest};
  if (const auto* const table = std::get_if<ShiftTable>(heat_->shift))
    for (const double row : table->temperature())
      if (row > lowest && row < highest) cuts.push_back(row);
  cuts.push_back(highest);
  return cuts;
}

double MapFrame::error_of_shift(std::span<const double> nodes) const {
  const auto at = [&](double temperature) {
    const ShiftValue found = shift_at(*heat_->shift, temperature);
    return ValueAndSlope{std::numbers::ln10 * found.log10_a_T, std::numbers::ln10 * found.slope};
  };
  double largest = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const ValueAndSlope a = at(nodes[i]), b = at(nodes[i + 1]);
    const double cubic = hermite(a.value, a.slope, b.value, b.slope, nodes[i + 1] - nodes[i], 0.5).value;
    largest = std::fmax(largest, std::fabs(cubic - at((nodes[i] + nodes[i + 1]) / 2).value));
  }
  return largest;
}

MapFrame MapFrame::at_temperature(double temperature) const {
  MapFrame other = *this;
  other.heat_->temperature = temperature;
  return other;
}

MapFrame MapFrame::with_solver_rtol(double rtol) const {
  MapFrame other = *this;
  other.model_.rtol = other.unshifted_.rtol = rtol;
  return other;
}

}  // namespace asperity
