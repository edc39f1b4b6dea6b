// Polynomials sum c_ij T_i(x) T_j(z) through the solver's numbers at Chebyshev's points (chebyshev.hpp).
#include <algorithm>
#include <cmath>
#include <utility>

#include "friction_map/slices.hpp"
#include "numerics/chebyshev.hpp"

namespace asperity {

namespace {

constexpr double longest = 2;         // of a patch to begin with, in ln v and in ln p
constexpr double most_in_a_row = 64;  // to begin with: of a box of hundreds of decades most is smooth
constexpr std::size_t test_z = 2;     // random z at a random x between every two points

}  // namespace

MapPatches::MapPatches(MapFrame frame, double rtol, unsigned threads, const std::function<void(double)>& progress)
    : frame_(std::move(frame)), tolerance_(std::fmax(step_share * rtol, 2 * frame_.solver_rtol())), threads_(threads) {
  if (frame_.slant()) {
    for (std::size_t k = 0; k + 1 < frame_.cuts().size(); ++k) add_strip({frame_.cuts()[k], frame_.cuts()[k + 1]});
  } else if (frame_.load_shift().any()) {  // loads of the box, and of cells that stand out of it
    const auto [smallest, largest] = frame_.load_shift().range();
    const auto [lowest, highest] = frame_.offsets();
    add_strip({smallest + lowest, largest + highest});
  } else {
    add_strip({frame_.cuts().front(), frame_.cuts().back()});
  }
  make(in_box(), progress);
}

void MapPatches::add_strip(std::array<double, 2> z) {
  const auto [x_lo, x_hi] = frame_.x();
  const auto [bottom, top] = z;
  const auto pieces = [](double length) { return std::clamp(std::ceil(length / longest), 1.0, most_in_a_row); };
  const double columns = pieces(x_hi - x_lo), rows = pieces(top - bottom);
  const Strip strip{patches_.size(), static_cast<std::size_t>(columns), static_cast<std::size_t>(rows),
                    MapPlace{x_lo, bottom}, MapPlace{(x_hi - x_lo) / columns, (top - bottom) / rows}};
  const MapPlace half{strip.size.x / 2, strip.size.z / 2};
  for (std::size_t i = 0; i < strip.columns; ++i)
    for (std::size_t j = 0; j < strip.rows; ++j)
      patches_.push_back({.middle = {x_lo + (2 * static_cast<double>(i) + 1) * half.x,
                                     bottom + (2 * static_cast<double>(j) + 1) * half.z},
                          .half = half});
  strips_.push_back(strip);
}

/// The patches that the box touches, all that is worth a look ahead.
std::vector<std::size_t> MapPatches::in_box() const {
  const auto [x_lo, x_hi] = frame_.x();
  std::vector<bool> touched(patches_.size(), frame_.slant().has_value());
  constexpr int steps = 256;
  for (int i = 0; i <= steps && !frame_.slant(); ++i)
    for (int j = 0; j <= steps; ++j) {
      const double x = x_lo + (x_hi - x_lo) * i / steps;
      const double y = frame_.ln_pressure(0) + (frame_.ln_pressure(1) - frame_.ln_pressure(0)) * j / steps;
      touched[first_at(strips_[0], {x, y + frame_.load_shift()(y - frame_.log_modulus_offset(x)).value})] = true;
    }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < patches_.size(); ++i)
    if (touched[i]) result.push_back(i);
  return result;
}

