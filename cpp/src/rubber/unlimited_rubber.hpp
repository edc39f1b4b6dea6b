// A rubber of which no one asks what was measured.
#pragma once

#include <optional>

#include "asperity/rubber.hpp"

namespace asperity {

/// A series without the range that it was fitted on: the parts of I1 and I2 from outside of the range cost more than I1
/// and I2 do. None where `rubber` has no such range.
inline std::optional<Rubber> unlimited(const Rubber& rubber) {
  const auto* const series = std::get_if<PronySeries>(&rubber);
  if (!series || !series->fitted_range()) return std::nullopt;
  return PronySeries(series->equilibrium_modulus(), series->moduli(), series->relaxation_times());
}

}  // namespace asperity
