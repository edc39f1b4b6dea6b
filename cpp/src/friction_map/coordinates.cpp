// The coordinates of a map, x = ln v and z = ln p - s(x): s = ln E* of a Greenwood-Williamson correction as a cubic
// spline, and the cuts in z, where the correction changes its state and p_T has kinks.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/correction.hpp"
#include "friction_map/sampling.hpp"
#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

namespace {

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
  const auto found = macro_modulus(model_.correction, spectrum_, rubber_, velocity_at(x), model_.poisson_ratio);
  return found ? std::log(*found) : 0;
}

bool MapFrame::touches_box(const MapPlace& corner, const MapPlace& size) const {
  if (offset_.empty()) return true;
  double lowest = log_modulus_offset(corner.x), highest = lowest;
  for (int i = 1; i <= curve_steps; ++i) {
    const double s = log_modulus_offset(corner.x + i * (size.x / curve_steps));
    lowest = std::fmin(lowest, s);
    highest = std::fmax(highest, s);
  }
  const double slack = (highest - lowest) / curve_steps + rounding_error;
  return corner.z + size.z + highest >= y_lo_ - slack && corner.z + lowest <= y_hi_ + slack;
}

void MapFrame::make_log_modulus_offset() {
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
    if (error <= step_share * rtol_ || intervals == most_intervals) return;
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
    throw InvalidInput(argument("pressure") + " = " + pair(std::exp(y_lo_), std::exp(y_hi_)) + ": at " +
                       show(std::exp(y), 6) + " Pa and " +
                       show(std::exp(x_lo_ + static_cast<double>(node) * apart), 6) +
                       " m/s the Greenwood-Williamson correction finds no contact (d~ >= z_max)" + must_be() +
                       "such that there is contact everywhere");
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

// Piecewise polynomials for ln p_T. Where a measured peak begins to touch, p_T has a power of 3/2, to which intervals
// are halved: that costs no point of the solver.

namespace {

constexpr int deepest = 24;
constexpr std::array<double, 4> tested{-0.93, -0.31, 0.47, 0.88};

}  // namespace

LoadShift::LoadShift(const std::function<Sample(double z)>& exact, std::span<const double> cuts, double tolerance)
    : range_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()} {
  for (std::size_t band = 0; band + 1 < cuts.size(); ++band) {
    bands_.push_back(pieces_.size());
    add(exact, cuts[band], cuts[band + 1], tolerance, 0);
  }
  bands_.push_back(pieces_.size());
}

void LoadShift::add(const std::function<Sample(double z)>& exact, double lower, double upper, double tolerance,
                    int depth) {
  static const ChebyshevZeros<n> zeros;
  const double middle = (lower + upper) / 2, half = (upper - lower) / 2;
  std::array<double, n> value;
  double allowed = tolerance;
  for (std::size_t k = 0; k < n; ++k) {
    const double z = middle + half * zeros.point[k];
    const Sample at = exact(z);
    value[k] = at.value;
    allowed = std::fmax(allowed, 4 * at.error);
    range_ = {std::fmin(range_[0], z + at.value), std::fmax(range_[1], z + at.value)};
  }
  const std::array<double, n> series = zeros.series(value);
  const Piece piece{lower, upper, powers_of(series)};
  double error = std::fmax(std::fabs(series[n - 1]), std::fabs(series[n - 2]));
  if (error <= allowed || depth == deepest)
    for (const double u : tested) {
      const double z = middle + half * u;
      error = std::fmax(error, std::fabs(piece(z).value - exact(z).value));
    }
  if (!(error <= allowed) && depth < deepest) {
    add(exact, lower, middle, tolerance, depth + 1);
    add(exact, middle, upper, tolerance, depth + 1);
    return;
  }
  error_ = std::fmax(error_, 2 * error);
  pieces_.push_back(piece);
}

ValueAndSlope LoadShift::Piece::operator()(double z) const {
  const double half = (upper - lower) / 2, u = (z - lower) / half - 1;
  double value = 0, slope = 0;
  for (std::size_t m = n; m-- > 0;) {
    slope = slope * u + value;
    value = value * u + power[m];
  }
  return {value, slope / half};
}

ValueAndSlope LoadShift::on(std::span<const Piece> pieces, double z) {
  if (pieces.empty()) return {0, 0};
  const auto above = std::ranges::lower_bound(pieces, z, {}, &Piece::lower);
  return above == pieces.begin() ? pieces.front()(z) : (*(above - 1))(z);
}

}  // namespace asperity
