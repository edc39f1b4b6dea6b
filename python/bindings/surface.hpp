// Arguments that several parts of the module read alike.
#pragma once

#include <array>
#include <string>
#include <variant>

#include "asperity/surface.hpp"

namespace asperity::python {

/// One number, or (dy, dx).
using PixelSizeArgument = std::variant<double, std::array<double, 2>>;
HeightMap::PixelSize pixel_size_of(const PixelSizeArgument& pixel_size);

Detrend detrend_of(const std::string& argument, const std::string& name);

}  // namespace asperity::python
