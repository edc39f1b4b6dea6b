#include "asperity/build_friction_map.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "asperity/friction_map.hpp"
#include "asperity/version.hpp"
#include "checks.hpp"
#include "map_builder.hpp"
#include "map_file.hpp"
#include "threads.hpp"

namespace asperity {

namespace {

void check_request(const MapRequest& request) {
  for (const auto& [name, box] : {std::pair{"pressure", request.pressure}, std::pair{"velocity", request.velocity}}) {
    for (const double side : box) require_positive(name, side);
    if (!(box[0] * (1 + 1e-6) < box[1]))
      throw InvalidInput(std::string(name) + " = (" + show(box[0]) + ", " + show(box[1]) +
                         "): must be (lo, hi) with lo < hi, a millionth apart or more");
  }
  require_rtol(request.rtol);
}

/// Points of the box, evenly in the logarithms, edges and corners too.
std::vector<std::string> notes_of(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                  const std::optional<Adhesion>& adhesion, const MapRequest& request) {
  constexpr int steps = 8;
  const auto between = [](const std::array<double, 2>& box, int i) {
    return i == steps ? box[1] : box[0] * std::pow(box[1] / box[0], static_cast<double>(i) / steps);
  };
  std::vector<double> pressure, velocity;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      velocity.push_back(between(request.velocity, i));
      pressure.push_back(between(request.pressure, j));
    }
  return friction(spectrum, rubber, model, adhesion, pressure, velocity).notes;
}

/// The finished map against the solver on random points, 200 pressures a velocity, on as many threads as there are.
void check(const MapFrame& frame, const FrictionMap& map, const MapRequest& request, MapCertificate& certificate) {
  constexpr std::size_t block = 20'000, pressures = 200;
  const unsigned parts = std::max(1u, std::thread::hardware_concurrency());
  Random random;
  const auto [x_lo, x_hi] = frame.x();
  const double y_lo = frame.ln_pressure(0), y_hi = frame.ln_pressure(1);
  std::vector<MapPlace> places;
  std::vector<double> errors;
  for (std::size_t done = 0; done < request.checked; done += places.size()) {
    if (request.watch) request.watch();
    places.resize(std::min(block * parts, request.checked - done));
    errors.resize(places.size());
    double x = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i % pressures == 0) x = x_lo + random() * (x_hi - x_lo);
      places[i] = {x, y_lo + random() * (y_hi - y_lo) - frame.shear(x)};
    }
    in_parts(parts, places.size(), [&](unsigned, std::size_t begin, std::size_t end) {
      const std::vector<MapSample> truth = frame.sample(std::span(places).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [ln_hysteresis, ln_area] = truth[i - begin].f;
        const double y = places[i].z + frame.shear(places[i].x);
        MapPoint found;
        map.at(std::exp(y), std::exp(places[i].x), found, FrictionMap::Outside::clamp);
        errors[i] = std::fabs(found.contact_area / std::exp(ln_area) - 1);
        if (frame.hysteresis())
          errors[i] = std::fmax(errors[i], std::fabs(found.hysteresis / std::exp(ln_hysteresis) - 1));
      }
    });
    for (const double error : errors) {
      certificate.largest_checked_error = std::fmax(certificate.largest_checked_error, error);
      if (!(error <= certificate.max_error)) ++certificate.exceeded;
    }
  }
  certificate.checked = request.checked;
}

}  // namespace

std::vector<unsigned char> build_friction_map(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model,
                                              const std::optional<Adhesion>& adhesion, const MapRequest& request) {
  check_request(request);
  std::string text = "asperity " + std::string(version()) + "\n";
  for (const std::string& note : notes_of(spectrum, rubber, model, adhesion, request)) text += "note: " + note + "\n";
  text += request.text;
  MapRequest whole = request;
  whole.text = text;

  const MapFrame frame(spectrum, rubber, model, request);
  const RefinedMap refined = refine(frame, request.rtol, request.watch);
  MapCertificate certificate{.max_error = refined.max_error};
  std::vector<unsigned char> file = map_file(frame, refined.tree, adhesion, whole, certificate);
  if (request.checked == 0) return file;
  FrictionMap map;
  std::string why;
  if (!map.read(file.data(), file.size(), why)) throw Error("the map that was just made " + why);
  check(frame, map, request, certificate);
  return map_file(frame, refined.tree, adhesion, whole, certificate);
}

void write_whole(const std::string& path, std::span<const unsigned char> bytes) {
  const std::string beside = path + ".part";
  const auto refuse = [&] {
    const std::string reason = std::strerror(errno);
    std::remove(beside.c_str());
    throw InvalidInput("path = " + path + ": cannot be written: " + reason);
  };
  std::FILE* const file = std::fopen(beside.c_str(), "wb");
  if (!file) refuse();
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if ((std::fclose(file) != 0) || !written || std::rename(beside.c_str(), path.c_str()) != 0) refuse();
}

}  // namespace asperity
