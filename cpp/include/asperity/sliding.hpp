// Exact steady sliding of rubber on a rigid map of heights, without adhesion and friction at the interface.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "asperity/errors.hpp"
#include "asperity/export.hpp"
#include "asperity/rubber.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// How a map is continued beyond its sides: as it stands (its opposite sides fit), by its mirror images (a map of four
/// times the points), or by its own other side, into which the last eighth along either axis is faded, with weights
/// that keep the variance, or about two of its shortest waves are blended, with weights that keep the heights.
enum class Continuation { periodic, mirror, fade, blend };

/// One period of the map, its heights about their mean. Throws InvalidInput for drop-outs, and fewer than 16 points
/// along a side.
ASPERITY_EXPORT HeightMap continued(const HeightMap& map, Continuation continuation);

/// A step of the iteration: its grid, ny x nx, its number there from 1 on, and the complementarity error it reached.
struct SlidingStep {
  HeightMap::Shape shape;
  int step;
  double error;
};

struct SlidingModel {
  double poisson_ratio = 0.5;
  Continuation continuation = Continuation::blend;
  /// Largest complementarity error.
  double rtol = 1e-6;
  /// [s], after which the computation ends with NotConverged.
  double time_limit = std::numeric_limits<double>::infinity();
  /// Of sliding, an angle from x, the second axis, towards y, along which rows rise [rad].
  double direction = 0;
  /// Told every step, in the thread that called.
  std::function<void(const SlidingStep&)> progress = {};
};

struct SlidingContact {
  HeightMap::Shape shape;           // of the map that was solved, ny x nx
  HeightMap::PixelSize pixel_size;  // [m]
  double contact_area;              // A/A0 without the excess of the pixels' perimeter
  double contact_area_raw;          // share of the points that carry pressure
  double hysteresis;                // mu_H, energy that the rubber dissipates over load and way
  double work_of_slopes;            // -<p grad h . s> / sigma0, equal to it but for the mesh and waves across the way
  double lateral;                   // -<p grad h . n> / sigma0, n being s turned by +90 degrees from x towards y
  double elastic_energy;            // <p u> / 2 per nominal area [J/m^2]
  double error;                     // <p (gap - least gap)> / (sigma0 h_rms)
  std::vector<double> pressure;     // [Pa], row by row
  std::vector<double> gap;          // [m]
  std::vector<Diagnostic> notes;
};

/// Contact and friction of a map that slides steadily along `direction` (by default x, the second axis, towards larger
/// x in the frame of the rubber) at `velocity` [m/s] under the nominal pressure [Pa]. At velocity 0 the rubber is
/// elastic, of its relaxed modulus. Throws NotConverged with what was reached.
ASPERITY_EXPORT SlidingContact slide(const HeightMap& map, const Rubber& rubber, double pressure, double velocity,
                                     const SlidingModel& model = {});

}  // namespace asperity
