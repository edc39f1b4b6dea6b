// Samples of a map in its coordinates x = ln v and z = ln p - s(x). With s = ln E* of a Greenwood-Williamson correction
// the kinks of p_T, which depends on p / E* alone, lie at constant z: the map is cut there.
#include "friction_map/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contact/correction.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

MapFrame::MapFrame(const Spectrum& spectrum, const Rubber& rubber, ContactModel model, const MapRequest& request,
                   bool turns, std::optional<MapHeat> heat)
    : spectrum_(spectrum),
      rubber_(rubber),
      model_(std::move(model)),
      rtol_(request.rtol),
      velocity_(request.velocity),
      heat_(std::move(heat)),
      first_direction_(model_.direction) {
  // a point with heat is a hundred times as dear as one without, and of measured moduli dearer the more is asked
  model_.rtol = std::clamp(request.rtol * 1e-2, 1e-12, heat_ ? 1e-4 : 1e-6);
  x_lo_ = std::log(velocity_[0]);
  x_hi_ = std::log(velocity_[1]);
  y_lo_ = std::log(request.pressure[0]);
  y_hi_ = std::log(request.pressure[1]);
  unshifted_ = model_;
  // a series is smooth whichever way; a table's a_T has kinks of its own, and these lie at a constant T0
  if (heat_ && heat_->range[0] < heat_->range[1] && std::holds_alternative<MasterCurve>(rubber_) &&
      !std::holds_alternative<ShiftTable>(*heat_->shift))
    slant_.emplace(std::array{x_lo_, x_hi_}, heat_->range, *heat_->shift);
  if (macro_modulus(model_.correction, spectrum_, rubber_, velocity_[0], model_.poisson_ratio)) {
    make_log_modulus_offset();
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
    cuts_ = slant_ ? slant_->cuts() : std::vector{y_lo_, y_hi_};
  }
  const auto* prony = std::get_if<PronySeries>(&rubber_);
  hysteresis_ = prony == nullptr || !prony->moduli().empty();
  const bool of_scan = std::holds_alternative<ScanContact>(model_.correction);
  directional_ = hysteresis_ && (of_scan || is_directional(spectrum_));
  turns_ = turns && is_directional(spectrum_) && !of_scan;  // of a scan every direction has contacts of its own
}

double MapFrame::velocity_at(double x) const { return std::clamp(std::exp(x), velocity_[0], velocity_[1]); }

std::vector<MapSample> MapFrame::sample(std::span<const MapPlace> places, unsigned threads) const {
  MapPoints at;
  for (const auto& [x, z] : places) at.add(std::exp(z + log_modulus_offset(x)), velocity_at(x), 0);
  return solve(model_, at, threads);
}

std::vector<MapSample> MapFrame::sample_unshifted(std::span<const MapPlace> places, unsigned threads) const {
  if (heat_) return sample_at(places, std::vector<double>(places.size(), heat_->height), threads);
  MapPoints at;
  for (const auto& [x, z] : places) at.add(std::exp(z), velocity_at(x), 0);
  return solve(unshifted_, at, threads);
}

std::vector<MapSample> MapFrame::sample_at(std::span<const MapPlace> places, std::span<const double> height,
                                           unsigned threads) const {
  if (turns_) {
    std::vector<MapSample> result;
    for (std::size_t i = 0, end = 0; i < places.size(); i = end) {
      while (end < places.size() && height[end] == height[i]) ++end;
      const std::vector<MapSample> found = at_height(height[i]).sample(places.subspan(i, end - i), threads);
      result.insert(result.end(), found.begin(), found.end());
    }
    return result;
  }
  if (!slant_) return sample_points(places, height, threads);
  std::vector<MapPlace> points;
  std::vector<double> temperature;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Slant::Point found = slant_->at(places[i].z, height[i]);
    points.push_back({found.ln_velocity, places[i].x});
    temperature.push_back(found.temperature);
  }
  return sample_points(points, temperature, threads);
}

std::vector<MapSample> MapFrame::sample_points(std::span<const MapPlace> points, std::span<const double> temperature,
                                               unsigned threads) const {
  MapPoints at;
  for (std::size_t i = 0; i < points.size(); ++i)
    at.add(std::exp(points[i].z), velocity_at(points[i].x), temperature[i]);
  return solve(model_, at, threads);
}

std::vector<MapSample> MapFrame::solve(const ContactModel& model, const MapPoints& at, unsigned threads) const {
  if (at.pressure.empty()) return {};
  try {
    if (!heat_)
      return samples_of(friction(spectrum_, rubber_, model, {}, at.pressure, at.velocity, false, threads), {});
    const FlashFriction f = friction(spectrum_, rubber_, *heat_->shift, *heat_->heating, model, heat_->adhesion,
                                     at.pressure, at.velocity, at.temperature, Branch::coldest, false, threads);
    refuse_folds(f);
    return samples_of(f.hot, f.parts_error);
  } catch (const NotConverged& error) {
    throw NotConverged(error.diagnostic().within(argument("rtol") + " = " + value(rtol_) +
                                                 " of the map: the solver, asked for a part of it, found "));
  }
}

