// ln s0 on a grid; between columns Steffen's cubics, which do not overshoot where s0 jumps: mu over the distance need
// not fall steadily, and where the friction with and without heat cross, s0 says little and matters as little.
#include "friction_map/sliding_table.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/interpolation.hpp"
#include "numerics/parallel_for.hpp"
#include "numerics/random.hpp"

namespace asperity {

namespace {

constexpr double step_x = 0.25, step_T = 2.5;  // longest, of ln v and in K
constexpr double most_columns = 65, most_rows = 25;
constexpr std::size_t tested = 200;  // random points
constexpr double longest = 3;        // distance slid there, over s0

std::size_t points(double range, double step, double most) {
  return static_cast<std::size_t>(std::clamp(std::ceil(range / step) + 1, 2.0, most));
}

double between(const std::array<double, 2>& sides, double share) {
  return std::clamp(std::exp((1 - share) * std::log(sides[0]) + share * std::log(sides[1])), sides[0], sides[1]);
}

struct Points {
  std::vector<double> pressure, velocity, temperature;
};

struct Scene {
  const Spectrum& spectrum;
  const Rubber& rubber;
  const ContactModel& model;
  const MapHeat& heat;
  const MapRequest& request;
  unsigned threads;
};

std::vector<double> lengths(const Scene& scene, const Points& at) {
  std::vector<double> result(at.velocity.size());
  in_parts(scene.threads, result.size(), [&](unsigned, std::size_t begin, std::size_t end) {
    const auto part = [&](const std::vector<double>& all) { return std::span(all).subspan(begin, end - begin); };
    std::ranges::copy(sliding_length(scene.spectrum, scene.rubber, *scene.heat.shift, *scene.heat.heating, scene.model,
                                     scene.heat.adhesion, part(at.pressure), part(at.velocity), part(at.temperature)),
                      result.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return result;
}

/// ln s0 as a look-up finds it.
double found_at(const SlidingTable& table, double share_x, double share_T, double range_x) {
  const auto interval = [](double at, std::size_t nodes) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(nodes - 2)));
  };
  const double x = share_x * static_cast<double>(table.columns - 1),
               h = range_x / static_cast<double>(table.columns - 1);
  const std::size_t i = interval(x, table.columns);
  const auto in_row = [&](std::size_t row) {
    const double* const s = &table.values[2 * (row * table.columns + i)];
    return hermite(s[0], s[1], s[2], s[3], h, x - static_cast<double>(i)).value;
  };
  if (table.rows == 1) return in_row(0);
  const double row = share_T * static_cast<double>(table.rows - 1);
  const std::size_t j = interval(row, table.rows);
  const double t = row - static_cast<double>(j);
  return (1 - t) * in_row(j) + t * in_row(j + 1);
}

double error_of(const SlidingTable& table, const Scene& scene) {
  const MapRequest& request = scene.request;
  Random random(20261124);
  const auto [lowest, highest] = scene.heat.range;
  const double range_x = std::log(request.velocity[1] / request.velocity[0]);
  Points at;
  std::vector<double> ln_length, slid;
  for (std::size_t i = 0; i < tested; ++i) {
    const double share_x = random(), share_T = random();
    at.pressure.push_back(between(request.pressure, random()));
    at.velocity.push_back(between(request.velocity, share_x));
    at.temperature.push_back(lowest + share_T * (highest - lowest));
    ln_length.push_back(found_at(table, share_x, share_T, range_x));
    slid.push_back(longest * random());
  }
  const std::vector<double> length = lengths(scene, at);
  const FlashFriction f =
      friction(scene.spectrum, scene.rubber, *scene.heat.shift, *scene.heat.heating, scene.model, scene.heat.adhesion,
               at.pressure, at.velocity, at.temperature, Branch::coldest, false, scene.threads);
  double largest = 0;
  for (std::size_t i = 0; i < tested; ++i) {
    const double distance = slid[i] * length[i], hot = f.hot.mu[i], apart = f.cold.mu[i] - hot;
    const double mu = hot + apart * std::exp(-slid[i]);
    const double found = hot + apart * std::exp(-distance * std::exp(-ln_length[i]));
    largest = std::fmax(largest, std::fabs(found / mu - 1));
  }
  return largest;
}

}  // namespace

SlidingTable sliding_table(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                           const MapHeat& heat, const MapRequest& request, unsigned threads) {
  const Scene scene{spectrum, rubber, model, heat, request, threads};
  const auto [lowest, highest] = heat.range;
  const double x_lo = std::log(request.velocity[0]), x_hi = std::log(request.velocity[1]);
  SlidingTable table;
  table.columns = points(x_hi - x_lo, step_x, most_columns);
  table.rows = lowest == highest ? 1 : points(highest - lowest, step_T, most_rows);
  Points at;
  std::vector<double> x;
  for (std::size_t j = 0; j < table.rows; ++j)
    for (std::size_t i = 0; i < table.columns; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(table.columns - 1);
      at.pressure.push_back(between(request.pressure, 0.5));
      at.velocity.push_back(between(request.velocity, share));
      at.temperature.push_back(j == 0 ? lowest
                                      : std::fmin(highest, lowest + static_cast<double>(j) * (highest - lowest) /
                                                                        static_cast<double>(table.rows - 1)));
      if (j == 0) x.push_back(x_lo + share * (x_hi - x_lo));
    }
  const std::vector<double> length = lengths(scene, at);
  for (std::size_t j = 0; j < table.rows; ++j) {
    std::vector<double> y;
    for (std::size_t i = 0; i < table.columns; ++i) y.push_back(std::log(length[j * table.columns + i]));
    const Steffen through(x, y);
    for (std::size_t i = 0; i < table.columns; ++i) {
      const bool last = i + 1 == table.columns;
      const std::array<double, 4> c = through.cubic(last ? i - 1 : i);
      const double h = last ? x[i] - x[i - 1] : 0;
      table.values.insert(table.values.end(), {y[i], c[1] + h * (2 * c[2] + h * 3 * c[3])});
    }
  }
  table.error = error_of(table, scene);
  return table;
}

}  // namespace asperity
