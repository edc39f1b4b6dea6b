// Arguments that several parts of the module read alike.
#pragma once

#include <utility>

#include "asperity/surface.hpp"
#include "scalars.hpp"

namespace asperity::python {

HeightMap::PixelSize pixel_size_of(const PixelSizeArgument& pixel_size);

inline const auto detrends = {std::pair{"offset", Detrend::offset}, std::pair{"plane", Detrend::plane},
                              std::pair{"quadratic", Detrend::quadratic}};

}  // namespace asperity::python
