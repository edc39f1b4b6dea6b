// The contact of one period of a surface that slides, for a modulus of any kind.
#pragma once

#include "asperity/sliding.hpp"
#include "sliding/compliance.hpp"
#include "sliding/contact_solver.hpp"
#include "sliding/continuation.hpp"

namespace asperity {

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
