// ln(exact / rule) of mu and of A is smooth in ln v and in ln p. Over v a cell of the lattice takes the cubic through
// its two ends and their neighbours, and one contact in its middle: where the cubic misses that by more than twice the
// tolerance the cell is halved, otherwise the quartic through all five is the answer and the miss its error. Every cell
// is checked in its own middle, as kinks lie where the band enters a relaxation: two interpolants that agree may miss
// them together. Which contacts a velocity asks for depends on nothing but itself.
#include "sliding/scan_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace asperity {

namespace {

/// Lagrange's polynomial.
Interpolated polynomial(std::span<const double> at, std::span<const LogRatios> values, double x) {
  Interpolated result{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (j != i) weight *= (x - at[j]) / (at[i] - at[j]);
    result.hysteresis += weight * values[i].hysteresis;
    result.area += weight * values[i].area;
  }
  return result;
}

}  // namespace

VelocityLattice::VelocityLattice(double slowest, double fastest) : slowest_(std::log10(slowest)) {
  const double decades = std::log10(fastest) - slowest_;
  if (!(decades > 0)) return;
  constexpr int fewest = 3;  // a cubic needs four places
  cells_ = std::max(fewest, static_cast<int>(std::ceil(decades)));
  step_ = decades / cells_;
}

double VelocityLattice::velocity(int position) const { return std::pow(10, slowest_ + step_ * position / parts); }

double VelocityLattice::position(double velocity) const {
  if (cells_ == 0) return 0;
  return std::clamp((std::log10(velocity) - slowest_) / step_ * parts, 0.0, static_cast<double>(last()));
}

std::optional<Interpolated> over_velocity(const VelocityLattice& lattice, double velocity, double tolerance,
                                          const ContactAt& contact_at) {
  if (lattice.last() == 0) {
    const auto only = contact_at(0);
    if (!only) return std::nullopt;
    return Interpolated{only->hysteresis, only->area, 0};
  }
  const double x = lattice.position(velocity);
  int step = VelocityLattice::parts;
  int first = std::min(static_cast<int>(x) / step * step, lattice.last() - step);
  for (;; step /= 2) {
    const int stencil = std::clamp(first - step, 0, lattice.last() - 3 * step), middle = first + step / 2;
    std::array<double, 5> at{};
    std::array<LogRatios, 5> values{};
    bool complete = true;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const int position = i < 4 ? stencil + static_cast<int>(i) * step : middle;
      const auto value = contact_at(position);
      complete = complete && value;
      at[i] = position;
      if (value) values[i] = *value;
    }
    if (!complete) return std::nullopt;
    const Interpolated cubic = polynomial(std::span(at).first(4), std::span(values).first(4), middle);
    const double miss =
        std::max(std::fabs(cubic.hysteresis - values[4].hysteresis), std::fabs(cubic.area - values[4].area));
    if (miss <= 2 * tolerance || miss <= values[4].noise || step == 2) {
      Interpolated result = polynomial(at, values, x);
      result.error = miss;
      return result;
    }
    if (x >= middle) first = middle;
  }
}

namespace {

/// Of ln p, in decades: cubics over a quarter of a decade are off by 1 % where the area fills up.
double pressure_step(double tolerance) { return tolerance >= 0.01 ? 0.25 : 0.125; }

}  // namespace

double lattice_pressure(int index, double tolerance) { return std::pow(10, index * pressure_step(tolerance)); }

std::optional<Interpolated> over_pressure(double pressure, double tolerance,
                                          const std::function<std::optional<Interpolated>(double)>& at_pressure) {
  const double x = std::log10(pressure) / pressure_step(tolerance);
  const int first = static_cast<int>(std::floor(x)) - 1;
  std::array<double, 4> at{};
  std::array<LogRatios, 4> values{};
  double error = 0;
  bool complete = true;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto value = at_pressure(lattice_pressure(first + i, tolerance));
    complete = complete && value;
    at[k] = first + i;
    if (!value) continue;
    values[k] = {value->hysteresis, value->area, 0};
    error = std::max(error, value->error);
  }
  if (!complete) return std::nullopt;
  Interpolated result = polynomial(at, values, x);
  // the parabolas through the first and the last three bracket the cubic
  const Interpolated low = polynomial(std::span(at).first(3), std::span(values).first(3), x),
                     high = polynomial(std::span(at).last(3), std::span(values).last(3), x);
  result.error = error + std::max(std::fabs(low.hysteresis - high.hysteresis), std::fabs(low.area - high.area)) / 2;
  return result;
}

}  // namespace asperity
