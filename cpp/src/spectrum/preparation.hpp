// The preparation of a map for its transform: window, trend, and the factors that make |sum|^2 a density.
#pragma once

#include <optional>
#include <vector>

#include "asperity/spectrum.hpp"
#include "surface/detrend.hpp"

namespace asperity {

struct Preparation {
  std::vector<double> wy, wx;  // window weights
  std::optional<Trend> trend;  // taken out
  /// Eqs 26-27 with n = nx ny points: C = A / ((2 pi)^2 n^2) |sum|^2, over the window's mean square.
  double scale;
  std::vector<double> ring_covariances;  // of rings 0, 1, ... apart, as in spectrum/ring_covariance.hpp
};

/// Throws where the map has drop-outs.
void require_filled(const HeightMap& map);

/// Throws where the map has drop-outs or no two-dimensional spectrum.
void require_plane(const HeightMap& map);

/// Throws as require_plane does.
Preparation prepare(const HeightMap& map, Window window, std::optional<Detrend> detrend, unsigned threads);

}  // namespace asperity