/// Level by level, so that all points of a level are solved at once.
void MapPatches::make(std::vector<std::size_t> wanted, const std::function<void(double)>& progress) {
  const auto area = [&](std::size_t i) { return patches_[i].half.x * patches_[i].half.z; };
  double whole = 0, done = 0;
  for (const std::size_t i : wanted) whole += area(i);
  while (!wanted.empty()) {
    interpolate(wanted);
    const bool last = patches_.size() > most;
    std::vector<std::size_t> tested, next;
    for (const std::size_t i : wanted)
      if (last || std::ranges::max(last_coefficients(patches_[i])) <= tolerance_) tested.push_back(i);
    const std::vector<double> errors = test(tested);
    for (std::size_t k = 0; k < tested.size(); ++k) {
      Patch& patch = patches_[tested[k]];
      const double off = std::fmax(std::ranges::max(last_coefficients(patch)), errors[k]);
      if (!last && off > tolerance_) continue;
      patch.error += 2 * off;
      patch.made = true;
    }
    for (const std::size_t i : wanted) {
      if (patches_[i].made) {
        done += area(i);
        continue;
      }
      const auto [in_x, in_z] = last_coefficients(patches_[i]);
      halve(i, in_x >= in_z);
      const auto child = static_cast<std::size_t>(patches_[i].child);
      next.insert(next.end(), {child, child + 1});
    }
    wanted.swap(next);
    if (progress) progress(done / whole);
  }
}

void MapPatches::interpolate(std::span<const std::size_t> wanted) {
  const ChebyshevPoints<n>& points = chebyshev_points<n>();
  std::vector<MapPlace> places;
  places.reserve(wanted.size() * n * n);
  for (const std::size_t index : wanted) {
    const Patch& patch = patches_[index];
    for (const double x : points.point)
      for (const double z : points.point)
        places.push_back({patch.middle.x + patch.half.x * x, patch.middle.z + patch.half.z * z});
  }
  const std::vector<MapSample> found = frame_.sample_unshifted(places, threads_);
  const Eigen::Map<const Matrix> transform(points.transform[0].data());
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    Patch& patch = patches_[wanted[w]];
    const MapSample* const sample = &found[w * n * n];
    patch.error = std::ranges::max_element(sample, sample + n * n, {}, &MapSample::error)->error;
    for (std::size_t f = 0; f < 2; ++f) {
      Matrix value;
      for (std::size_t i = 0; i < n * n; ++i) value.data()[i] = sample[i].f[f];
      patch.coefficient[f] = transform * value * transform.transpose();
    }
  }
}

/// The largest error of each at random points, beside every x: where the rubber has a kink or a narrow step,
/// polynomials are off near it alone.
std::vector<double> MapPatches::test(std::span<const std::size_t> wanted) {
  constexpr std::size_t tested = (n - 1) * test_z;
  const ChebyshevPoints<n>& points = chebyshev_points<n>();
  std::vector<MapPlace> places;
  places.reserve(wanted.size() * tested);
  for (const std::size_t index : wanted) {
    const Patch& patch = patches_[index];
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double at = points.point[i] + random_() * (points.point[i + 1] - points.point[i]);
      for (std::size_t j = 0; j < test_z; ++j)
        places.push_back({patch.middle.x + patch.half.x * at, patch.middle.z + patch.half.z * (2 * random_() - 1)});
    }
  }
  const std::vector<MapSample> found = frame_.sample_unshifted(places, threads_);
  std::vector<double> errors(wanted.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t w = i / tested;
    const std::array<double, 2> f = value(patches_[wanted[w]], places[i]);
    for (std::size_t k = 0; k < 2; ++k) errors[w] = std::fmax(errors[w], std::fabs(f[k] - found[i].f[k]));
  }
  return errors;
}

void MapPatches::halve(std::size_t index, bool in_x) {
  Patch& whole = patches_[index];
  whole.child = static_cast<std::int32_t>(patches_.size());
  whole.in_x = in_x;
  whole.made = true;
  Patch half{.middle = whole.middle, .half = whole.half};
  double& length = in_x ? half.half.x : half.half.z;
  double& at = in_x ? half.middle.x : half.middle.z;
  length /= 2;
  at -= length;
  patches_.push_back(half);
  at += 2 * length;
  patches_.push_back(half);
}

/// The largest of the last two coefficients in x, and in z.
std::array<double, 2> MapPatches::last_coefficients(const Patch& patch) {
  const auto& [f, g] = patch.coefficient;
  return {std::max(f.bottomRows<2>().cwiseAbs().maxCoeff(), g.bottomRows<2>().cwiseAbs().maxCoeff()),
          std::max(f.rightCols<2>().cwiseAbs().maxCoeff(), g.rightCols<2>().cwiseAbs().maxCoeff())};
}

