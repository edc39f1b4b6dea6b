// A query of a friction map with heat, over the same query of the map without heat that lies beside it.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <asperity/friction_map.hpp>
#include <cmath>
#include <ctime>
#include <map>
#include <string>
#include <vector>

namespace py = pybind11;
using asperity::FrictionMap;
using asperity::MapTemperature;

namespace {

using Columns = std::vector<double>;
constexpr auto refused = FrictionMap::Outside::nan;

/// Processor time: the machine may have other work.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double one_by_one(const FrictionMap& map, const Columns& pressure, const Columns& velocity, const Columns& background,
                  double distance) {
  const double start = seconds();
  double sum = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    sum += map.mu(pressure[i], velocity[i], refused, {1, false, background[i], distance});
  if (!(sum > 0)) throw py::value_error("mu: must be positive");
  return 1e9 * (seconds() - start) / static_cast<double>(pressure.size());
}

double by_one_call(const FrictionMap& map, const Columns& pressure, const Columns& velocity, double background,
                   double distance) {
  Columns mu(pressure.size());
  const double start = seconds();
  map.mu_at_points(mu.size(), pressure.data(), velocity.data(), mu.data(), refused, {1, false, background, distance});
  if (!(mu.back() > 0)) throw py::value_error("mu: must be positive");
  return 1e9 * (seconds() - start) / static_cast<double>(mu.size());
}

/// Nanoseconds a point, `runs` times by turns: singly and by one call, without heat, with it, and on the way to it.
/// `various`: each point has a temperature of its own, beside the one that they share.
std::map<std::string, Columns> queries(const std::string& path, const Columns& pressure, const Columns& velocity,
                                       const Columns& various, double shared, double distance, int runs) {
  FrictionMap map;
  std::string why;
  if (!map.load(path.c_str(), why)) throw py::value_error(why);
  const Columns none(pressure.size(), 0), same(pressure.size(), shared);
  constexpr double long_ago = asperity::map_detail::long_slid;
  std::map<std::string, Columns> found;
  for (int i = 0; i < runs; ++i) {
    found["cold"].push_back(one_by_one(*map.cold(), pressure, velocity, none, long_ago));
    found["hot"].push_back(one_by_one(map, pressure, velocity, same, long_ago));
    found["distance"].push_back(one_by_one(map, pressure, velocity, same, distance));
    found["all cold"].push_back(by_one_call(*map.cold(), pressure, velocity, 0, long_ago));
    found["all hot"].push_back(by_one_call(map, pressure, velocity, shared, long_ago));
    found["all distance"].push_back(by_one_call(map, pressure, velocity, shared, distance));
    if (various.empty()) continue;
    found["hot, various"].push_back(one_by_one(map, pressure, velocity, various, long_ago));
    found["distance, various"].push_back(one_by_one(map, pressure, velocity, various, distance));
  }
  return found;
}

}  // namespace

PYBIND11_MODULE(hot_map_timing, m) { m.def("queries", &queries); }
