// c(q) = int q^3 C dq over a window of ln q, over its length (partial_contact_rule.hpp).
#include "contact/solver/partial_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/partial_contact_rule.hpp"

namespace asperity {

RoughnessWindow::RoughnessWindow(std::span<const Segment> surface) : surface_(surface) {
  double sum = 0;
  before_.reserve(surface.size());
  for (const Segment& segment : surface) {
    before_.push_back(sum);
    sum += segment.moment(3, segment.b);
  }
}

std::size_t RoughnessWindow::segment_at(double wavenumber) const {
  const auto above = std::ranges::lower_bound(surface_, wavenumber, {}, &Segment::b);
  return std::min(static_cast<std::size_t>(above - surface_.begin()), surface_.size() - 1);
}

double RoughnessWindow::between(double lower, double upper) const {
  const std::size_t first = segment_at(lower), last = segment_at(upper);
  const Segment &from = surface_[first], &to = surface_[last];
  const double head = from.moment(3, std::fmin(lower, from.b));
  if (first == last) return to.moment(3, upper) - head;
  const double whole = first + 1 == last ? 0 : before_[last] - before_[first + 1];
  return (from.moment(3, from.b) - head) + whole + to.moment(3, upper);
}

namespace {

const double reach = std::exp(partial_contact::half_window);

}  // namespace

double RoughnessWindow::operator()(double wavenumber) const {
  const double lower = std::fmax(wavenumber / reach, surface_.front().a);
  const double upper = std::fmin(wavenumber * reach, surface_.back().b);
  return std::fmax(0, between(lower, upper)) / (2 * partial_contact::half_window);
}

double RoughnessWindow::total() const { return before_.back() + surface_.back().moment(3, surface_.back().b); }

double RoughnessWindow::share_of_end() const {
  const double end = surface_.back().b;
  return between(std::fmax(end / std::numbers::e, surface_.front().a), end) / total();
}

double RoughnessWindow::up_to(double share) const {
  const auto above = std::ranges::upper_bound(before_, share * total());
  return surface_[static_cast<std::size_t>(above - before_.begin()) - 1].b;
}

std::vector<double> RoughnessWindow::ends() const { return {surface_.front().a * reach, surface_.back().b / reach}; }

}  // namespace asperity
