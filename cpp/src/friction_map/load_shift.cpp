// Piecewise polynomials for ln p_T. Where a measured peak begins to touch, p_T has a power of 3/2, to which intervals
// are halved: that costs no point of the solver.
#include "friction_map/load_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/chebyshev.hpp"

namespace asperity {

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
