// ln(exact / rule) of mu and of A is smooth in ln v and in ln p. Over v a step of the lattice is tried as the cubic
// through its two ends and their neighbours, against one contact in its middle: where the cubic misses that by more
// than twice the tolerance the step is halved, otherwise the miss is its error. Every step is checked in its own
// middle, as kinks lie where the band enters a relaxation: two interpolants that agree may miss them together. Between,
// the answer is the quartic through both ends and the middle, with slopes at the ends that it shares with its
// neighbours: maps need a smooth function. Which contacts a velocity asks for depends on nothing but itself.
#include "sliding/scan_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace asperity {

namespace {

LogRatios operator+(const LogRatios& a, const LogRatios& b) {
  return {a.hysteresis + b.hysteresis, a.area + b.area, a.across + b.across, 0};
}
LogRatios operator*(double factor, const LogRatios& a) {
  return {factor * a.hysteresis, factor * a.area, factor * a.across, 0};
}

/// Lagrange's polynomial.
LogRatios polynomial(std::span<const double> at, std::span<const LogRatios> values, double x) {
  LogRatios result{};
  for (std::size_t i = 0; i < at.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (j != i) weight *= (x - at[j]) / (at[i] - at[j]);
    result = result + weight * values[i];
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

namespace {

/// A step of the lattice, as often halved as it must be.
struct Step {
  int first, length;
  LogRatios begin, middle, end;
  double miss;
};

class VelocityInterpolant {
 public:
  VelocityInterpolant(const VelocityLattice& lattice, double tolerance, const ContactAt& contact_at)
      : lattice_(lattice), tolerance_(tolerance), contact_at_(contact_at) {}

  std::optional<Interpolated> operator()(double x) const {
    const auto step = step_at(x);
    if (!step) return std::nullopt;
    const int last = step->first + step->length;
    std::optional<LogRatios> from, to;  // slopes, over the step
    if (step->first > 0 && !(from = slope(step->first, *step, step_at(step->first - 0.5)))) return std::nullopt;
    if (last < lattice_.last() && !(to = slope(last, *step, step_at(last + 0.5)))) return std::nullopt;
    // at an end of the lattice the slope is that of the cubic
    const LogRatios sag = 8 * (step->middle + -0.5 * (step->begin + step->end));
    if (!from) from = *to + sag;
    if (!to) to = *from + -1 * sag;
    const double t = (x - step->first) / step->length, u = 1 - t;
    const LogRatios cubic =
        u * u * (1 + 2 * t) * step->begin + t * t * (3 - 2 * t) * step->end + t * u * u * *from + -t * t * u * *to;
    const LogRatios at_middle = 0.5 * (step->begin + step->end) + 0.125 * (*from + -1 * *to);
    const LogRatios value = cubic + 16 * t * t * u * u * (step->middle + -1 * at_middle);
    return Interpolated{value.hysteresis, value.area, value.across, step->miss, step->first + step->length / 2};
  }

 private:
  [[nodiscard]] std::optional<Step> step_at(double x) const {
    int length = VelocityLattice::parts;
    int first = std::min(static_cast<int>(x) / length * length, lattice_.last() - length);
    for (;; length /= 2) {
      const int stencil = std::clamp(first - length, 0, lattice_.last() - 3 * length), middle = first + length / 2;
      std::array<double, 4> at{};
      std::array<LogRatios, 4> values{};
      const auto in_middle = contact_at_(middle);
      bool complete = in_middle.has_value();
      for (std::size_t i = 0; i < at.size(); ++i) {
        const int position = stencil + static_cast<int>(i) * length;
        const auto value = contact_at_(position);
        complete = complete && value;
        at[i] = position;
        if (value) values[i] = *value;
      }
      if (!complete) return std::nullopt;
      const LogRatios cubic = polynomial(at, values, middle);
      const double miss =
          std::max(std::fabs(cubic.hysteresis - in_middle->hysteresis), std::fabs(cubic.area - in_middle->area));
      if (miss <= 2 * tolerance_ || miss <= in_middle->noise || length == 2) {
        const auto place = static_cast<std::size_t>((first - stencil) / length);
        return Step{first, length, values[place], *in_middle, values[place + 1], miss};
      }
      if (x >= middle) first = middle;
    }
  }

  /// Over the length of `step`, where it meets a neighbour: of fourth order, on contacts that both have.
  [[nodiscard]] std::optional<LogRatios> slope(int position, const Step& step,
                                               const std::optional<Step>& neighbour) const {
    if (!neighbour) return std::nullopt;
    const int spacing = std::max(step.length, neighbour->length) / 2;
    const auto left = contact_at_(position - spacing), far_left = contact_at_(position - 2 * spacing),
               right = contact_at_(position + spacing), far_right = contact_at_(position + 2 * spacing);
    if (!left || !far_left || !right || !far_right) return std::nullopt;
    const double over = static_cast<double>(step.length) / (12 * spacing);
    return over * (8 * (*right + -1 * *left) + -1 * (*far_right + -1 * *far_left));
  }

  const VelocityLattice& lattice_;
  double tolerance_;
  const ContactAt& contact_at_;
};

}  // namespace

std::optional<Interpolated> over_velocity(const VelocityLattice& lattice, double velocity, double tolerance,
                                          const ContactAt& contact_at) {
  if (lattice.last() > 0) return VelocityInterpolant(lattice, tolerance, contact_at)(lattice.position(velocity));
  const auto only = contact_at(0);
  return only ? std::optional(Interpolated{only->hysteresis, only->area, only->across, 0}) : std::nullopt;
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
    values[k] = {value->hysteresis, value->area, value->across, 0};
    error = std::max(error, value->error);
  }
  if (!complete) return std::nullopt;
  // a cubic with the slopes of the parabolas through three, which bracket it
  const double t = x - std::floor(x), u = 1 - t;
  const LogRatios from = 0.5 * (values[2] + -1 * values[0]), to = 0.5 * (values[3] + -1 * values[1]);
  const LogRatios value =
      u * u * (1 + 2 * t) * values[1] + t * t * (3 - 2 * t) * values[2] + t * u * u * from + -t * t * u * to;
  const LogRatios low = polynomial(std::span(at).first(3), std::span(values).first(3), x),
                  high = polynomial(std::span(at).last(3), std::span(values).last(3), x);
  error += std::max(std::fabs(low.hysteresis - high.hysteresis), std::fabs(low.area - high.area)) / 2;
  return Interpolated{value.hysteresis, value.area, value.across, error};
}

}  // namespace asperity
