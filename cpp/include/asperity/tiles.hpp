// Tiles of a map that does not fit in memory: how alike overlaps make their spectra.
#pragma once

#include <vector>

#include "asperity/export.hpp"
#include "asperity/spectrum.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// Of the spectra of two equal tiles that lie `shift` points apart: covariances of the means of rings 0, 1, ... apart,
/// times n / 2 over the squares of the densities, n the modes of a ring. Without shift, those of a tile with itself.
/// The mean of m tiles has the sum of those of all pairs over m^2.
ASPERITY_EXPORT std::vector<double> tile_covariances(Window window, HeightMap::Shape tile,
                                                     HeightMap::PixelSize pixel_size, HeightMap::Shape shift);

}  // namespace asperity
