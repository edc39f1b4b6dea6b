// With one temperature the fixed point is a root of one variable: M(rise) - rise, where M is the mean over dmu_H of the
// rise theta(q) of the model with a temperature for each q. B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789
// (2006), has theta(q); the mean is a simplification of ours, see docs/explanation/heat.md for its error.
#include "heat/one_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "numerics/roots.hpp"

namespace asperity {

using Eigen::VectorXd;

namespace {

double mean_rise(FlashMap& map, double rise) {
  heed();
  map(VectorXd::Constant(map.rise_size(), rise));
  const VectorXd part = map.contributions();
  const double whole = part.sum();
  if (!(whole > 0)) return map.rise()[map.rise().size() - 1];
  return part.dot(map.grid().to_nodes() * map.rise()) / whole;
}

/// Near which rise secant steps begin, and how many roots there are.
struct Start {
  double rise;
  int roots = 1;
};

Start start_of(FlashMap& map, double background, double before, double cold, Branch branch) {
  constexpr double first = 0.02, near = 0.05;
  const auto excess = [&](double rise) { return mean_rise(map, rise) - rise; };
  const auto between = [&](double lower, double upper) { return bracketed_root(excess, lower, upper, near * upper); };
  if (mean_rise(map, first * cold) <= cold) {  // heat takes from itself, and there is one root, below the cold rise
    if (before > 0) return {std::fmin(before, cold)};
    if (excess(cold) <= 0) return {between(0, cold)};
  }
  const double highest = std::fmax(highest_rubber_temperature - background, 1);
  std::vector<std::pair<double, double>> found;
  bool above = true;  // excess > 0, as it is at 0
  for (double rise = first * cold; rise < 2 * highest; rise *= 2) {
    const bool here = excess(2 * rise) > 0;
    if (here != above) found.emplace_back(rise, 2 * rise);
    above = here;
  }
  if (found.empty())
    throw OutOfRange(argument("temperature") + " = " + in_kelvin(background) + ": the rubber heats itself above " +
                         in_kelvin(highest_rubber_temperature) + unit("K") + ", which it does not stand",
                     "too-hot");
  const auto [lower, upper] = branch == Branch::coldest ? found.front() : found.back();
  return {between(lower, upper), static_cast<int>(found.size())};
}

}  // namespace

OneRise OneTemperatureSolver::operator()(const HeatPoint& point) {
  const double rtol = scene_.model.rtol, tolerance = std::clamp(0.1 * rtol, 1e-13, 1e-4);
  OneRise found;
  std::size_t level = 1;
  FlashMap* map = &passes_.map_of(level);
  map->start(point);
  const double cold = mean_rise(*map, 0);
  found.macro_area = map->macro_area();
  if (!(cold > 0)) return found;
  const Start start = start_of(*map, point.temperature, before_, cold, branch_);
  found.branches = start.roots;

  // secant steps on the coarse grid; their chord serves the finer ones
  const auto mu = [&] { return map->hysteresis() + map->adhesion(); };
  double low = start.rise * (1 - 1e-3), excess_low = mean_rise(*map, low) - low;
  const double first = low, excess_first = excess_low, mu_first = mu();
  double rise = start.rise, excess = mean_rise(*map, rise) - rise;
  for (int i = 0; i < 20 && std::fabs(excess) > tolerance * rise && excess != excess_low; ++i) {
    const double next = std::clamp(rise - excess * (rise - low) / (excess - excess_low), rise / 2, 2 * rise);
    low = std::exchange(rise, next);
    excess_low = std::exchange(excess, mean_rise(*map, rise) - rise);
  }
  const double chord = (excess - excess_first) / (rise - first);
  found.slope_of_mu = (mu() - mu_first) / (rise - first);
  found.gain = 1 + chord;
  for (++level; passes_.has_level(level); ++level) {
    map = &passes_.map_of(level);
    map->start(point);
    const double coarse = rise;
    for (int i = 0; i < 20; ++i) {
      excess = mean_rise(*map, rise) - rise;
      if (i > 0 && std::fabs(excess) <= tolerance * rise) break;
      rise -= excess / chord;
    }
    // twice, as the finer grid has an error too
    found.error = 2 * (std::fabs(rise - coarse) + std::fabs(excess / chord)) + 1e-13 * rise;
    found.rise = before_ = rise;
    found.macro_area = map->macro_area();
    if (std::fabs(found.slope_of_mu) * found.error <= rtol * mu()) return found;
  }
  throw NotConverged("one temperature, T0 + " + show(found.rise) + " K with error " + show(found.error) +
                     " K where rtol = " + show(rtol) + " was asked for");
}

}  // namespace asperity