void refuse_folds(const FlashFriction& f) {
  const auto fold = std::ranges::find_if(f.branches, [](int n) { return n > 1; });
  if (fold == f.branches.end()) return;
  const auto i = static_cast<std::size_t>(fold - f.branches.begin());
  throw InvalidInput(argument("temperature") + " = " + value(f.cold.temperature[i], 6) + ": at " +
                     argument("velocity") + " = " + value(f.cold.velocity[i], 6) + " and " + argument("pressure") +
                     " = " + value(f.cold.pressure[i], 6) + " the heat has " + std::to_string(*fold) +
                     " steady states, between which mu jumps: the map must leave out where it does");
}

/// Without errors of the parts that of mu counts, of which mu_H may be a small part.
std::vector<MapSample> MapFrame::samples_of(const Friction& f, std::span<const double> parts_error) const {
  std::vector<MapSample> result;
  for (std::size_t i = 0; i < f.mu.size(); ++i) {
    const double h = f.hysteresis[i], a = f.contact_area[i];
    for (const auto& [name, found] : {std::pair{"A/A0", a}, std::pair{"mu_H", hysteresis_ ? h : 1}})
      if (!std::isnormal(found))
        throw InvalidInput(argument("pressure") + " = " + value(f.pressure[i]) + " at " + argument("velocity") + " = " +
                           value(f.velocity[i]) + ": " + name + " = " + show(found) +
                           ", whose logarithm cannot be mapped");
    const double error = !parts_error.empty() ? parts_error[i] : h > 0 ? f.error_estimate[i] / h : model_.rtol;
    const double across = h > 0 ? f.lateral[i] / h : 0;
    result.push_back({of_across_ ? std::array{across, 0.0} : std::array{hysteresis_ ? std::log(h) : 0, std::log(a)},
                      error * (of_across_ ? 1 + std::fabs(across) : 1), across});
  }
  return result;
}

std::array<double, 2> MapFrame::z(double x) const {
  if (slant_) return {cuts_.front(), cuts_.back()};
  const double s = log_modulus_offset(x);
  return {y_lo_ - s, y_hi_ - s};
}

bool MapFrame::in_box(const MapPlace& place) const {
  if (slant_) return true;
  const double y = place.z + log_modulus_offset(place.x);
  return y >= y_lo_ && y <= y_hi_;
}

std::uint32_t MapFrame::band(double z) const {
  const auto inner = std::span(cuts_).subspan(1, cuts_.size() - 2);
  return static_cast<std::uint32_t>(std::ranges::upper_bound(inner, z) - inner.begin());
}

std::vector<double> MapFrame::height_cuts() const {
  if (slant_ || turns_) return {heights()[0], heights()[1]};
  const auto [lowest, highest] = heat_->range;
  std::vector<double> cuts{lowest};
  if (const auto* const table = std::get_if<ShiftTable>(heat_->shift))
    for (const double row : table->temperature())
      if (row > lowest && row < highest) cuts.push_back(row);
  cuts.push_back(highest);
  return cuts;
}

ValueAndSlope MapFrame::log_a_T_at(double temperature) const {
  const ShiftValue found = shift_at(*heat_->shift, temperature);
  const double reference = shift_at(*heat_->shift, heat_->range[0]).log10_a_T;
  return {std::numbers::ln10 * (found.log10_a_T - reference), std::numbers::ln10 * found.slope};
}

std::vector<double> MapFrame::log_a_T(std::span<const double> nodes) const {
  if (!heat_ || nodes.size() < 2) return {};
  if (slant_) return {slant_->coefficients()[0], slant_->coefficients()[1]};
  std::vector<double> result;
  for (const double node : nodes) {
    const auto [value, slope] = log_a_T_at(node);
    result.insert(result.end(), {value, slope});
  }
  return result;
}

/// Laws rise or fall throughout, and shift factors between their rows.
std::array<double, 2> MapFrame::log_a_T_sides() const {
  if (slant_) return slant_->log_a_T();
  std::array<double, 2> sides{0, 0};
  for (const double cut : height_cuts()) {
    const double here = log_a_T_at(cut).value;
    sides = {std::min(sides[0], here), std::max(sides[1], here)};
  }
  return sides;
}

double MapFrame::error_of_shift(std::span<const double> nodes) const {
  if (slant_ || turns_) return 0;
  double largest = 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const ValueAndSlope a = log_a_T_at(nodes[i]), b = log_a_T_at(nodes[i + 1]);
    const double cubic = hermite(a.value, a.slope, b.value, b.slope, nodes[i + 1] - nodes[i], 0.5).value;
    largest = std::fmax(largest, std::fabs(cubic - log_a_T_at((nodes[i] + nodes[i + 1]) / 2).value));
  }
  return largest;
}

MapFrame MapFrame::at_height(double height) const {
  MapFrame other = *this;
  if (turns_)
    other.model_.direction = other.unshifted_.direction = first_direction_ + height;
  else
    other.heat_->height = height;
  return other;
}

MapFrame MapFrame::of_across() const {
  MapFrame other = *this;
  other.of_across_ = true;
  other.hysteresis_ = false;  // it is not divided by p_T
  return other;
}

MapFrame MapFrame::with_solver_rtol(double rtol) const {
  MapFrame other = *this;
  other.model_.rtol = other.unshifted_.rtol = rtol;
  return other;
}

}  // namespace asperity
