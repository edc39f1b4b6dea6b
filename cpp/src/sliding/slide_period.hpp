// A map as one period of a surface, and its contact while it slides, for a modulus of any kind.
#pragma once

#include <limits>
#include <vector>

#include "asperity/sliding.hpp"
#include "sliding/contact_solver.hpp"

namespace asperity {

struct Period {
  HeightMap::Shape shape;
  std::vector<double> heights;  // [m], of mean 0
  double rms_height;            // [m]
};

/// `shortest` [1/m]: waves beyond it do not count where the map is blended.
Period one_period(const HeightMap& map, Continuation continuation,
                  double shortest = std::numeric_limits<double>::infinity());

/// How a period slides.
struct Way {
  double poisson_ratio, pressure, velocity;
  double direction = 0;  // from x towards y [rad]
};

struct PeriodContact {
  SlidingContact contact;
  bool converged;
  int steps;
};

/// Whether or not its error came down to `rtol`.
PeriodContact slide_period(const Period& period, HeightMap::PixelSize pixel_size, const WaveModulus& modulus,
                           const Way& way, double rtol, const Course& course);

}  // namespace asperity
