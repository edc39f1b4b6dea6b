// c(q) = int q^3 C dq over a window of ln q, over its length, and where the roughness ends, ln q_e = the mean of ln q
// over the last tenth of int q^3 C dq (contact/theory/partial_contact_rule.hpp).
#include "spectrum/roughness_window.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"
#include "numerics/roots.hpp"

namespace asperity {

namespace {

/// int_0^s exp(a t) dt and int_0^s t exp(a t) dt.
RoughnessMoments of_power(double a, double s) {
  const double x = a * s;
  if (std::fabs(x) > 1) {
    const double e = std::exp(x);
    return {(e - 1) / a, s * s * ((x - 1) * e + 1) / (x * x)};
  }
  double term = 1, zeroth = 0, first = 0;  // sum x^k / (k! (k + 1)), sum x^k / (k! (k + 2))
  for (int k = 0; k < 18; ++k) {
    zeroth += term / (k + 1);
    first += term / (k + 2);
    term *= x / (k + 1);
  }
  return {s * zeroth, s * s * first};
}

}  // namespace

RoughnessMoments roughness_moments(const Segment& segment, double from, double to) {
  const double q = segment.a * std::exp(from), square = q * q, length = to - from;
  if (!segment.straight) {
    const double c = square * square * segment.density_at(from);
    const auto [zeroth, first] = of_power(4 + segment.slope, length);
    return {c * zeroth, c * first};
  }
  // a polynomial in q: rules of eight nodes on short stretches
  const LegendreRule& rule = legendre_rule(8);
  const double stretches = std::ceil(std::fmax(1, 4 * length)), half = length / stretches / 2;
  RoughnessMoments sum{};
  for (double k = 0; k < stretches; ++k)
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double t = half * (2 * k + 1 + rule.node[i]), at = q * std::exp(t), at_square = at * at;
      const double part = half * rule.weight[i] * at_square * at_square * segment.density_at(from + t);
      sum.zeroth += part;
      sum.first += part * t;
    }
  return sum;
}

RoughnessWindow::RoughnessWindow(std::span<const Segment> surface) : surface_(surface) {
  double sum = 0;
  before_.reserve(surface.size());
  for (const Segment& segment : surface) {
    before_.push_back(sum);
    sum += segment.moment(3, segment.b);
  }
  total_ = sum;
  end_ = last_from_ = surface.back().b;
  if (total_ > 0) end_ = std::fmax(surface.front().a, end_ * std::exp(-mean_of_last()));
}

/// Of ln(q1 / q) over that last part of the band that has a tenth of the integral, summed from its upper end on.
double RoughnessWindow::mean_of_last() {
  constexpr double last = 0.1;
  const double needed = last * total_;
  double found = 0, sum = 0, behind = 0;  // of the integral; of ln(q1 / q) over it; ln(q1 / b) of the segment
  for (std::size_t i = surface_.size(); i-- > 0;) {
    const Segment& segment = surface_[i];
    const double length = segment.length(), rest = needed - found;
    RoughnessMoments part = roughness_moments(segment, 0, length);
    const bool enough = part.zeroth >= rest;
    double from = 0;
    if (enough) {
      from = bracketed_root([&](double t) { return roughness_moments(segment, t, length).zeroth - rest; }, 0, length);
      part = roughness_moments(segment, from, length);
    }
    last_from_ = segment.a * std::exp(from);
    found += part.zeroth;
    sum += part.zeroth * (behind + length - from) - part.first;
    if (enough) break;
    behind += length;
  }
  return sum / found;
}

std::size_t RoughnessWindow::segment_at(double wavenumber) const {
  const auto above = std::ranges::lower_bound(surface_, wavenumber, {}, &Segment::b);
  return std::min(static_cast<std::size_t>(above - surface_.begin()), surface_.size() - 1);
}

double RoughnessWindow::between(double lower, double upper) const {
  const std::size_t first = segment_at(lower), last = segment_at(upper);
  const double head = surface_[first].moment(3, std::fmin(lower, surface_[first].b));
  const double tail = surface_[last].moment(3, upper);
  if (first == last) return tail - head;
  return (before_[first + 1] - before_[first] - head) + (before_[last] - before_[first + 1]) + tail;
}

namespace {

const double reach = std::exp(RoughnessWindow::half_length);

}  // namespace

double RoughnessWindow::operator()(double wavenumber) const {
  const double lower = std::fmax(wavenumber / reach, surface_.front().a);
  const double upper = std::fmin(wavenumber * reach, surface_.back().b);
  return std::fmax(0, between(lower, upper)) / (2 * half_length);
}

std::vector<double> RoughnessWindow::ends() const { return {surface_.front().a * reach, surface_.back().b / reach}; }

}  // namespace asperity
