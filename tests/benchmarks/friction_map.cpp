// A query of a friction map, over two logarithms and one exponential in the same loop.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <asperity/friction_map.hpp>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace py = pybind11;
using asperity::FrictionMap;

namespace {

template <class Query>
double nanoseconds(const std::vector<double>& pressure, const std::vector<double>& velocity, Query query) {
  const auto start = std::chrono::steady_clock::now();
  double sum = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i) sum += query(pressure[i], velocity[i]);
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
  if (!(sum > 0)) throw py::value_error("mu: must be positive");
  return spent.count() / static_cast<double>(pressure.size());
}

/// The same of one call for all points.
double nanoseconds_of_all(const FrictionMap& map, const std::vector<double>& pressure,
                          const std::vector<double>& velocity, std::vector<double>& mu) {
  const auto start = std::chrono::steady_clock::now();
  map.mu_at_points(mu.size(), pressure.data(), velocity.data(), mu.data());
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
  if (!(mu.back() > 0)) throw py::value_error("mu: must be positive");
  return spent.count() / static_cast<double>(mu.size());
}

/// Nanoseconds a point of mu, of mu at all points by one call, of everything with its derivatives, and of the
/// yardstick, `runs` times by turns.
std::vector<std::vector<double>> queries(const std::string& path, const std::vector<double>& pressure,
                                         const std::vector<double>& velocity, int runs) {
  FrictionMap map;
  std::string why;
  if (!map.load(path.c_str(), why)) throw py::value_error(why);
  std::vector<std::vector<double>> found(4);
  std::vector<double> all(pressure.size());
  for (int i = 0; i < runs; ++i) {
    found[0].push_back(nanoseconds(pressure, velocity, [&](double p, double v) { return map.mu(p, v); }));
    found[1].push_back(nanoseconds_of_all(map, pressure, velocity, all));
    found[2].push_back(nanoseconds(pressure, velocity, [&](double p, double v) {
      asperity::MapPoint point;
      map.at(p, v, point);
      return point.mu + point.contact_area + 1e-9 * (point.dmu_dlnp + point.dmu_dlnv);
    }));
    found[3].push_back(nanoseconds(pressure, velocity,
                                   [](double p, double v) { return std::exp(0.1 * std::log(v) - 0.2 * std::log(p)); }));
  }
  return found;
}

}  // namespace

PYBIND11_MODULE(friction_map_timing, m) { m.def("queries", &queries); }
