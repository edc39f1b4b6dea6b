// A part of a scan as its contact is solved: closed to a period, filtered to a band, on a grid that resolves the band.
#pragma once

#include <optional>

#include "asperity/sliding.hpp"
#include "asperity/spectrum.hpp"
#include "numerics/fft.hpp"
#include "sliding/slide_period.hpp"

namespace asperity {

/// q0 and q1 [1/m].
struct Band {
  double q0, q1;
  auto operator<=>(const Band&) const = default;
};

/// What a map knows: a wave along its longer side, and two pixels of the coarser axis.
Band known_band(const HeightMap& map);

struct ScanMap {
  Period period;
  HeightMap::PixelSize pixel_size;  // [m]
  Spectrum rings;                   // C(q) of the same period
  Grid scanned;                     // points that the period has on the scan's own grid
};

/// The map closed over waves of `shortest` [1/m] and filtered; `points_a_wave` to the shortest wave that carries slope.
/// Its heights about their mean, without drop-outs.
ScanMap scan_map(const HeightMap& map, Continuation continuation, const Band& band, double points_a_wave,
                 double shortest);

/// C(q) of the closed map on the band.
Spectrum scan_rings(const HeightMap& map, Continuation continuation, const Band& band);

/// Points of the grid that scan_map would make of the map, roughly.
double grid_points(const HeightMap& map, const Band& band, double points_a_wave);

/// A quarter of the map, 0 to 3, or as much of its middle as has `most` points along a side; detrended as a scan of its
/// own.
HeightMap scan_part(const HeightMap& map, int part, std::size_t most);

}  // namespace asperity
