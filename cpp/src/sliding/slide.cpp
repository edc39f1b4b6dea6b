// A map that slides on rubber: what is asked of it, what of the modulus, and what there is to say of the result.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/sliding.hpp"
#include "numerics/arguments.hpp"
#include "sliding/slide_period.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

void validate(const SlidingModel& model, double pressure, double velocity) {
  require_positive("pressure", pressure);
  require_not_negative("velocity", velocity);
  require_poisson("poisson_ratio", model.poisson_ratio);
  require_rtol(model.rtol);
  require_finite("direction", model.direction);
  if (!(model.time_limit > 0)) refuse("time_limit", model.time_limit, "positive (infinite for none)");
}

/// The modulus must be known at the waves along the way, from the longest to that of two pixels.
void check_range(const Rubber& rubber, double velocity, const Period& period, HeightMap::PixelSize pixel_size,
                 double direction) {
  const auto known = known_range(rubber);
  if (!known) return;
  const double cosine = std::fabs(std::cos(direction)), sine = direction == 0 ? 0 : std::fabs(std::sin(direction));
  const auto [dy, dx] = pixel_size;
  const double first = 2 * pi *
                       std::min(cosine > 0 ? 1 / (dx * static_cast<double>(period.shape[1])) : 1e300,
                                sine > 0 ? 1 / (dy * static_cast<double>(period.shape[0])) : 1e300);
  const double last = pi * (cosine / dx + sine / dy);
  const double slowest = known->lowest / first, fastest = known->highest / last;
  if (velocity >= slowest && velocity <= fastest) return;
  throw OutOfRange(argument("velocity") + " = " + value(velocity, 6) + " m/s: the waves of this map have q_x from " +
                   show(first, 4) + " to " + show(last, 4) + " 1/m, and the modulus is known from " +
                   show(known->lowest, 4) + " to " + show(known->highest, 4) + " rad/s; " +
                   (slowest <= fastest
                        ? "velocities from " + show(slowest, 4) + " to " + show(fastest, 4) + " m/s are allowed"
                        : "no velocity has all of them in this range"));
}

std::string description(Continuation continuation) {
  if (continuation == Continuation::mirror)
    return "the map was continued by its mirror images: it slides over its slopes in both directions";
  if (continuation == Continuation::blend)
    return "the map was made periodic by blending about two of its shortest waves at its end into its beginning";
  return "the map was made periodic by fading its last eighth along either axis into its beginning";
}

}  // namespace

SlidingContact slide(const HeightMap& map, const Rubber& rubber, double pressure, double velocity,
                     const SlidingModel& model) {
  validate(model, pressure, velocity);
  const auto begin = std::chrono::steady_clock::now();
  Course course{.progress = model.progress};
  if (model.time_limit < 1e9)
    course.deadline = begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                  std::chrono::duration<double>(model.time_limit));
  const Period period = one_period(map, model.continuation);
  check_range(rubber, velocity, period, map.pixel_size(), model.direction);
  auto [contact, converged, steps] =
      slide_period(period, map.pixel_size(), continued_modulus(rubber),
                   {model.poisson_ratio, pressure, velocity, model.direction}, model.rtol, course);
  if (!converged)
    throw NotConverged("the contact at " + show(pressure, 6) + " Pa and " + show(velocity, 6) +
                       " m/s reached an error of " + show(contact.error, 2) + " in " + std::to_string(steps) +
                       " steps: must be " + show(model.rtol, 2) + "; its contact area was " +
                       show(contact.contact_area, 4) + " and its hysteresis " + show(contact.hysteresis, 4) +
                       (std::chrono::steady_clock::now() > course.deadline ? " at the end of time_limit" : ""));
  if (model.continuation != Continuation::periodic)
    contact.notes.push_back(note("map-continued", {description(model.continuation)}));
  if (std::fabs(model.direction) > 2 * pi)
    contact.notes.push_back(
        warning("large-angle",
                argument("direction") + " = " + value(model.direction, 6) + " is more than a turn: it is in radians",
                {"give the angle in radians"}));
  return std::move(contact);
}

}  // namespace asperity