/// The patch of a strip's first ones that holds a place.
std::size_t MapPatches::first_at(const Strip& strip, const MapPlace& place) {
  const auto piece = [](double at, std::size_t pieces) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(pieces - 1)));
  };
  return strip.first + piece((place.x - strip.corner.x) / strip.size.x, strip.columns) * strip.rows +
         piece((place.z - strip.corner.z) / strip.size.z, strip.rows);
}

const MapPatches::Patch& MapPatches::find(std::uint32_t band, const MapPlace& place) {
  std::size_t at = first_at(strips_[frame_.slant() ? band : 0], place);
  if (!patches_[at].made) make({at}, {});
  while (patches_[at].child >= 0) {
    const Patch& patch = patches_[at];
    const bool beyond = patch.in_x ? place.x > patch.middle.x : place.z > patch.middle.z;
    at = static_cast<std::size_t>(patch.child) + (beyond ? 1 : 0);
  }
  return patches_[at];
}

std::array<double, 2> MapPatches::value(const Patch& patch, const MapPlace& place) {
  const Vector x = vector(chebyshev<n>((place.x - patch.middle.x) / patch.half.x));
  const Vector z = vector(chebyshev<n>((place.z - patch.middle.z) / patch.half.z));
  return {z.dot(patch.coefficient[0].transpose().lazyProduct(x)),
          z.dot(patch.coefficient[1].transpose().lazyProduct(x))};
}

// With y = ln p, f = m(x, y + tau) less tau for mu_H, tau = ln p_T at z = y - ln E*.
MapSample MapPatches::at(const MapPlace& place) {
  const LoadShift& shift = frame_.load_shift();
  const double y = place.z + frame_.log_modulus_offset(place.x);
  const double tau = shift.any() ? shift(y - frame_.log_modulus(place.x)).value : 0;
  const MapPlace load{place.x, y + tau};
  const Patch& patch = find(frame_.band(load.z), load);
  std::array<double, 2> f = value(patch, load);
  if (frame_.hysteresis()) f[0] -= tau;
  return {f, patch.error + 2 * shift.error()};
}

MapSlopes MapPatches::slopes(std::uint32_t band, const MapPlace& place) {
  const ValueAndSlope offset = frame_.spline(place.x), tau = frame_.load_shift()(place.z, band);
  const MapPlace load{place.x, place.z + offset.value + tau.value};
  const Patch& patch = find(band, load);
  const double x = (place.x - patch.middle.x) / patch.half.x, z = (load.z - patch.middle.z) / patch.half.z;
  const auto [slopes_x, bends_x] = chebyshev_slopes<n>(x);
  const auto [slopes_z, bends_z] = chebyshev_slopes<n>(z);
  const Vector in_x = vector(chebyshev<n>(x)), slope_x = vector(slopes_x) / patch.half.x;
  const Vector in_z = vector(chebyshev<n>(z)), slope_z = vector(slopes_z) / patch.half.z;
  MapSlopes at{};
  for (std::size_t f = 0; f < 2; ++f) {
    const Matrix& c = patch.coefficient[f];
    const Vector row = c.transpose().lazyProduct(in_x), slope = c.transpose().lazyProduct(slope_x);
    const double by_load = row.dot(slope_z), by_load_twice = row.dot(vector(bends_z)) / std::pow(patch.half.z, 2);
    const double divided = f == 0 && frame_.hysteresis() ? 1 : 0;  // by p_T
    at.f[f] = row.dot(in_z) - divided * tau.value;
    at.x[f] = slope.dot(in_z) + by_load * offset.slope;
    at.z[f] = by_load * (1 + tau.slope) - divided * tau.slope;
    at.xz[f] = (slope.dot(slope_z) + by_load_twice * offset.slope) * (1 + tau.slope);
  }
  return at;
}

}  // namespace asperity
