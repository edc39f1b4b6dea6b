// c(q) = int q^3 C dq over a window of ln q, over its length (contact/partial_contact_rule.hpp).
#include "spectrum/roughness_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

RoughnessWindow::RoughnessWindow(std::span<const Segment> surface) : surface_(surface) {
  double sum = 0;
  before_.reserve(surface.size());
  for (const Segment& segment : surface) {
    before_.push_back(sum);
    at_start_.push_back(segment.at_a * (segment.a * segment.a) * (segment.a * segment.a));
    sum += segment.moment(3, segment.b);
  }
}

/// From the start of a segment on.
double RoughnessWindow::up_to(std::size_t index, double wavenumber) const {
  const Segment& segment = surface_[index];
  if (segment.straight) return segment.moment(3, wavenumber);
  const double power = 4 + segment.slope, s = segment.offset(wavenumber);
  return at_start_[index] * (power == 0 ? s : std::expm1(power * s) / power);
}

std::size_t RoughnessWindow::segment_at(double wavenumber) const {
  const auto above = std::ranges::lower_bound(surface_, wavenumber, {}, &Segment::b);
  return std::min(static_cast<std::size_t>(above - surface_.begin()), surface_.size() - 1);
}

double RoughnessWindow::between(double lower, double upper) const {
  const std::size_t first = segment_at(lower), last = segment_at(upper);
  const double head = up_to(first, std::fmin(lower, surface_[first].b));
  if (first == last) return up_to(last, upper) - head;
  return (before_[first + 1] - before_[first] - head) + (before_[last] - before_[first + 1]) + up_to(last, upper);
}

namespace {

const double reach = std::exp(RoughnessWindow::half_length);

}  // namespace

double RoughnessWindow::operator()(double wavenumber) const {
  const double lower = std::fmax(wavenumber / reach, surface_.front().a);
  const double upper = std::fmin(wavenumber * reach, surface_.back().b);
  return std::fmax(0, between(lower, upper)) / (2 * half_length);
}

double RoughnessWindow::total() const { return before_.back() + surface_.back().moment(3, surface_.back().b); }

double RoughnessWindow::share_of_end() const {
  const double end = surface_.back().b;
  return between(std::fmax(end / std::numbers::e, surface_.front().a), end) / total();
}

double RoughnessWindow::end_of(double share) const {
  const auto above = std::ranges::upper_bound(before_, share * total());
  return surface_[static_cast<std::size_t>(above - before_.begin()) - 1].b;
}

std::vector<double> RoughnessWindow::ends() const { return {surface_.front().a * reach, surface_.back().b / reach}; }

}  // namespace asperity
